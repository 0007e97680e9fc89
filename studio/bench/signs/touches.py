# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether hands that one camera has seen are taken for hands on the body, or for hands in the air.

Distances are those by which capture decides (`BodyMap.distance`), of exact keypoints and of the same laid
into a picture, lifted and smoothed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from report import Figure, share
from signs.pictured import pictured
from signs.score_clips import Draw, Performed, performed
from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_capture.recordings.recording import lifted_track
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.body_map import BodyMap
from teo_sign_capture.retarget.head_motion import follow_head
from teo_sign_capture.signing_space import HEEL, person_hand_points
from teo_sign_capture.tracks.head_pose import head_pose
from teo_sign_capture.tracks.segmentation import the_sign
from teo_sign_capture.tracks.signer_motion import measure_person
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_sign_capture.tracks.smoothing import smooth_track

# [m] A hand farther from the body than the first is in the air, nearer than the second on it; found nearer
# than the third, it is taken to touch, farther than the fourth, not to.
_AIR, _TOUCH, _TAKEN_FOR_TOUCH, _TAKEN_FOR_AIR = 0.10, 0.03, 0.06, 0.09


def measure(robot: Robot, name: str, draw: Draw) -> list[Figure]:
    """Frames of the strokes of a draw in which hands in the air and on the body are taken for the other."""
    found = [_distances(robot, one, draw) for one in performed(draw)]
    true, lifted = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return [
        Figure(f"{name}: frames of hands {what}", share(int((is_so & taken).sum()), int(is_so.sum())))
        for what, is_so, taken in (
            ("10 cm or more off the body, lifted onto it", true > _AIR, lifted < _TAKEN_FOR_TOUCH),
            ("on the body, lifted off it", true < _TOUCH, lifted > _TAKEN_FOR_AIR),
        )
    ]


def _distances(robot: Robot, one: Performed, draw: Draw) -> tuple[Array, Array]:
    """Distances of the hands that sign during the stroke: exact, and lifted [m]. Shapes (n,)."""
    smooth = smooth_track(one.track).track
    lifted = lifted_track(pictured(one.track, distance=draw.distance, seed=draw.seed))
    handedness = the_sign(smooth).handedness
    sides = ("right", "left") if handedness == "both" else (handedness,)
    inside: NDArray[np.bool_] = (one.track.times >= one.start) & (one.track.times <= one.end)
    pairs = ((_off_body(robot, one.track, side), _off_body(robot, lifted, side)) for side in sides)
    true, found = zip(*((exact[inside], seen[inside]) for exact, seen in pairs), strict=True)
    return np.concatenate(true), np.concatenate(found)


def _off_body(robot: Robot, track: SkeletonTrack, side: str) -> Array:
    """Distance of a hand's nearest point, its end at the wrist left aside [m]. Shape (T,)."""
    person = measure_person(track)
    smooth = smooth_track(track).track
    body = BodyMap(robot, ArmKinematics(robot), person)
    head = follow_head(robot, head_pose(smooth, person.head_shape), person)
    away = body.distance(person_hand_points(smooth.hand(side).positions), head)
    nearest: Array = np.delete(away, HEEL, axis=1).min(axis=1)
    return nearest
