# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's motion as a motion of TEO."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_bounds import Side, mirrored, mirrored_hand
from teo_sign_capture.retarget.arm_kinematics import angles_between
from teo_sign_capture.retarget.collision_clearing import clear_arms
from teo_sign_capture.retarget.collision_terms import CollisionModel
from teo_sign_capture.retarget.free_motion import FreeMotion, free_motion
from teo_sign_capture.retarget.hand_goals import point_that_counts
from teo_sign_capture.retarget.head_motion import follow_trunk
from teo_sign_capture.retarget.place_figures import place_figures
from teo_sign_capture.tracks.person import Person, measure_person
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_signs.sign_schema import Handedness

_COLUMN = {"right": 0, "left": 1}


@dataclass(frozen=True, kw_only=True, eq=False)
class RobotMotion:
    """TEO doing what a person did, frame by frame, and how far it falls short.

    The errors of the hands are of shape (T, 2), right and left; NaN where that hand takes no part.

    Attributes:
        times: [s]. Shape (T,).
        joints: The m joints that take part: arm and hand of each side that signs; head, trunk if they move.
        positions: Within the limits, clear of the robot's own body [rad]. Shape (T, m).
        place_error: Distance of the hand from where the person's hand belongs on TEO [m].
        contact: How much the person's hand is on the body, 0 to 1.
        palm_error: Angle between the ways the palms face [rad].
        finger_error: Angle between the ways from wrist to knuckles [rad].
        flexion_error: Mean over the four fingers of the difference of bends, of one joint's share [rad].
        same_zone: 1 where the hand is in the zone of the person's (`signing_space.major_place`), or 0.
        same_zone_of_middle: The same by the middles of both hands, as if they had no breadth.
        wrong_place: 1 where who watches reads another place than the person's, or 0.
        head_error: Angle by which the head falls short of the person's. Shape (T,) [rad].
        trunk_error: The same of the trunk. Shape (T,) [rad].
        clearance: Smallest distance between parts of the robot. Shape (T,) [m].
    """

    times: Array
    joints: tuple[str, ...]
    positions: Array
    place_error: Array
    contact: Array
    palm_error: Array
    finger_error: Array
    flexion_error: Array
    same_zone: Array
    same_zone_of_middle: Array
    wrong_place: Array
    head_error: Array
    trunk_error: Array
    clearance: Array


def retarget_motion(
    robot: Robot, track: SkeletonTrack, *, handedness: Handedness, person: Person | None = None
) -> RobotMotion:
    """Bring a person's motion onto TEO.

    Args:
        robot: The robot.
        track: The person; smoothed, as what trembles in it trembles in TEO.
        handedness: The hands that take part.
        person: The person's measures, best from a whole recording of which the track is a part; measured on
            the track itself without.

    Raises:
        LutError: "no_arm" or "no_hand" if what is needed was never seen, "self_collision" if TEO cannot take
            a posture without touching itself.
    """
    person = person or measure_person(track)
    free = free_motion(robot, track, handedness=handedness, person=person)
    humanoid = robot.humanoid
    trunk = follow_trunk(robot, np.zeros((len(track.times), 3)) if track.trunk is None else track.trunk)
    others: dict[str, Array] = {}
    if free.head.moves:
        others |= dict(zip(humanoid.head, free.head.axes.T, strict=True))
    if trunk.moves:
        others |= dict(zip(humanoid.trunk, trunk.axes.T, strict=True))
    fingers = tuple(free.shapes[side].axes for side in free.sides)
    collisions = CollisionModel(robot, free.chain, free.sides, fingers, others)
    arms, clearance = clear_arms(free.problem, collisions, track, free.bounds, free.arms)
    joints = tuple(joint for side in free.sides for joint in humanoid.arm(side) + humanoid.hand(side))
    joints += tuple(others)
    count = free.chain.count
    parts = [
        _limb(humanoid, side, arms[:, count * at : count * (at + 1)], free.shapes[side].axes)
        for at, side in enumerate(free.sides)
    ]
    return RobotMotion(
        times=track.times,
        joints=joints,
        positions=np.concatenate([*parts, *(values[:, None] for values in others.values())], axis=1),
        **_hand_figures(free, person, arms),
        head_error=free.head.error,
        trunk_error=trunk.error,
        clearance=clearance,
    )


def _limb(humanoid: Humanoid, side: Side, arm: Array, hand: Array) -> Array:
    if side == "left":
        arm, hand = mirrored(humanoid, arm), mirrored_hand(humanoid, hand)
    return np.concatenate([arm, hand], axis=1)


def _hand_figures(free: FreeMotion, person: Person, arms: Array) -> dict[str, Array]:
    """Errors of the hands, their contacts and places, by the fields of `RobotMotion`. Shapes (T, 2)."""
    names = (
        "place_error",
        "palm_error",
        "finger_error",
        "flexion_error",
        "contact",
        "same_zone",
        "same_zone_of_middle",
        "wrong_place",
    )
    found = {name: np.full((len(arms), 2), np.nan) for name in names}
    for side in free.sides:
        column, wanted, poses = _COLUMN[side], free.goals[side], free.poses(side, arms)
        hand = poses.points(wanted.local)
        found["place_error"][:, column] = np.linalg.norm(hand - wanted.place, axis=1)
        found["palm_error"][:, column] = angles_between(poses.rotation[:, :, 2], wanted.palm)
        found["finger_error"][:, column] = angles_between(poses.rotation[:, :, 0], wanted.fingers)
        found["flexion_error"][:, column] = free.shapes[side].error
        found["contact"][:, column] = wanted.contact
        meant = point_that_counts(free.body, free.head, free.keypoints[side])
        places = place_figures(free.body, person, meant, free.head.places - person.head, hand, side)
        found["same_zone"][:, column] = places.same
        found["same_zone_of_middle"][:, column] = places.middles_same
        found["wrong_place"][:, column] = places.wrong
    return found
