# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's motion as a motion of a robot.

First the arms are found that come nearest to the person's, as if nothing could touch (`free_motion`); then
they are moved off what they would touch (`retarget_motion`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.hand_geometry import hand_table
from teo_description.humanoid import Humanoid, Side
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_kinematics import (
    ArmKinematics,
    ArmPoses,
    Bounds,
    angles_between,
    arm_bounds,
    mirrored,
    mirrored_hand,
    search_starts,
)
from teo_sign_capture.retarget.arm_residuals import ArmProblem
from teo_sign_capture.retarget.arm_trajectory import solve_arms
from teo_sign_capture.retarget.body_map import BodyMap
from teo_sign_capture.retarget.collision_clearing import clear_arms
from teo_sign_capture.retarget.collision_terms import CollisionModel
from teo_sign_capture.retarget.hand_goals import (
    HandGoals,
    before_folded_arm,
    hand_goals,
    pair_goals,
    to_watcher,
)
from teo_sign_capture.retarget.hand_motion import follow_hand
from teo_sign_capture.retarget.handshapes import (
    HeldShape,
    ShapedHand,
    held_shapes,
    shape_chances,
    with_known_shapes,
)
from teo_sign_capture.retarget.head_motion import HeadMotion, follow_head, follow_trunk
from teo_sign_capture.retarget.place_figures import place_figures
from teo_sign_capture.signing_space import robot_hand_points
from teo_sign_capture.tracks.signer_motion import SignerMotion

_COLUMN = {"right": 0, "left": 1}


@dataclass(frozen=True, kw_only=True, eq=False)
class FreeMotion:
    """What a person did, as TEO would do it if no part of it could touch another. All hands as right hands.

    Attributes:
        chain: TEO's arm.
        body: The map from the person to TEO.
        head: The heads of both.
        hands: TEO's fingers of each side.
        meant: The point of the person's hand whose place counts, of each side, in the axes of the track [m].
            Shape (T, 3).
        goals: What is wanted of the hand of each side.
        problem: What is wanted of the arms, as far as they have room.
        bounds: Lower and upper bounds of each side's arm [rad].
        arms: The arms that come nearest, one after the other [rad]. Shape (T, j or 2 j).
    """

    chain: ArmKinematics
    body: BodyMap
    head: HeadMotion
    hands: dict[Side, ShapedHand]
    meant: dict[Side, Array]
    goals: dict[Side, HandGoals]
    problem: ArmProblem
    bounds: list[Bounds]
    arms: Array

    def arm(self, side: Side, arms: Array) -> Array:
        """The joints of one side among `arms` [rad]. Shape (T, j)."""
        at = self.chain.count * list(self.hands).index(side)
        return arms[:, at : at + self.chain.count]

    def poses(self, side: Side, arms: Array) -> ArmPoses:
        """Where a side's hand is with arms as in `arms`."""
        return self.chain.poses(self.arm(side, arms))


def free_motion(robot: Robot, signer: SignerMotion, *, spelled: bool = False) -> FreeMotion:
    """Find the arms that come nearest to a person's, collisions left aside; see `retarget_motion`."""
    chain, table = ArmKinematics(robot), hand_table(robot)
    head = follow_head(robot, signer.head, signer.person)
    body = BodyMap(robot, chain, signer.person)
    hands, chances = {}, shape_chances(signer.arms)
    for side, arm in signer.arms.items():
        seen = follow_hand(table, signer.times, arm)
        shaped = with_known_shapes(robot, signer.times, chances[side], seen)
        hands[side] = shaped._replace(axes=seen.axes) if spelled else shaped
    points = {side: robot_hand_points(table, hand.axes) for side, hand in hands.items()}
    pair = pair_goals(body, signer.times, signer.arms, points) if len(signer.arms) == 2 else None
    together = 0.0 if pair is None else pair.nearness
    wanted = {side: hand_goals(body, head, arm, points[side], together) for side, arm in signer.arms.items()}
    goals = {side: found for side, (found, _) in wanted.items()}
    problem = ArmProblem(chain, tuple(before_folded_arm(chain, goal) for goal in goals.values()), pair)
    bounds = [arm_bounds(robot.humanoid, side) for side in signer.arms]
    return FreeMotion(
        chain=chain,
        body=body,
        head=head,
        hands=hands,
        meant={side: meant for side, (_, meant) in wanted.items()},
        goals=goals,
        problem=problem,
        bounds=bounds,
        arms=solve_arms(problem, signer.times, bounds, search_starts(robot.humanoid)),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class RobotMotion:
    """TEO doing what a person did, frame by frame, and how far it falls short.

    The errors of the hands are of shape (T, 2), right and left; NaN where that hand takes no part.

    Attributes:
        times: [s]. Shape (T,).
        joints: The m joints that take part: arm and hand of each side that signs; head, trunk if they move.
        positions: Within the limits, clear of the robot's own body [rad]. Shape (T, m).
        place_error: Distance of the hand from where the person's hand belongs on TEO [m].
        seen_place_error: The same across the view of who stands in front [m].
        contact: How much the person's hand is on the body, 0 to 1.
        palm_error: Angle between the ways the palms face [rad].
        finger_error: Angle between the ways from wrist to knuckles [rad].
        flexion_error: Mean over the four fingers of the difference of bends, of one joint's share [rad].
        same_zone: 1 where the hand is in the zone of the person's (`retarget.place_figures`), or 0.
        same_zone_of_middle: The same by the middles of both hands, as if they had no breadth.
        wrong_place: 1 where who watches reads another place than the person's, or 0.
        head_error: Angle by which the head falls short of the person's. Shape (T,) [rad].
        trunk_error: The same of the trunk. Shape (T,) [rad].
        clearance: Smallest distance between parts of the robot. Shape (T,) [m].
        handshapes: That each hand holds, one after the other.
    """

    times: Array
    joints: tuple[str, ...]
    positions: Array
    place_error: Array
    seen_place_error: Array
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
    handshapes: dict[Side, tuple[HeldShape, ...]]


def retarget_motion(robot: Robot, signer: SignerMotion, *, spelled: bool = False) -> RobotMotion:
    """Bring a person's motion onto a robot.

    Args:
        robot: The robot.
        signer: The person.
        spelled: Whether it is a letter, which others differ from by less than handshapes do: hands stay as
            they are seen.

    Raises:
        LutError: "self_collision" if the robot cannot take a posture without touching itself.
    """
    free = free_motion(robot, signer, spelled=spelled)
    humanoid = robot.humanoid
    trunk = follow_trunk(robot, signer.trunk)
    others: dict[str, Array] = {}
    if free.head.moves:
        others |= dict(zip(humanoid.head, free.head.axes.T, strict=True))
    if trunk.moves:
        others |= dict(zip(humanoid.trunk, trunk.axes.T, strict=True))
    hands = tuple(hand.axes for hand in free.hands.values())
    collisions = CollisionModel(robot, free.chain, tuple(free.hands), hands, others)
    arms, clearance = clear_arms(
        free.problem, collisions, signer.times, free.bounds, free.arms, source=signer.source
    )
    joints = tuple(joint for side in free.hands for joint in humanoid.arm(side) + humanoid.hand(side))
    limbs = [_limb(humanoid, side, free.arm(side, arms), hand.axes) for side, hand in free.hands.items()]
    return RobotMotion(
        times=signer.times,
        joints=joints + tuple(others),
        positions=np.concatenate([*limbs, *(values[:, None] for values in others.values())], axis=1),
        **_hand_figures(free, signer, arms),
        head_error=free.head.error,
        trunk_error=trunk.error,
        clearance=clearance,
        handshapes={side: held_shapes(signer.times, hand.chances) for side, hand in free.hands.items()},
    )


def _limb(humanoid: Humanoid, side: Side, arm: Array, hand: Array) -> Array:
    if side == "left":
        arm, hand = mirrored(humanoid, arm), mirrored_hand(humanoid, hand)
    return np.concatenate([arm, hand], axis=1)


def _hand_figures(free: FreeMotion, signer: SignerMotion, arms: Array) -> dict[str, Array]:
    """Errors of the hands, their contacts and places, by the fields of `RobotMotion`. Shapes (T, 2)."""
    found: dict[str, Array] = {}
    moved = free.head.places - signer.person.head
    for side, wanted in free.goals.items():
        poses = free.poses(side, arms)
        hand = poses.points(wanted.local)
        off, ways = hand - wanted.place, to_watcher(free.body.humanoid, wanted.place)
        figures: dict[str, Array | NDArray[np.bool_]] = {
            "place_error": np.linalg.norm(off, axis=1),
            "seen_place_error": np.linalg.norm(off - (off * ways).sum(axis=1, keepdims=True) * ways, axis=1),
            "palm_error": angles_between(poses.rotation[:, :, 2], wanted.palm),
            "finger_error": angles_between(poses.rotation[:, :, 0], wanted.fingers),
            "flexion_error": free.hands[side].error,
            "contact": wanted.contact,
            **place_figures(free.body, signer.person, free.meant[side], moved, hand, side),
        }
        for name, values in figures.items():
            found.setdefault(name, np.full((len(arms), 2), np.nan))[:, _COLUMN[side]] = values
    return found
