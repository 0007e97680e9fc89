"""The arm that brings a hand where a score wants it, as well as TEO can.

Bounded least squares over the six joints of an arm. What is traded against what follows what carries meaning
in a sign: the place first, on the body above all; then the way the palm faces; then the way the fingers
point. TEO's wrist bends sideways only, so not every hand that a person can hold is within reach; what is left
over is measured and reported with the sign.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from teo_description import RIGHT_ARM
from teo_description.hand_geometry import DextraHand
from teo_description.robot import Robot
from teo_sign_capture.notation.targets import HandTarget

Array = NDArray[np.float64]

_PLACE_MET, _PLACE_IN_AIR = 14.0, 5.0
"""[rad/m] 10 cm beside a place count as much as 80 deg of orientation where a hand meets something, as 29 deg
in the air. TEO's mouth and chin are 28 mm apart: with 14 the hands of the table's signs come within 11 mm of
their places on the mean, with 8 within 26 mm, for 2 deg of the palm and 4 deg of the fingers."""
_PALM, _FINGERS = 1.0, 0.7
_POSTURE = 0.03
"""Pull towards an easy arm: chooses among equals, moves a reachable hand by less than 1 deg."""
_EASY = np.radians([-45.0, -12.0, 10.0, -80.0, 20.0, 0.0])
_NEARNESS = 0.08
"""[1/rad^2] What a radian of way from one posture to the next costs: of two arms that do as well, the one
that need not swing about."""

# The search has several valleys; these lead into them: easy, spelling, hand at the chest, elbow out, palm up,
# forearm across, hand at the head, palm to the front [deg]. 32 starts more, spread evenly over the bounds,
# find nothing better for any posture of the table's scores.
_STARTS = np.radians(
    [
        [-45.0, -12.0, 10.0, -80.0, 20.0, 0.0],
        [-74.0, 11.2, 11.1, -80.5, 48.9, 1.1],
        [-75.0, -12.0, 45.0, -89.0, -55.0, 20.0],
        [-42.0, -74.0, 50.0, -95.0, 20.0, -20.0],
        [-30.0, -10.0, -20.0, -80.0, 70.0, 10.0],
        [-55.0, -5.0, 52.0, -95.0, -56.0, 7.0],
        [-90.0, -20.0, 30.0, -95.0, 60.0, -30.0],
        [-68.0, -9.0, 54.0, -99.0, 89.0, 44.0],
    ]
)


@dataclass(frozen=True, kw_only=True)
class Reach:
    """An arm for a target, seen as a right arm.

    Attributes:
        positions: The joints of the arm [rad]. Shape (6,).
        palm_error: Angle between the ways the palm faces and should face [rad].
        finger_error: The same of the way the fingers point [rad].
        cost: What the search made small.
    """

    positions: Array
    palm_error: float
    finger_error: float
    cost: float


class ArmSolver:
    """Finds arms for targets on one robot."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._hand = DextraHand(robot)

    def reaches(self, target: HandTarget, bounds: tuple[Array, Array]) -> list[Reach]:
        """The arms that the search ends at, one for each valley, the best first."""
        part = self.part(target)
        found: list[Reach] = []
        for start in _STARTS:
            reach = self._search(target, part, start, bounds)
            if all(np.abs(reach.positions - other.positions).max() > np.radians(2.0) for other in found):
                found.append(reach)
        return sorted(found, key=lambda reach: reach.cost)

    def part(self, target: HandTarget) -> Array:
        """Where the part of the hand that meets the place is, in the axes of the palm [m]. Shape (3,)."""
        points = self._hand.points(target.shape)
        tips = points.fingers[:, -1]
        shown = {
            "palm": np.zeros(3),
            "back": np.array([0.0, 0.0, -0.03]),
            "wrist": np.array([-0.09, 0.0, 0.0]),
            "index": tips[0],
            "thumb": points.thumb[-1],
            "fingertips": tips[target.shape[2:] <= target.shape[2:].min() + np.radians(15.0)].mean(axis=0),
            "index_side": points.fingers[0, 0] + np.array([0.0, -0.015, 0.0]),
            "little_side": points.fingers[3, 0] + np.array([-0.02, 0.015, 0.0]),
        }
        return np.asarray(shown[target.part])

    def palm(self, positions: Array) -> Array:
        """Placement of the right palm in ``base_link`` with an arm. Shape (4, 4)."""
        q = self._robot.configuration(dict(zip(RIGHT_ARM, positions.tolist(), strict=True)))
        placement: Array = self._robot.placement(q, "right_palm")
        return placement

    def distance(self, target: HandTarget, positions: Array) -> float:
        """How far the part of the hand is from its place [m]."""
        placed = self.palm(positions)
        return float(np.linalg.norm(placed[:3, :3] @ self.part(target) + placed[:3, 3] - target.point))

    def hand_point(self, positions: Array, target: HandTarget, name: str) -> Array:
        """A point of a placed hand in ``base_link``, seen as a right hand [m]. Shape (3,)."""
        points = self._hand.points(target.shape)
        local = {
            "other_palm": np.array([0.0, 0.0, 0.012]),
            "other_back": np.array([0.0, 0.0, -0.035]),
            "other_fingertips": points.fingers[:, -1].mean(axis=0),
            "other_index_side": points.fingers[0, 0] + np.array([0.0, -0.02, 0.0]),
            "other_wrist": np.array([-0.10, 0.0, -0.02]),
        }[name]
        placed = self.palm(positions)
        return np.asarray(placed[:3, :3] @ local + placed[:3, 3])

    def _search(self, target: HandTarget, part: Array, start: Array, bounds: tuple[Array, Array]) -> Reach:
        lower, upper = bounds
        weight = _PLACE_MET if target.meets else _PLACE_IN_AIR

        def away(positions: Array) -> tuple[Array, Array, Array]:
            placed = self.palm(positions)
            turned = placed[:3, :3]
            place = turned @ part + placed[:3, 3] - target.point
            return place, turned[:, 2] - target.palm, turned[:, 0] - target.fingers

        def residuals(positions: Array) -> Array:
            place, palm, fingers = away(positions)
            easy = _POSTURE * (positions - _EASY)
            return np.concatenate([weight * place, _PALM * palm, _FINGERS * fingers, easy])

        inside = np.clip(start, lower + 1e-3, upper - 1e-3)
        fit = least_squares(residuals, inside, bounds=bounds, max_nfev=60, xtol=1e-5, ftol=1e-5)
        positions = np.clip(fit.x, lower, upper)
        _, palm, fingers = (float(np.linalg.norm(part_away)) for part_away in away(positions))
        return Reach(
            positions=positions,
            palm_error=float(2.0 * np.arcsin(min(1.0, palm / 2.0))),
            finger_error=float(2.0 * np.arcsin(min(1.0, fingers / 2.0))),
            cost=float(fit.cost),
        )


def smoothest(candidates: list[list[Reach]]) -> list[Reach]:
    """One arm a posture, such that their costs and the ways between them are least together (Viterbi)."""
    costs = [np.array([reach.cost for reach in candidates[0]])]
    origins: list[NDArray[np.intp]] = []
    for before, now in pairwise(candidates):
        ways = np.array([[np.sum((one.positions - other.positions) ** 2) for one in before] for other in now])
        total = costs[-1][None] + _NEARNESS * ways
        origins.append(total.argmin(axis=1))
        costs.append(total.min(axis=1) + np.array([reach.cost for reach in now]))
    index = int(costs[-1].argmin())
    chosen = [index]
    for origin in reversed(origins):
        chosen.append(int(origin[chosen[-1]]))
    return [reaches[index] for reaches, index in zip(candidates, reversed(chosen), strict=True)]
