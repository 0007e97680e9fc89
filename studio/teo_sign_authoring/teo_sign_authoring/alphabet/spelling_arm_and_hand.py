# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Arm and hand sought together, for a palm that a robot's arm cannot turn as a person's.

TEO's wrist bends the hand sideways only (its axis is the palm's normal), where a person's bends it down as
well. Letters that hang from the wrist (M, N, Ñ) are therefore out of reach near the face. What can be had is
fingers that point as the person's do: palm, place and fingers are then traded against each other in one least
squares problem.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from scipy.optimize import least_squares

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.spelling_arm import ArmFit, arm_fits, spelling_bounds
from teo_sign_authoring.alphabet.spelling_hand import HandProblem, fit_robot_hand
from teo_sign_capture.retarget.arm_bounds import spelling_arm
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.tracks.hand_model import HandPose

# [1/cm] Weight of a centimetre at a finger tip: about the angle in radians under which a finger's length sees
# it.
_HAND = 0.1
# [rad/m] Weight of the place, as long as it is near.
_PLACE = 1.0
# [m], [rad/m] Beyond this from where a letter belongs the place counts before anything else.
_FAR, _FAR_WEIGHT = 0.30, 20.0
_POSTURE = 0.03
# [rad] The search stays within this of where it begins, joint by joint: letters that hang get one arm.
_VALLEY = np.radians(10.0)


def fit_arm_and_hand(robot: Robot, pose: HandPose, place: Array, near: ArmFit) -> ArmFit:
    """Find the arm, with the hand in mind, for a person's hand whose palm is out of reach.

    Args:
        robot: The robot.
        pose: The person's hand.
        place: Where the middle of the palm should be, in ``base_link`` [m]. Shape (3,).
        near: The arm that comes nearest by itself, for a robot of which none is known for hands that hang.
    """
    humanoid, chain = robot.humanoid, ArmKinematics(robot)
    joints, hand_limits, easy = (
        humanoid.arm("right"),
        humanoid.limits(humanoid.hand("right")),
        spelling_arm(humanoid),
    )
    known = humanoid.file.signing_arms
    begin = near.positions if known is None else np.radians(known.hanging_deg)
    arm_lower, arm_upper = spelling_bounds(chain)
    arm_lower, arm_upper = np.maximum(arm_lower, begin - _VALLEY), np.minimum(arm_upper, begin + _VALLEY)
    lower, upper = (
        np.concatenate([arm_lower, hand_limits.lower]),
        np.concatenate([arm_upper, hand_limits.upper]),
    )
    arm_count = chain.count

    def palm(arm: Array) -> Array:
        q = robot.configuration(dict(zip(joints, arm.tolist(), strict=True)))
        return robot.placement(q, humanoid.file.hand.palm)

    def residuals(x: Array) -> Array:
        arm, hand = x[:arm_count], x[arm_count:]
        reached = palm(arm)
        away = reached[:3, 3] - place
        return np.concatenate(
            [
                pin.log3(pose.rotation.T @ reached[:3, :3]),
                _PLACE * away,
                [_FAR_WEIGHT * max(0.0, float(np.linalg.norm(away)) - _FAR)],
                _POSTURE * (arm - easy),
                _HAND * HandProblem(robot, pose, reached[:3, :3]).residuals(hand),
            ]
        )

    guess = fit_robot_hand(robot, pose, palm(begin)[:3, :3]).positions
    start = np.clip(np.concatenate([begin, guess]), lower + 1e-3, upper - 1e-3)
    fit = least_squares(residuals, start, bounds=(lower, upper), diff_step=1e-3)
    arm = np.clip(fit.x[:arm_count], arm_lower, arm_upper)
    return arm_fits(chain, arm[None], pose.rotation[None], place[None])[0]
