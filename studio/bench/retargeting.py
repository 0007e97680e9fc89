# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How well TEO does what a person does: exact keypoints of four people, by the robot's own kinematics.

The baseline is the simple way. Each joint takes the angle of the person's, cut off at TEO's limits. The bend
of the wrist that TEO lacks is left out. Each finger takes the mean bend of its joints.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from report import Figure, spread
from signs.performed import script_track
from teo_common.arrays import Array
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_names import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_sign_capture.recordings.skeleton_bag import read_skeletons
from teo_sign_capture.retarget.arm_kinematics import mirrored
from teo_sign_capture.retarget.body_map import body_boxes, on_skin
from teo_sign_capture.retarget.robot_motion import retarget_motion
from teo_sign_capture.signing_space import MIRROR
from teo_sign_capture.tracks.signer_motion import signer_motion
from teo_sign_capture.tracks.skeleton_track import (
    EAR,
    ELBOW,
    MID_HIP,
    NECK,
    NOSE,
    SHOULDER,
    WRIST,
    SkeletonTrack,
)
from teo_signs.sign_schema import Handedness
from teo_skeleton_retriever.lifting.hand_axes import finger_bends, in_palm, palm_axes

BODIES = ("woman_small", "woman_average", "man_tall", "man_heavy")
SCRIPTS: tuple[tuple[str, Handedness], ...] = (
    ("face", "right"),
    ("spelling", "right"),
    ("two_hands", "both"),
    ("crossing", "both"),
)
# [Hz] The errors do not depend on it; the bench takes half the time.
_RATE = 15.0
_BAG = Path(__file__).parents[2] / "bags" / "signer_d435"
_TIPS = (4, 8, 12, 16, 20)
_FINGERS = ("Index", "Middle", "Ring", "Pinky")
# [m] A tip whose keypoint is so near to a place of the face is at it.
_TOUCHES = 0.03
# [m] A wrist lower than this below the shoulders hangs: no sign.
_RAISED = -0.35
# So many of the landmarks, the first ones, are places of the face.
_OF_THE_FACE = 4
_STRAIGHT, _FOLDED = np.radians(15.0), np.radians(45.0)
# Columns: along, to the little finger's side and out of the right palm while the arm hangs.
_PALM_HANGING = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])
_FIELDS = {
    "palm": ("palm direction", "deg"),
    "hand": ("direction from wrist to knuckles", "deg"),
    "pointing": ("pointing direction of an index", "deg"),
    "wrist": ("wrist to the nearest of face, ears, chest, belly, scaled", "mm"),
    "contact": ("finger tip at the face, to the same place of TEO's", "mm"),
    "flexion": ("finger flexion, a joint's share", "deg"),
}


def measure(bodies: int = len(BODIES)) -> list[Figure]:
    """Figures of the shipped bag's truth, and of other scripts and bodies together."""
    robot = Robot.load()
    bag = read_skeletons(_BAG, topic="/truth/skeletons")
    takes: list[tuple[SkeletonTrack, Handedness]] = [
        (script_track(script, body, _RATE), hands) for body in BODIES[:bodies] for script, hands in SCRIPTS
    ]
    return [
        *_compared(robot, "bags/signer_d435", [(bag, "both")]),
        *_compared(robot, f"{len(takes)} takes of {bodies} bodies", takes),
    ]


def _compared(robot: Robot, what: str, tracks: list[tuple[SkeletonTrack, Handedness]]) -> list[Figure]:
    ours, copied, spent, frames = [], [], 0.0, 0
    for track, hands in tracks:
        start = time.process_time()
        motion = retarget_motion(robot, signer_motion(track, handedness=hands))
        spent, frames = spent + time.process_time() - start, frames + len(track.times)
        for side in ("right", "left") if hands == "both" else (hands,):
            ours.append(_errors(robot, track, side, motion.joints, motion.positions))
            copied.append(_errors(robot, track, side, *_copied_joints(track, side)))
    figures = []
    for field, (text, unit) in _FIELDS.items():
        values, baseline = (
            spread(np.concatenate([getattr(one, field) for one in found]), unit) for found in (ours, copied)
        )
        figures.append(Figure(f"{what}: {text}", f"{values}; angles copied {baseline}"))
    touching, of_copies = (np.concatenate([one.touching for one in found]).mean() for found in (ours, copied))
    return [
        *figures,
        Figure(f"{what}: frames that touch", f"{touching:.1%}; angles copied {of_copies:.1%}"),
        Figure(f"{what}: retargeting, a frame", f"{1e3 * spent / frames:.1f} ms"),
    ]


class _Errors(NamedTuple):
    """Of the frames in which the hand is raised; of contacts and pointing those in which there are any.

    Attributes:
        palm: Angle between the ways the palms face [deg].
        hand: Angle between the ways from wrist to knuckles [deg].
        pointing: Angle between the ways an index points that is straight beside folded fingers [deg].
        wrist: From what is nearest of face, ears, chest and belly to the wrist: difference of the person's
            way, scaled by the length of the arms, and TEO's [mm].
        contact: Where a finger tip is at a place of the face, the same difference of the ways from the place
            to the tip [mm].
        flexion: Mean over the fingers of the difference of bends, of one joint's share [deg].
        touching: Whether parts of TEO overlap.
    """

    palm: Array
    hand: Array
    pointing: Array
    wrist: Array
    contact: Array
    flexion: Array
    touching: Array


