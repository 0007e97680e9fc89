# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Places that are nearer to a robot's own shoulder than its elbow folds.

A person's elbow closes until the hand is at the shoulder, TEO's bends by 100 deg: its wrist stays 35 cm away.
A hand that belongs nearer gains nothing by being turned towards a place that it does not reach. Asked for is
the place straight before it, where it is at the same height and side for whom is signed to, turned as the
person's; what is on the body is asked for where it is.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.retarget.arm_bounds import arm_bounds
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.hand_goals import HandGoals


def before_folded_arm(chain: ArmKinematics, goals: HandGoals) -> HandGoals:
    """The goals of a hand, those in the air that the folded arm has no room for moved forwards.

    Args:
        chain: The arm.
        goals: What is wanted, as the person has it.

    Returns:
        The same with other places: a wrist that carries the hand as it is wanted is as far from the shoulder
        as that of the folded arm, or farther.
    """
    folded = np.zeros((1, chain.count))
    folded[0, chain.elbow] = arm_bounds(chain.humanoid, "both")[0 if chain.opens > 0.0 else 1][chain.elbow]
    pose = chain.poses(folded)
    wrist = pose.origins[0, chain.wrist]
    least = np.linalg.norm(wrist - chain.shoulder)
    in_palm = pose.rotation[0].T @ (wrist - pose.place[0])
    turns = np.stack([goals.fingers, np.cross(goals.palm, goals.fingers), goals.palm], axis=2)
    wrists = goals.place + np.einsum("tij,tj->ti", turns, in_palm - goals.local)
    forwards = (1.0 - goals.contact) * _way_out(wrists - chain.shoulder, float(least))
    return replace(goals, place=goals.place + forwards[:, None] * np.array([1.0, 0.0, 0.0]))


def _way_out(points: Array, radius: float) -> Array:
    """How far forwards points within a ball about the origin leave it; 0 of those outside [m]. Shape (T,)."""
    room = radius**2 - (points**2).sum(axis=1)
    way: Array = np.sqrt(points[:, 0] ** 2 + np.maximum(room, 0.0)) - points[:, 0]
    return np.where(room > 0.0, way, 0.0)
