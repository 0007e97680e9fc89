"""Where the hand is and how the palm is turned, on TEO's right arm.

Bounded least squares with Pinocchio's Jacobian. TEO's arm has six joints, so a reachable pose of the hand has
few answers; where it is out of reach, the orientation of the palm goes before the place, and the elbow stays
where a person's would.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray
from scipy.optimize import least_squares

from teo_description import LEFT_ARM, RIGHT_ARM, joint_limits
from teo_description.robot import Robot

Array = NDArray[np.float64]

PALM_FRAME = "right_palm"

MARGIN = np.radians(1.0)
"""[rad] Distance kept from every limit, so that a planner may overshoot by its rounding."""

# TEO's joints go farther than a person's: an elbow that bends backwards puts the hand in place and looks
# absurd. The bounds that TEO's makers call "human-inspired" (developer manual, motores-motores.csv), in the
# order of RIGHT_ARM [deg]; they lie within the robot's limits, or the limits are used.
_HUMAN_LOWER = np.radians([-98.1, -75.5, -40.0, -99.6, -80.4, -70.0])
# The elbow's upper bound there is 5: it is kept bent here, for nobody spells with a straight arm.
_HUMAN_UPPER = np.radians([45.0, 22.4, 55.0, -45.0, 90.0, 44.7])

SPELLING_ARM = np.radians([-74.0, 11.2, 11.1, -80.5, 48.9, 1.1])
"""[rad] Mean of the poses in which TEO's own demonstration spells T, E and O."""

_PLACE = 2.0
"""[rad/m] The palm 10 cm out of place counts as much as 11 deg out of orientation."""
_POSTURE = 0.03
"""Pull towards `SPELLING_ARM`: chooses among equals, moves a reachable hand by less than 1 deg."""

# The search has several valleys; these lead into them: spelling, palm in, elbow out with the hand hanging,
# hand at the chest, palm up [deg].
_STARTS = np.radians(
    [
        [-74.0, 11.2, 11.1, -80.5, 48.9, 1.1],
        [-75.0, -12.0, 45.0, -89.0, -55.0, 20.0],
        [-42.0, -74.0, 54.0, -98.0, 20.0, -20.0],
        [-60.0, -40.0, 20.0, -60.0, 0.0, 0.0],
        [-60.0, -10.0, -20.0, -90.0, 40.0, -40.0],
    ]
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
        cost: Half the squared residual.
    """

    positions: Array
    palm: Array
    place: Array
    angle_error: float
    place_error: float
    cost: float


def arm_bounds(*, both_sides: bool = False) -> tuple[Array, Array]:
    """Bounds kept by the search.

    Args:
        both_sides: Whether the left arm must be able to mirror the pose.

    Returns:
        Lower and upper bounds [rad]. Shapes (6,).
    """
    limits = joint_limits(RIGHT_ARM)
    lower, upper = np.maximum(limits.lower, _HUMAN_LOWER), np.minimum(limits.upper, _HUMAN_UPPER)
    if both_sides:
        left = joint_limits(LEFT_ARM)
        # Frontal axes turn the same way on both sides, the others the other way.
        frontal = np.array([joint.startswith("Frontal") for joint in RIGHT_ARM])
        lower = np.maximum(lower, np.where(frontal, left.lower, -left.upper))
        upper = np.minimum(upper, np.where(frontal, left.upper, -left.lower))
    return lower + MARGIN, upper - MARGIN


def fit_arm(robot: Robot, palm: Array, place: Array, *, both_sides: bool = False) -> ArmFit:
    """Find the arm that holds the palm so, from several starts.

    Args:
        robot: The robot; head and trunk are at home.
        palm: Orientation wanted; columns along, to the little finger's side, out of the palm. Shape (3, 3).
        place: Where the middle of the palm should be, in ``base_link`` [m]. Shape (3,).
        both_sides: Whether the left arm must be able to mirror the pose.
    """
    bounds = arm_bounds(both_sides=both_sides)
    fits = [_search(robot, palm, place, start, bounds) for start in _STARTS]
    return min(fits, key=lambda fit: fit.cost)


def follow_arm(robot: Robot, palms: Array, places: Array, near: ArmFit) -> list[ArmFit]:
    """Find the arm along a path, each pose from the one before.

    Args:
        robot: The robot.
        palms: Orientations wanted. Shape (n, 3, 3).
        places: Places wanted [m]. Shape (n, 3).
        near: A pose from which the first one is sought.
    """
    bounds = arm_bounds()
    fits = [_search(robot, palms[0], places[0], near.positions, bounds)]
    for palm, place in zip(palms[1:], places[1:], strict=True):
        fits.append(_search(robot, palm, place, fits[-1].positions, bounds))
    return fits


def _search(robot: Robot, palm: Array, place: Array, start: Array, bounds: tuple[Array, Array]) -> ArmFit:
    lower, upper = bounds

    def pose(positions: Array) -> tuple[Array, Array, Array]:
        q = robot.configuration(dict(zip(RIGHT_ARM, positions.tolist(), strict=True)))
        reached = robot.placement(q, PALM_FRAME)
        return q, reached[:3, :3], reached[:3, 3]

    def residuals(positions: Array) -> Array:
        _, turned, moved = pose(positions)
        away = pin.log3(palm.T @ turned)
        return np.concatenate([away, _PLACE * (moved - place), _POSTURE * (positions - SPELLING_ARM)])

    def derivatives(positions: Array) -> Array:
        q, turned, _ = pose(positions)
        jacobian = robot.jacobian(q, PALM_FRAME, RIGHT_ARM)
        away = palm.T @ turned
        return np.vstack(
            [
                pin.Jlog3(away) @ turned.T @ jacobian[3:],
                _PLACE * jacobian[:3],
                _POSTURE * np.eye(len(RIGHT_ARM)),
            ]
        )

    inside = np.clip(start, lower + 1e-3, upper - 1e-3)
    fit = least_squares(residuals, inside, jac=derivatives, bounds=(lower, upper))
    positions = np.clip(fit.x, lower, upper)
    _, turned, moved = pose(positions)
    return ArmFit(
        positions=positions,
        palm=turned,
        place=moved,
        angle_error=float(np.linalg.norm(pin.log3(palm.T @ turned))),
        place_error=float(np.linalg.norm(moved - place)),
        cost=float(fit.cost),
    )
