# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Arm and hand sought together, for a palm that TEO's arm cannot turn as a person's.

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
from teo_description import RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_description.robot import Robot
from teo_sign_capture.alphabet.spelling_arm import PALM_FRAME, SPELLING_ARM, ArmFit, arm_fits, spelling_bounds
from teo_sign_capture.alphabet.spelling_hand import HandProblem, fit_dextra
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
# Hand before the right breast, back of the hand to the viewer, elbow half out [deg]. Of the valleys that the
# search falls into it is the one in which the fingers can be counted from the front; the others hold the arm
# out sideways, the hand at the hip, or the palm towards the viewer.
_START = np.radians([-78.0, 12.0, 54.0, -50.0, 15.0, 43.0])
# [rad] The search stays within this of `_START`, joint by joint: M, N and Ñ get one arm.
_VALLEY = np.radians(10.0)


def fit_arm_and_hand(robot: Robot, pose: HandPose, place: Array) -> ArmFit:
    """Find the arm, with the hand in mind, for a person's hand whose palm is out of reach.

    Args:
        robot: The robot.
        pose: The person's hand.
        place: Where the middle of the palm should be, in ``base_link`` [m]. Shape (3,).
    """
    hand_limits = joint_limits(RIGHT_HAND)
    arm_lower, arm_upper = spelling_bounds()
    arm_lower, arm_upper = np.maximum(arm_lower, _START - _VALLEY), np.minimum(arm_upper, _START + _VALLEY)
    lower, upper = (
        np.concatenate([arm_lower, hand_limits.lower]),
        np.concatenate([arm_upper, hand_limits.upper]),
    )
    arm_count = len(RIGHT_ARM)

    def palm(arm: Array) -> Array:
        q = robot.configuration(dict(zip(RIGHT_ARM, arm.tolist(), strict=True)))
        return robot.placement(q, PALM_FRAME)

    def residuals(x: Array) -> Array:
        arm, hand = x[:arm_count], x[arm_count:]
        reached = palm(arm)
        away = reached[:3, 3] - place
        return np.concatenate(
            [
                pin.log3(pose.rotation.T @ reached[:3, :3]),
                _PLACE * away,
                [_FAR_WEIGHT * max(0.0, float(np.linalg.norm(away)) - _FAR)],
                _POSTURE * (arm - SPELLING_ARM),
                _HAND * HandProblem(robot, pose, reached[:3, :3]).residuals(hand),
            ]
        )

    guess = fit_dextra(robot, pose, palm(_START)[:3, :3]).positions
    start = np.clip(np.concatenate([_START, guess]), lower + 1e-3, upper - 1e-3)
    fit = least_squares(residuals, start, bounds=(lower, upper), diff_step=1e-3)
    arm = np.clip(fit.x[:arm_count], arm_lower, arm_upper)
    return arm_fits(ArmKinematics(robot), arm[None], pose.rotation[None], place[None])[0]
