# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's motion as a motion of TEO."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description import HEAD, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, TRUNK
from teo_description.hand_geometry import dextra_table
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_bounds import Side, arm_bounds, mirrored
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, angles_between
from teo_sign_capture.retarget.arm_residuals import JOINTS, ArmProblem
from teo_sign_capture.retarget.arm_trajectory import solve_arms
from teo_sign_capture.retarget.body_map import BodyMap
from teo_sign_capture.retarget.collision_clearing import clear_arms
from teo_sign_capture.retarget.collision_terms import CollisionModel
from teo_sign_capture.retarget.folded_arm import before_folded_arm
from teo_sign_capture.retarget.hand_goals import HandGoals, hand_goals, pair_goals, point_that_counts
from teo_sign_capture.retarget.hand_motion import HandMotion, follow_hand
from teo_sign_capture.retarget.head_motion import follow_head, follow_trunk
from teo_sign_capture.retarget.place_figures import place_figures
from teo_sign_capture.signing_space.hand_points import MIRROR, teo_hand_points
from teo_sign_capture.tracks.body_axes import filled
from teo_sign_capture.tracks.head_pose import head_pose
from teo_sign_capture.tracks.person import Person, measure_person
from teo_sign_capture.tracks.skeleton_track import ELBOW, HAND, SHOULDER, WRIST, SkeletonTrack
from teo_signs.errors import LutError
from teo_signs.sign_schema import Handedness

_SIDES: dict[Handedness, tuple[Side, ...]] = {
    "right": ("right",),
    "left": ("left",),
    "both": ("right", "left"),
}
_COLUMN = {"right": 0, "left": 1}
_JOINTS = {"right": RIGHT_ARM + RIGHT_HAND, "left": LEFT_ARM + LEFT_HAND}


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
    sides = _SIDES[handedness]
    chain, table = ArmKinematics(robot), dextra_table(robot)
    hands = {side: hand_keypoints(track, side) for side in sides}
    person = person or measure_person(track)
    head = follow_head(robot, head_pose(track, person.head_shape), person)
    trunk = follow_trunk(np.zeros((len(track.times), 3)) if track.trunk is None else track.trunk)
    body = BodyMap(robot, chain, person)
    shapes = {
        side: follow_hand(table, track.times, hand if side == "right" else hand * MIRROR, person.straight)
        for side, hand in hands.items()
    }
    points = {side: teo_hand_points(table, shape.axes) for side, shape in shapes.items()}
    limbs = {side: arm_keypoints(track, side) for side in sides}
    goals = tuple(hand_goals(body, head, side, hands[side], limbs[side], points[side]) for side in sides)
    pair = None
    if handedness == "both":
        both = ((of["right"], of["left"]) for of in (hands, limbs, points))
        pair = pair_goals(body, track.times, *both)
    problem = ArmProblem(chain, tuple(before_folded_arm(chain, wanted) for wanted in goals), pair)
    bounds = [arm_bounds(side) for side in sides]
    others: dict[str, Array] = {}
    if head.moves:
        others |= dict(zip(HEAD, head.axes.T, strict=True))
    if trunk.moves:
        others |= dict(zip(TRUNK, trunk.axes.T, strict=True))
    collisions = CollisionModel(robot, chain, sides, tuple(shapes[side].axes for side in sides), others)
    arms = solve_arms(problem, track.times, bounds)
    arms, clearance = clear_arms(problem, collisions, track, bounds, arms)
    joints = tuple(joint for side in sides for joint in _JOINTS[side]) + tuple(others)
    parts = [_limb(side, arms[:, at : at + JOINTS], shapes[side]) for at, side in _starts(sides)]
    figures = _hand_figures(chain, sides, goals, shapes, arms)
    for (at, side), wanted in zip(_starts(sides), goals, strict=True):
        hand = chain.poses(arms[:, at : at + JOINTS]).points(wanted.local)
        meant = point_that_counts(body, head, hands[side])
        found = place_figures(body, person, meant, head.places - person.head, hand, side)
        figures["same_zone"][:, _COLUMN[side]] = found.same
        figures["wrong_place"][:, _COLUMN[side]] = found.wrong
    return RobotMotion(
        times=track.times,
        joints=joints,
        positions=np.concatenate([*parts, *(values[:, None] for values in others.values())], axis=1),
        **figures,
        head_error=head.error,
        trunk_error=trunk.error,
        clearance=clearance,
    )


def hand_keypoints(track: SkeletonTrack, side: str) -> Array:
    """A hand's keypoints, gaps filled. Shape (T, 21, 3)."""
    hand = track.hand(side).positions
    seen = np.isfinite(hand).all(axis=2).any(axis=0)
    if not seen.all():
        raise LutError(
            "no_hand",
            f"{track.source}: expected a {side} hand with its {HAND} keypoints, got {seen.sum()} of them in "
            f"{len(hand)} frames: was it in the picture?",
        )
    return np.stack([filled(track.times, keypoint) for keypoint in hand.transpose(1, 0, 2)], axis=1)


def arm_keypoints(track: SkeletonTrack, side: str) -> Array:
    """Shoulder, elbow and wrist, gaps filled. Shape (T, 3, 3)."""
    joints = track.body.positions[:, (SHOULDER[side], ELBOW[side], WRIST[side])]
    flat = joints.reshape(len(joints), -1)
    if not np.isfinite(flat).all(axis=1).any():
        raise LutError(
            "no_arm",
            f"{track.source}: expected a {side} arm with its shoulder, elbow and wrist, got none in "
            f"{len(joints)} frames: was it in the picture?",
        )
    return filled(track.times, flat).reshape(joints.shape)


def _starts(sides: tuple[Side, ...]) -> list[tuple[int, Side]]:
    return [(JOINTS * index, side) for index, side in enumerate(sides)]


def _limb(side: str, arm: Array, hand: HandMotion) -> Array:
    if side == "left":
        arm = mirrored(arm)
    return np.concatenate([arm, hand.axes], axis=1)


def _hand_figures(
    chain: ArmKinematics,
    sides: tuple[Side, ...],
    goals: tuple[HandGoals, ...],
    shapes: dict[Side, HandMotion],
    arms: Array,
) -> dict[str, Array]:
    """Errors of the hands and their contacts, by the fields of `RobotMotion`; zones are not known yet."""
    errors = ("place_error", "palm_error", "finger_error", "flexion_error")
    places = ("contact", "same_zone", "wrong_place")
    found = {name: np.full((len(arms), 2), np.nan) for name in (*errors, *places)}
    for (at, side), wanted in zip(_starts(sides), goals, strict=True):
        column = _COLUMN[side]
        poses = chain.poses(arms[:, at : at + JOINTS])
        away = np.linalg.norm(poses.points(wanted.local) - wanted.place, axis=1)
        found["place_error"][:, column] = away
        found["palm_error"][:, column] = angles_between(poses.rotation[:, :, 2], wanted.palm)
        found["finger_error"][:, column] = angles_between(poses.rotation[:, :, 0], wanted.fingers)
        found["flexion_error"][:, column] = shapes[side].error
        found["contact"][:, column] = wanted.contact
    return found