def _errors(robot: Robot, track: SkeletonTrack, side: str, joints: tuple[str, ...], motion: Array) -> _Errors:
    """Compare a motion of TEO's joints, shape (T, m) [rad], with a person's hand."""
    flip = np.ones(3) if side == "right" else MIRROR
    hand, body = track.hand(side).positions, track.body.positions
    axes, bends = palm_axes(hand * flip), finger_bends(in_palm(hand * flip))
    person, teo = _landmarks(robot, track)
    scale = _arm_of_teo(robot) / _arm_of(track, side)
    found: dict[str, list[float]] = {field: [] for field in _Errors._fields}
    name = side.capitalize()
    frames = [f"{side}_palm", f"{side}_sensor_plate"]
    frames += [f"{name}{finger}Finger{end}" for finger in ("Thumb", *_FINGERS) for end in ("_link", "Tip")]
    for frame in np.flatnonzero(body[:, {"right": 4, "left": 7}[side], 2] > _RAISED).tolist():
        pose = dict(zip(joints, motion[frame].tolist(), strict=True))
        q = robot.configuration(pose)
        placed = robot.placements(q, frames)
        palm, plate, points = placed[0], placed[1, :3, 3], placed[2:, :3, 3].reshape(5, 2, 3)
        found["palm"].append(_angle(palm[:3, 2], axes[frame, :, 2] * flip))
        found["hand"].append(_angle(palm[:3, 0], axes[frame, :, 0] * flip))
        total = bends[frame].sum(axis=1) / 3.0
        flexions = np.array([pose[f"{name}{finger}Finger"] for finger in _FINGERS])
        found["flexion"].append(float(np.degrees(np.abs(total - flexions).mean())))
        if total[0] < _STRAIGHT and (total[1:] > _FOLDED).all():
            found["pointing"].append(_angle(points[1, 1] - points[1, 0], hand[frame, 8] - hand[frame, 5]))
        nearest = int(np.linalg.norm(person[frame] - hand[frame, 0], axis=1).argmin())
        way = scale * (hand[frame, 0] - person[frame, nearest])
        found["wrist"].append(1000.0 * float(np.linalg.norm(way - (plate - teo[nearest]))))
        away = np.linalg.norm(person[frame, None, :_OF_THE_FACE] - hand[frame, _TIPS, None], axis=2)
        tip, place = np.unravel_index(away.argmin(), away.shape)
        if away[tip, place] < _TOUCHES:
            way = scale * (hand[frame, _TIPS[tip]] - person[frame, place])
            found["contact"].append(1000.0 * float(np.linalg.norm(way - (points[tip, 1] - teo[place]))))
        found["touching"].append(robot.clearance(q).distance < 0.0)
    return _Errors(*(np.asarray(values, dtype=np.float64) for values in found.values()))


def _landmarks(robot: Robot, track: SkeletonTrack) -> tuple[Array, Array]:
    """Places on the person, shape (T, k, 3), and on TEO, shape (k, 3); those of the face first [m]."""
    body, face = track.body.positions, track.face.positions
    person = [body[:, NOSE], face[:, 8], face[:, (51, 57)].mean(axis=1), face[:, (21, 22)].mean(axis=1)]
    person += [body[:, EAR["right"]], body[:, EAR["left"]]]
    person += [body[:, NECK], (body[:, NECK] + body[:, MID_HIP]) / 2.0]
    boxes = body_boxes(robot)
    names = ("nose", "chin", "mouth", "eye", "ear")
    nose, chin, mouth, eye, ear = (on_skin(robot.humanoid, boxes, name) for name in names)
    brow = eye * (1.0, 0.0, 1.0) + (0.0, 0.0, 0.01)
    shoulder = robot.placement(robot.configuration({}), "SagittalRightShoulder_link")[:3, 3]
    # The hips' axes are at the origin.
    teo = [nose, chin, mouth, brow, ear, ear * MIRROR, shoulder * (1.0, 0.0, 1.0), shoulder * (0.5, 0.0, 0.5)]
    return np.stack(person, axis=1), np.array(teo)


def _arm_of(track: SkeletonTrack, side: str) -> float:
    rows = {"right": (2, 3, 4), "left": (5, 6, 7)}[side]
    return float(
        np.median(np.linalg.norm(np.diff(track.body.positions[:, rows], axis=1), axis=2).sum(axis=1))
    )


def _arm_of_teo(robot: Robot) -> float:
    """From the shoulder to the plate that carries the hand [m]."""
    placed = robot.placements(robot.configuration({}), ["SagittalRightShoulder_link", "right_sensor_plate"])
    return float(np.linalg.norm(placed[0, :3, 3] - placed[1, :3, 3]))


def _angle(first: Array, second: Array) -> float:
    cosine = first @ second / (np.linalg.norm(first) * np.linalg.norm(second))
    return float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _copied_joints(track: SkeletonTrack, side: str) -> tuple[tuple[str, ...], Array]:
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
