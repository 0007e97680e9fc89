# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's motion on a robot as if nothing could touch: what is wanted, and the arms that come nearest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import hand_table
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_bounds import Bounds, Side, arm_bounds, search_starts
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, ArmPoses
from teo_sign_capture.retarget.arm_residuals import ArmProblem
from teo_sign_capture.retarget.arm_trajectory import solve_arms
from teo_sign_capture.retarget.body_map import BodyMap
from teo_sign_capture.retarget.folded_arm import before_folded_arm
from teo_sign_capture.retarget.hand_goals import HandGoals, hand_goals, pair_goals
from teo_sign_capture.retarget.hand_motion import HandMotion, follow_hand
from teo_sign_capture.retarget.head_motion import HeadMotion, follow_head
from teo_sign_capture.signing_space.hand_points import MIRROR, robot_hand_points
from teo_sign_capture.tracks.body_axes import filled
from teo_sign_capture.tracks.head_pose import head_pose
from teo_sign_capture.tracks.person import Person
from teo_sign_capture.tracks.skeleton_track import ELBOW, HAND, SHOULDER, WRIST, SkeletonTrack
from teo_signs.errors import LutError
from teo_signs.sign_schema import Handedness

_SIDES: dict[Handedness, tuple[Side, ...]] = {
    "right": ("right",),
    "left": ("left",),
    "both": ("right", "left"),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class FreeMotion:
    """What a person did, as TEO would do it if no part of it could touch another. All hands as right hands.

    Attributes:
        sides: The hands that take part.
        chain: TEO's arm.
        body: The map from the person to TEO.
        head: The heads of both.
        keypoints: The person's hand of each side, gaps filled [m]. Shape (T, 21, 3).
        shapes: TEO's fingers of each side.
        goals: What is wanted of the hand of each side.
        problem: What is wanted of the arms, as far as they have room.
        bounds: Lower and upper bounds of each side's arm [rad].
        arms: The arms that come nearest, one after the other [rad]. Shape (T, j or 2 j).
    """

    sides: tuple[Side, ...]
    chain: ArmKinematics
    body: BodyMap
    head: HeadMotion
    keypoints: dict[Side, Array]
    shapes: dict[Side, HandMotion]
    goals: dict[Side, HandGoals]
    problem: ArmProblem
    bounds: list[Bounds]
    arms: Array

    def poses(self, side: Side, arms: Array) -> ArmPoses:
        """Where a side's hand is with arms as in `arms`."""
        at = self.chain.count * self.sides.index(side)
        return self.chain.poses(arms[:, at : at + self.chain.count])


def free_motion(robot: Robot, track: SkeletonTrack, *, handedness: Handedness, person: Person) -> FreeMotion:
    """Find the arms that come nearest to a person's, collisions left aside.

    Args:
        robot: The robot.
        track: The person; smoothed, as what trembles in it trembles in TEO.
        handedness: The hands that take part.
        person: The person's measures.

    Raises:
        LutError: "no_arm" or "no_hand" if what is needed was never seen.
    """
    sides = _SIDES[handedness]
    chain, table = ArmKinematics(robot), hand_table(robot)
    hands = {side: _hand_keypoints(track, side) for side in sides}
    limbs = {side: _arm_keypoints(track, side) for side in sides}
    head = follow_head(robot, head_pose(track, person.head_shape), person)
    body = BodyMap(robot, chain, person)
    shapes = {
        side: follow_hand(table, track.times, hand if side == "right" else hand * MIRROR, person.straight)
        for side, hand in hands.items()
    }
    points = {side: robot_hand_points(table, shape.axes) for side, shape in shapes.items()}
    goals = {side: hand_goals(body, head, side, hands[side], limbs[side], points[side]) for side in sides}
    pair = None
    if handedness == "both":
        both = ((of["right"], of["left"]) for of in (hands, limbs, points))
        pair = pair_goals(body, track.times, *both)
    problem = ArmProblem(chain, tuple(before_folded_arm(chain, goals[side]) for side in sides), pair)
    bounds = [arm_bounds(robot.humanoid, side) for side in sides]
    return FreeMotion(
        sides=sides,
        chain=chain,
        body=body,
        head=head,
        keypoints=hands,
        shapes=shapes,
        goals=goals,
        problem=problem,
        bounds=bounds,
        arms=solve_arms(problem, track.times, bounds, search_starts(robot.humanoid)),
    )


def _hand_keypoints(track: SkeletonTrack, side: str) -> Array:
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


def _arm_keypoints(track: SkeletonTrack, side: str) -> Array:
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
