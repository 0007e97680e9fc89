# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What both hands show over a sign, the same of a table's sign and of a person's demonstration.

In each frame, of each hand: where the palm is, the ways palm and fingers point, how the fingers are bent. A
person's places are those that they have on TEO (`BodyMap`), so that bodies of any size are compared; no arm
is solved for it, which takes most of the time of a capture. All is in differences that are just seen
(`teo_signs.likeness`), places in the air excepted: see `_PLACE`.
"""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_description import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND
from teo_description.hand_geometry import dextra_table
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_bounds import Side, mirrored
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.body_map import BodyMap
from teo_sign_capture.retarget.hand_goals import hand_goals
from teo_sign_capture.retarget.hand_motion import follow_hand
from teo_sign_capture.retarget.head_motion import follow_head
from teo_sign_capture.retarget.robot_motion import arm_keypoints, hand_keypoints
from teo_sign_capture.signing_space.hand_points import MIRROR, teo_hand_points
from teo_sign_capture.tracks.head_pose import head_pose
from teo_sign_capture.tracks.person import Person, measure_person
from teo_sign_capture.tracks.segmentation import the_sign
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_sign_capture.tracks.smoothing import smooth_track
from teo_signs.likeness import SEEN_ANGLE, SEEN_PLACE
from teo_signs.sign import Sign
from teo_signs.sign_schema import Handedness

# Moments of a sign, evenly spread: of a sign of 1.5 s every 50 ms.
MOMENTS = 32
# [m] Unit of places: TEO's hands are 6 cm from where a person's belong in half of the table's signs, which is
# two neighbouring places on the face.
_PLACE = 2.0 * SEEN_PLACE
# [rad] Unit of ways of palm and fingers: TEO's wrist bends to the side only, and costs twice what is seen.
_TURN = 2.0 * SEEN_ANGLE
# [rad] Unit of bends: two thirds of a right angle. The six axes together count as one way, and TEO's coupled
# joints bend otherwise than a person's. Of 1, 2 and 4 times what is seen the best on the 50 performances
# that `bench/recognition.py` names as tuned on.
_BEND = 4.0 * SEEN_ANGLE
# What a hand that takes part differs by from one that does not [units].
_PRESENT = 4.0
# Numbers of a hand: presence, place, way of the palm, way of the fingers, six bends.
HAND = 1 + 3 + 3 + 3 + 6


class PARTS:
    """Where the parts of a hand are among its numbers."""

    presence = 0
    place = slice(1, 4)
    turns = slice(4, 10)
    bends = slice(10, HAND)


def sign_appearance(robot: Robot, sign: Sign) -> Array:
    """What a sign of the table shows. Shape (MOMENTS, 2 hands of 16 numbers)."""
    moments = np.linspace(0.0, sign.duration, MOMENTS)
    positions = np.column_stack([np.interp(moments, sign.times, column) for column in sign.knots.T])
    chain = ArmKinematics(robot)
    hands: dict[str, Array] = {}
    for side, arm, hand in (("right", RIGHT_ARM, RIGHT_HAND), ("left", LEFT_ARM, LEFT_HAND)):
        if not set(arm + hand) <= set(sign.joints):
            continue
        joints = positions[:, [sign.joints.index(joint) for joint in arm]]
        poses = chain.poses(joints if side == "right" else mirrored(joints))
        bends = positions[:, [sign.joints.index(joint) for joint in hand]]
        hands[side] = _hand(poses.place, poses.rotation[:, :, 2], poses.rotation[:, :, 0], bends)
    return _both(hands)


def recording_appearance(
    robot: Robot,
    track: SkeletonTrack,
    *,
    start: float | None = None,
    end: float | None = None,
    handedness: Handedness | None = None,
) -> Array:
    """What the one sign of a recording shows. Shape (MOMENTS, 2 hands of 16 numbers).

    Args:
        robot: The robot.
        track: The person, as recorded.
        start: Where to begin looking [s]; the recording's beginning without.
        end: Where to stop [s]; the recording's end without.
        handedness: Hands that make the sign; those that leave rest without.

    Raises:
        LutError: "empty_track", "no_motion", "several_signs", "too_long", "no_arm" or "no_hand".
    """
    first, last = 0.0 if start is None else start, float(track.times[-1]) if end is None else end
    smooth = smooth_track(track.between(first, last)).track
    span = the_sign(smooth, offset=first, cut_start=start is not None, cut_end=end is not None)
    return demonstration_appearance(
        robot,
        smooth.between(span.start, span.end),
        handedness=handedness or span.handedness,
        person=measure_person(track),
    )


def demonstration_appearance(
    robot: Robot, track: SkeletonTrack, *, handedness: Handedness, person: Person
) -> Array:
    """What a person shows. Shape (MOMENTS, 2 hands of 16 numbers).

    Args:
        robot: The robot.
        track: The stroke, smoothed.
        handedness: The hands that take part. A left hand alone is taken for the right one in a mirror, as
            left-handed signers sign.
        person: The person's measures.

    Raises:
        LutError: "no_arm" or "no_hand" if what is needed was never seen.
    """
    chain, table = ArmKinematics(robot), dextra_table(robot)
    head = follow_head(robot, head_pose(track, person.head_shape), person)
    body = BodyMap(robot, chain, person)
    moments = np.linspace(0.0, float(track.times[-1]), MOMENTS)
    hands: dict[str, Array] = {}
    sides: tuple[Side, ...] = ("right", "left") if handedness == "both" else (handedness,)
    for side in sides:
        points = hand_keypoints(track, side)
        flip = np.ones(3) if side == "right" else MIRROR
        bends = follow_hand(table, track.times, points * flip, person.straight).axes
        teo = teo_hand_points(table, bends)
        goals = hand_goals(body, head, side, points, arm_keypoints(track, side), teo)
        across = np.cross(goals.palm, goals.fingers)
        rotation = np.stack([goals.fingers, across, goals.palm], axis=2)
        place = goals.place - np.einsum("tij,tj->ti", rotation, goals.local)
        shown = _hand(place, goals.palm, goals.fingers, bends)
        hands[side] = np.column_stack([np.interp(moments, track.times, column) for column in shown.T])
    return _both(hands)


def _hand(place: Array, palm: Array, fingers: Array, bends: Array) -> Array:
    present = np.full((len(place), 1), _PRESENT)
    return np.concatenate([present, place / _PLACE, palm / _TURN, fingers / _TURN, bends / _BEND], axis=1)


def _both(hands: dict[str, Array]) -> Array:
    """The leading hand and the other; zeros of one that takes no part."""
    absent = np.zeros((MOMENTS, HAND))
    if "right" not in hands:
        return np.concatenate([hands.get("left", absent), absent], axis=1)
    return np.concatenate([hands["right"], hands.get("left", absent)], axis=1)
