# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where the hand is and how the palm is turned, on TEO's right arm: letters and numbers.

Where a palm is out of reach its orientation goes before the place.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_bounds import Bounds, arm_bounds
from teo_sign_capture.retarget.arm_kinematics import ELBOW, ArmKinematics
from teo_sign_capture.retarget.arm_residuals import JOINTS, ArmProblem, ArmWeights
from teo_sign_capture.retarget.arm_search import search_arms
from teo_sign_capture.retarget.hand_goals import HandGoals

PALM_FRAME = "right_palm"

# [rad] Mean of the poses in which TEO's own demonstration spells T, E and O. Shape (6,).
SPELLING_ARM = np.radians([-74.0, 11.2, 11.1, -80.5, 48.9, 1.1])

# The elbow is bent by as much at least [rad]: nobody spells with a straight arm.
_BENT = np.radians(-46.0)

_WEIGHTS = ArmWeights(
    # The palm 10 cm out of place counts as much as 11 deg out of orientation.
    in_air=np.full(3, 2.0),
    on_body=2.0,
    # A turn counts by about its angle: both directions together change by sqrt(1 + n^2) of it, n being the
    # share of its axis to the little finger's side.
    palm=0.77,
    fingers=0.77,
    # Chooses among equals, moves a reachable hand by less than 1 deg.
    easy=np.full(JOINTS, 0.03),
    easy_arm=SPELLING_ARM,
)


@dataclass(frozen=True, kw_only=True)
class ArmFit:
    """A pose of the arm.

    Attributes:
        positions: The joints of `RIGHT_ARM` [rad]. Shape (6,).
        palm: Orientation reached. Shape (3, 3).
        place: Middle of the palm reached, in ``base_link`` [m]. Shape (3,).
        angle_error: Angle between the orientation reached and the one wanted [rad].
        place_error: Distance from the place wanted [m].
    """

    positions: Array
    palm: Array
    place: Array
    angle_error: float
    place_error: float


def spelling_bounds(*, both_sides: bool = False) -> Bounds:
    """Lower and upper bounds of an arm that spells [rad]. Shapes (6,).

    Args:
        both_sides: Whether the left arm must be able to mirror the pose.
    """
    lower, upper = arm_bounds("both" if both_sides else "right")
    return lower, np.where(np.arange(JOINTS) == ELBOW, np.minimum(upper, _BENT), upper)


def fit_arm(robot: Robot, palm: Array, place: Array, *, both_sides: bool = False) -> ArmFit:
    """Find the arm that holds the palm so, from all starts.

    Args:
        robot: The robot; head and trunk are at home.
        palm: Orientation wanted; columns along, to the little finger's side, out of the palm. Shape (3, 3).
        place: Where the middle of the palm should be, in ``base_link`` [m]. Shape (3,).
        both_sides: Whether the left arm must be able to mirror the pose.
    """
    chain = ArmKinematics(robot)
    problem = _problem(chain, palm[None], place[None])
    bounds = spelling_bounds(both_sides=both_sides)
    found, costs = search_arms(problem, 0, np.zeros(1, np.intp), bounds)
    return arm_fits(chain, found[0, costs[0].argmin()][None], palm[None], place[None])[0]


def follow_arm(robot: Robot, palms: Array, places: Array, near: ArmFit) -> list[ArmFit]:
    """Find the arm along a path.

    Args:
        robot: The robot.
        palms: Orientations wanted. Shape (n, 3, 3).
        places: Places wanted [m]. Shape (n, 3).
        near: A pose from which all are sought.
    """
    chain = ArmKinematics(robot)
    problem, frames = _problem(chain, palms, places), np.arange(len(places))
    found, _ = search_arms(problem, 0, frames, spelling_bounds(), starts=near.positions[None])
    return arm_fits(chain, found[:, 0], palms, places)


def arm_fits(chain: ArmKinematics, positions: Array, palms: Array, places: Array) -> list[ArmFit]:
    """How well arms do; arguments of n poses as for `follow_arm`."""
    poses = chain.poses(positions)
    angles = Rotation.from_matrix(palms.transpose(0, 2, 1) @ poses.rotation).magnitude()
    away = np.linalg.norm(poses.place - places, axis=1)
    rows = zip(positions, poses.rotation, poses.place, angles.tolist(), away.tolist(), strict=True)
    return [
        ArmFit(positions=arm, palm=palm, place=place, angle_error=angle, place_error=far)
        for arm, palm, place, angle, far in rows
    ]


def _problem(chain: ArmKinematics, palms: Array, places: Array) -> ArmProblem:
    goals = HandGoals.without_arm(
        local=np.zeros_like(places),
        place=places,
        contact=np.zeros(len(places)),
        palm=palms[:, :, 2],
        fingers=palms[:, :, 0],
    )
    return ArmProblem(chain, (goals,), weights=_WEIGHTS)
