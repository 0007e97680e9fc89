# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Figures that every captured sign carries."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid
from teo_description.robot import Robot

# Poses from one knot to the next at which the clearance is measured.
_SAMPLES = 5


def least_clearance(robot: Robot, joints: tuple[str, ...], knots: Sequence[Array] | Array) -> float:
    """Smallest distance between parts of a robot over a motion in straight lines between its knots [m].

    Args:
        robot: The robot; joints not named are at home.
        joints: Names of the m joints that move.
        knots: Positions [rad]. Shape (n, m).
    """
    steps = np.linspace(0.0, 1.0, _SAMPLES, endpoint=False)
    poses = [first + step * (second - first) for first, second in pairwise(knots) for step in steps]
    return min(
        robot.clearance(robot.configuration(dict(zip(joints, pose.tolist(), strict=True)))).distance
        for pose in (*poses, knots[-1])
    )


def clearance_mm(robot: Robot, joints: tuple[str, ...], knots: Array) -> float:
    """`least_clearance` as entries give it [mm]."""
    return round(1000.0 * least_clearance(robot, joints, knots), 1)


def limit_margin_deg(humanoid: Humanoid, joints: tuple[str, ...], knots: Array) -> float:
    """Smallest distance of arm, head and trunk joints from their limits [deg].

    Fingers do not count: a straight one is at its limit by nature.
    """
    body = [index for index, joint in enumerate(joints) if joint in humanoid.body_joints]
    limits = humanoid.limits(joints)
    margins = np.minimum(knots - limits.lower, limits.upper - knots)[:, body]
    return round(float(np.degrees(margins.min())), 1)
