# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What both hands show over a sign, the same of a table's sign and of a person's demonstration.

In each frame, of each hand: where the palm is, the ways palm and fingers point, how the fingers are bent. A
person's hand is taken half-way between where it belongs on TEO (`BodyMap`) and where TEO's arm brings it,
collisions left aside, which take most of the time of a capture. Signs that were written down are nearer to
the one, signs that were captured are the other; where TEO's arm falls short both are 20 cm apart.

Numbers are in units of what a person's sign differs by from its own entry: what a film of one camera tells
badly, as how far forward a hand is, counts less than what it tells well, as which fingers are bent. Of units
around what was measured of known takes (`bench/recognition.py`) those by which the right entry is nearest.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import SIDES
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, ArmPoses, mirrored, mirrored_hand
from teo_sign_capture.retarget.hand_goals import HandGoals
from teo_sign_capture.retarget.robot_motion import free_motion
from teo_sign_capture.tracks.person import measure_person
from teo_sign_capture.tracks.segmentation import the_sign
from teo_sign_capture.tracks.signer_motion import SignerMotion, signer_motion
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_sign_capture.tracks.smoothing import smooth_track
from teo_signs.sign import Sign
from teo_signs.sign_schema import Handedness

# Moments of a sign, evenly spread: of a sign of 1.5 s every 50 ms.
MOMENTS = 32
# [m] Units of places forwards, left and up. Forwards is what a film does not show, and where TEO's hand goes
# if its elbow does not fold as far as a person's.
_PLACE = np.array([0.16, 0.056, 0.056])
# [rad] Units of the ways of palm and fingers. TEO's wrist bends to the side only, for which the fingers pay.
_PALM, _FINGERS = 0.35, 0.6
# [rad] Units of the bends: of the thumb's two axes, whose joints are the farthest from a person's, and of the
# four fingers.
_BENDS = np.array([0.6, 0.6, 0.35, 0.35, 0.35, 0.35])
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
    chain = _arm_of(robot)
    hands: dict[str, Array] = {}
    humanoid = robot.humanoid
    for side in SIDES:
        arm, hand = humanoid.arm(side), humanoid.hand(side)
        if not set(arm + hand) <= set(sign.joints):
            continue
        joints = positions[:, [sign.joints.index(joint) for joint in arm]]
        bends = positions[:, [sign.joints.index(joint) for joint in hand]]
        if side == "left":
            joints, bends = mirrored(humanoid, joints), mirrored_hand(humanoid, bends)
        poses = chain.poses(joints)
        hands[side] = _of_arm(poses, bends)
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
    stroke = smooth.between(span.start, span.end)
    signer = signer_motion(stroke, handedness=handedness or span.handedness, person=measure_person(track))
    return _demonstration_appearance(robot, signer)


def _demonstration_appearance(robot: Robot, signer: SignerMotion) -> Array:
    """What a person shows. Shape (MOMENTS, 2 hands of 16 numbers).

    A left hand alone is taken for the right one in a mirror, as left-handed signers sign.
    """
    free = free_motion(robot, signer)
    moments = np.linspace(0.0, float(signer.times[-1]), MOMENTS)
    hands: dict[str, Array] = {}
    for side, hand in free.hands.items():
        bends = hand.axes
        shown = (_wanted(free.goals[side], bends) + _of_arm(free.poses(side, free.arms), bends)) / 2.0
        hands[side] = np.column_stack([np.interp(moments, signer.times, column) for column in shown.T])
    return _both(hands)


@cache
def _arm_of(robot: Robot) -> ArmKinematics:
    """Made once: for each sign of a table it would take more than half of its time."""
    return ArmKinematics(robot)


def _wanted(goals: HandGoals, bends: Array) -> Array:
    """A hand where it belongs. Shape (T, HAND)."""
    rotation = np.stack([goals.fingers, np.cross(goals.palm, goals.fingers), goals.palm], axis=2)
    place = goals.place - np.einsum("tij,tj->ti", rotation, goals.local)
    return _hand(place, goals.palm, goals.fingers, bends)


def _of_arm(poses: ArmPoses, bends: Array) -> Array:
    """A hand where an arm has it. Shape (T, HAND)."""
    return _hand(poses.place, poses.rotation[:, :, 2], poses.rotation[:, :, 0], bends)


def _hand(place: Array, palm: Array, fingers: Array, bends: Array) -> Array:
    present = np.full((len(place), 1), _PRESENT)
    return np.concatenate([present, place / _PLACE, palm / _PALM, fingers / _FINGERS, bends / _BENDS], axis=1)


def _both(hands: dict[str, Array]) -> Array:
    """The leading hand and the other; zeros of one that takes no part."""
    absent = np.zeros((MOMENTS, HAND))
    if "right" not in hands:
        return np.concatenate([hands.get("left", absent), absent], axis=1)
    return np.concatenate([hands["right"], hands.get("left", absent)], axis=1)
