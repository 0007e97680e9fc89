# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where a motion of a robot's arms would touch the robot, and the price of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.clearance import Clearance, Contact
from teo_description.humanoid import Side
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, mirrored, mirrored_hand
from teo_sign_capture.retarget.arm_residuals import Quadratic
from teo_sign_capture.signing_space import MIRROR

# [m] Parts that come nearer than this are pushed apart.
WANTED = 0.014
# [m] Parts are never nearer than this: a touch is shown by a gap that nobody sees, and that curves between
# knots do not close.
LEAST = 0.010
# [m] Parts nearer than this are watched, so that what is pushed off one is not pushed into another.
WATCHED = 0.030
# [1/m] A millimetre too near costs as much as a hand 2 cm off its place.
_PRICE = 200.0

# [m] Tip of a stretched finger, from the palm's middle along the hand.
_TIP = np.array([0.12, 0.0, 0.0])
# [m] From its knuckle to its tip.
_FINGER = 0.10


@dataclass(frozen=True, kw_only=True, eq=False)
class CollisionTerms:
    """Distances of parts of the robot, each about the arms at which it was measured.

    Attributes:
        frames: In which frame, or after which; they never go back. Shape (k,).
        shares: Of the straight way from that frame to the next that is behind, 0 to 1. Shape (k,).
        distances: Measured [m]. Shape (k,).
        slopes: How each changes with the arms' joints [m/rad]. Shape (k, m).
        positions: The arms then [rad]. Shape (k, m).
    """

    frames: NDArray[np.intp]
    shares: Array
    distances: Array
    slopes: Array
    positions: Array

    def between(self, part: slice) -> CollisionTerms:
        """Those in some frames one after the other, and on the ways between these."""
        last = self.frames + (self.shares > 0.0)
        inside = (self.frames >= part.start) & (last < part.stop)
        kept = CollisionTerms(**{name: values[inside] for name, values in vars(self).items()})
        return replace(kept, frames=kept.frames - part.start)

    def added(self, here: Quadratic, positions: Array) -> Quadratic:
        """A sum of squares with the price of what is too near at positions, shape (T, m) [rad]."""
        if not len(self.frames):
            return here
        moved = (self.slopes * (between(positions, self.frames, self.shares) - self.positions)).sum(axis=1)
        short = WANTED - self.distances - moved
        near = short > 0.0
        frames, shares = self.frames[near], self.shares[near]
        short, slopes = _PRICE * short[near], -_PRICE * self.slopes[near]
        bent = slopes[:, :, None] * slopes[:, None]
        cost, gradient, curvature = here.cost.copy(), here.gradient.copy(), here.curvature.copy()
        coupling = np.zeros_like(curvature)
        _add(cost, frames, 0.5 * short**2)
        for of, share in ((frames, 1.0 - shares), (np.minimum(frames + 1, len(positions) - 1), shares)):
            _add(gradient, of, (share * short)[:, None] * slopes)
            _add(curvature, of, (share**2)[:, None, None] * bent)
        _add(coupling, frames, (shares * (1.0 - shares))[:, None, None] * bent)
        return Quadratic(cost, gradient, curvature, coupling)


def _add(total: Array, frames: NDArray[np.intp], values: Array) -> None:
    """Add to frames what belongs to each; as `np.add.at`, twenty times as fast for frames in their order."""
    if len(frames):
        starts = np.flatnonzero(np.diff(frames, prepend=-1))
        total[frames[starts]] += np.add.reduceat(values, starts, axis=0)


def between(rows: Array, frames: NDArray[np.intp], shares: Array) -> Array:
    """Rows on the straight ways from frames to the next. Shapes (T, m), (k,), (k,) and (k, m)."""
    first, second = rows[frames], rows[np.minimum(frames + 1, len(rows) - 1)]
    found: Array = first + shares[:, None] * (second - first)
    return found


