"""Where a motion of TEO's arms would touch TEO, and the price of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_description import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND
from teo_description.clearance import Clearance, Contact
from teo_description.robot import Robot
from teo_lut_executor.capture.arm_chain import ArmChain
from teo_lut_executor.capture.arm_problem import JOINTS, Quadratic
from teo_lut_executor.capture.hand_points import MIRROR
from teo_lut_executor.score.arm_solver import mirrored

Array = NDArray[np.float64]

WANTED = 0.014
"""[m] Parts that come nearer than this are pushed apart."""
LEAST = 0.010
"""[m] Parts are never nearer than this: a touch is shown by a gap that nobody sees, and that curves between
knots do not close."""
_WATCHED = 0.030
"""[m] Parts nearer than this are watched, so that what is pushed off one is not pushed into another."""
_PRICE = 200.0
"""[1/m] A millimetre too near costs as much as a hand 2 cm off its place."""

_ARM = {"right": RIGHT_ARM, "left": LEFT_ARM}
_HAND = {"right": RIGHT_HAND, "left": LEFT_HAND}


@dataclass(frozen=True, kw_only=True, eq=False)
class Touches:
    """Distances of parts of the robot, each about the arms at which it was measured.

    Attributes:
        frames: In which frame. Shape (k,).
        distances: Measured [m]. Shape (k,).
        slopes: How each changes with the arms' joints [m/rad]. Shape (k, m).
        positions: The arms then [rad]. Shape (k, m).
    """

    frames: NDArray[np.intp]
    distances: Array
    slopes: Array
    positions: Array

    def added(self, here: Quadratic, positions: Array) -> Quadratic:
        """A sum of squares with the price of what is too near at positions, shape (T, m) [rad]."""
        if not len(self.frames):
            return here
        moved = (self.slopes * (positions[self.frames] - self.positions)).sum(axis=1)
        short = _PRICE * np.maximum(WANTED - self.distances - moved, 0.0)
        slopes = -_PRICE * self.slopes * (short > 0.0)[:, None]
        cost, gradient, curvature = here.cost.copy(), here.gradient.copy(), here.curvature.copy()
        np.add.at(cost, self.frames, 0.5 * short**2)
        np.add.at(gradient, self.frames, short[:, None] * slopes)
        np.add.at(curvature, self.frames, slopes[:, :, None] * slopes[:, None])
        return Quadratic(cost, gradient, curvature)


class WholeRobot:
    """All joints of TEO over a motion of the arms."""

    def __init__(
        self,
        robot: Robot,
        chain: ArmChain,
        sides: tuple[str, ...],
        hands: tuple[Array, ...],
        others: dict[str, Array],
    ) -> None:
        """Hold what does not depend on the arms.

        Args:
            robot: The robot.
            chain: Its arm.
            sides: Of the arms that take part, in the order of their joints.
            hands: Axes of their hands [rad]. Shapes (T, 6).
            others: Positions of other joints by name [rad]. Shapes (T,).
        """
        self._robot = robot
        self._chain = chain
        self._sides = sides
        self._hands = hands
        self._others = others
        self._home_trunk = robot.placement(robot.configuration({}), "FrontalTrunk_link")

    def pose(self, frame: int, arms: Array) -> dict[str, float]:
        """All joints by name [rad]; `arms` are those of one frame, left ones as in a mirror."""
        pose = {name: float(values[frame]) for name, values in self._others.items()}
        for index, (side, hand) in enumerate(zip(self._sides, self._hands, strict=True)):
            arm = arms[JOINTS * index : JOINTS * (index + 1)]
            pose |= zip(_ARM[side], (mirrored(arm) if side == "left" else arm).tolist(), strict=True)
            pose |= zip(_HAND[side], hand[frame].tolist(), strict=True)
        return pose

    def clearance(self, frame: int, arms: Array) -> Clearance:
        """Smallest distance between parts that must not touch, in a frame."""
        return self._robot.clearance(self._robot.configuration(self.pose(frame, arms)))

    def touches(self, frames: NDArray[np.intp], arms: Array) -> Touches:
        """What is near in some frames. `arms` are those of all frames, shape (T, m) [rad]."""
        found: list[tuple[int, Contact]] = []
        homes = []
        for frame in frames.tolist():
            q = self._robot.configuration(self.pose(frame, arms[frame]))
            near = self._robot.contacts(q, _WATCHED)
            if near:
                home = self._home_trunk @ np.linalg.inv(self._robot.placement(q, "FrontalTrunk_link"))
                homes += [home] * len(near)
                found += [(frame, contact) for contact in near]
        where = np.array([frame for frame, _ in found], dtype=np.intp)
        positions = arms[where]
        slopes = np.zeros_like(positions)
        if found:
            turns = np.array(homes)
            contacts = [contact for _, contact in found]
            ends = (
                ([one.first for one in contacts], [one.first_point for one in contacts], -1.0),
                ([one.second for one in contacts], [one.second_point for one in contacts], 1.0),
            )
            normals = np.einsum("kij,kj->ki", turns[:, :3, :3], np.array([one.normal for one in contacts]))
            for links, points, sign in ends:
                placed = np.einsum("kij,kj->ki", turns[:, :3, :3], np.array(points)) + turns[:, :3, 3]
                slopes += sign * self._approach(links, placed, normals, positions)
        distances = np.array([contact.distance for _, contact in found])
        return Touches(frames=where, distances=distances, slopes=slopes, positions=positions)

    def _approach(self, links: list[str], points: Array, normals: Array, positions: Array) -> Array:
        """How points of links move along normals with the arms' joints [m/rad]. Shape (k, m)."""
        slopes = np.zeros_like(positions)
        for index, side in enumerate(self._sides):
            own = slice(JOINTS * index, JOINTS * (index + 1))
            flip = MIRROR if side == "left" else np.ones(3)
            poses = self._chain.poses(positions[:, own])
            moving = np.einsum("ki,kij->kj", normals * flip, poses.point_jacobian(points * flip))
            carried = np.array([_carried(link, side) for link in links])
            slopes[:, own] = moving * (np.arange(JOINTS) < carried[:, None])
        return slopes


def _carried(link: str, side: str) -> int:
    """How many joints of the arm of a side carry a link."""
    name = side.capitalize()
    if name not in link:
        return 0
    joint = link.removesuffix("_link")
    if joint in _ARM[side]:
        return _ARM[side].index(joint) + 1
    return JOINTS if "Hand" in link or "Finger" in link else 0
