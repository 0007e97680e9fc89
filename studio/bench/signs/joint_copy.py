# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The simple way to bring a person onto TEO, to compare with: each joint takes the angle of the person's.

Shoulder, elbow and forearm take the person's angles, cut off at TEO's limits; the bend of the wrist that TEO
lacks is left out; each finger takes the mean bend of its joints.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.humanoid import load_humanoid
from teo_names import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_sign_capture.retarget.arm_kinematics import mirrored
from teo_sign_capture.signing_space import MIRROR
from teo_sign_capture.tracks.skeleton_track import ELBOW, SHOULDER, WRIST, SkeletonTrack
from teo_skeleton_retriever.lifting.hand_axes import finger_bends, in_palm, palm_axes

# Columns: along, to the little finger's side and out of the right palm while the arm hangs.
_PALM_HANGING = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])


def copied_joints(track: SkeletonTrack, side: str) -> tuple[tuple[str, ...], Array]:
    """Joints of an arm and its hand, and their positions [rad], shape (T, 12)."""
    flip = np.ones(3) if side == "right" else MIRROR
    body, hand = track.body.positions * flip, track.hand(side).positions * flip
    upper = _unit(body[:, ELBOW[side]] - body[:, SHOULDER[side]])
    fore = _unit(body[:, WRIST[side]] - body[:, ELBOW[side]])
    hinge = _unit(np.cross(upper, fore))
    # While TEO's arm hangs its links' z is up and the elbow bends forwards about -y.
    links = np.stack([np.cross(-hinge, -upper), -hinge, -upper], axis=-1)
    shoulder = Rotation.from_matrix(links)
    bend = -np.arccos(np.clip((upper * fore).sum(axis=1), -1.0, 1.0))
    wrist = Rotation.from_matrix(palm_axes(hand) @ _PALM_HANGING.T)
    rest = (shoulder * Rotation.from_euler("y", bend[:, None])).inv() * wrist
    turn, tilt, _ = rest.as_euler("ZYX").T
    arm = np.column_stack([shoulder.as_euler("YXZ"), bend, turn, tilt])
    fingers = finger_bends(in_palm(hand)).mean(axis=2)
    thumb = np.tile([0.0, np.radians(-30.0)], (len(arm), 1))
    if side == "left":
        arm = mirrored(load_humanoid(), arm)
    joints = RIGHT_ARM + RIGHT_HAND if side == "right" else LEFT_ARM + LEFT_HAND
    limits = joint_limits(joints)
    return joints, np.clip(np.concatenate([arm, thumb, fingers], axis=1), limits.lower, limits.upper)


def _unit(vectors: Array) -> Array:
    units: Array = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return units