class CollisionModel:
    """All joints of a robot over a motion of the arms."""

    def __init__(
        self,
        robot: Robot,
        chain: ArmKinematics,
        sides: tuple[Side, ...],
        hands: tuple[Array, ...],
        others: dict[str, Array],
    ) -> None:
        """Hold what does not depend on the arms.

        Args:
            robot: The robot.
            chain: Its arm.
            sides: Of the arms that take part, in the order of their joints.
            hands: Axes of their hands, as right ones [rad]. Shapes (T, axes).
            others: Positions of other joints by name [rad]. Shapes (T,).
        """
        self._robot = robot
        self._chain = chain
        self._sides = sides
        self._hands = hands
        self._others = others
        self._home_trunk = self._trunk(robot.configuration({}))

    def _pose(self, frame: int, arms: Array, share: float) -> dict[str, float]:
        """All joints by name [rad].

        Args:
            frame: The frame.
            arms: Those of one posture, left ones as in a mirror. Shape (m,) [rad].
            share: Of the way from the frame to the next that is behind.
        """
        pose = {name: _on_way(values, frame, share).item() for name, values in self._others.items()}
        humanoid, joints = self._robot.humanoid, self._chain.count
        for index, (side, hand) in enumerate(zip(self._sides, self._hands, strict=True)):
            arm, axes = arms[joints * index : joints * (index + 1)], _on_way(hand, frame, share)
            if side == "left":
                arm, axes = mirrored(humanoid, arm), mirrored_hand(humanoid, axes)
            pose |= zip(humanoid.arm(side), arm.tolist(), strict=True)
            pose |= zip(humanoid.hand(side), axes.tolist(), strict=True)
        return pose

    def ways(self, arms: Array) -> Array:
        """How far the hands move from each frame to the next, added up [m]; arms as in `terms`."""
        total = np.zeros(len(arms) - 1)
        for index, hand in enumerate(self._hands):
            joints = self._chain.count
            poses = self._chain.poses(arms[:, joints * index : joints * (index + 1)])
            tips = poses.points(np.broadcast_to(_TIP, poses.place.shape))
            moved = [
                np.linalg.norm(np.diff(one, axis=0), axis=1)
                for one in (tips, poses.origins[:, self._chain.wrist])
            ]
            bent = _FINGER * np.abs(np.diff(hand, axis=0)).max(axis=1)
            total += np.maximum(*moved) + bent
        return total

    def clearance(self, frame: int, arms: Array, share: float = 0.0) -> Clearance:
        """Smallest distance between parts that must not touch; arguments as for `_pose`."""
        return self._robot.clearance(self._robot.configuration(self._pose(frame, arms, share)))

    def terms(self, frames: NDArray[np.intp], arms: Array, shares: Array, *, within: float) -> CollisionTerms:
        """What is near in some frames, or on the straight ways from them to the next.

        Args:
            frames: The frames. Shape (k,).
            arms: Of all frames. Shape (T, m) [rad].
            shares: Of the ways that are behind; 0 in the frames themselves. Shape (k,).
            within: Parts nearer than this are told of [m].
        """
        found: list[tuple[int, Contact]] = []
        homes = []
        looked = between(arms, frames, shares)
        for index, (frame, share) in enumerate(zip(frames.tolist(), shares.tolist(), strict=True)):
            q = self._robot.configuration(self._pose(frame, looked[index], share))
            near = self._robot.contacts(q, within)
            if near:
                home = self._home_trunk @ np.linalg.inv(self._trunk(q))
                homes += [home] * len(near)
                found += [(index, contact) for contact in near]
        where = np.array([index for index, _ in found], dtype=np.intp)
        positions = looked[where]
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
        return CollisionTerms(
            frames=frames[where],
            shares=shares[where],
            distances=np.array([contact.distance for _, contact in found]),
            slopes=slopes,
            positions=positions,
        )

    def _approach(self, links: list[str], points: Array, normals: Array, positions: Array) -> Array:
        """How points of links move along normals with the arms' joints [m/rad]. Shape (k, m)."""
        slopes = np.zeros_like(positions)
        for index, side in enumerate(self._sides):
            joints = self._chain.count
            own = slice(joints * index, joints * (index + 1))
            flip = MIRROR if side == "left" else np.ones(3)
            poses = self._chain.poses(positions[:, own])
            moving = np.einsum("ki,kij->kj", normals * flip, poses.point_jacobian(points * flip))
            arm = self._robot.humanoid.arm(side)
            carried = np.array([self._robot.carried_by(link, arm) for link in links])
            slopes[:, own] = moving * (np.arange(joints) < carried[:, None])
        return slopes

    def _trunk(self, q: Array) -> Array:
        """Pose of the part of the trunk that carries the arms. Shape (4, 4)."""
        last = self._robot.humanoid.trunk[-1:]
        return self._robot.joint_placements(q, last)[0] if last else np.eye(4)


def _on_way(values: Array, frame: int, share: float) -> Array:
    first: Array = np.asarray(values[frame])
    return first if share == 0.0 else first + share * (values[frame + 1] - first)
