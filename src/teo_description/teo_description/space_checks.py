# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Checks of ``robot.yaml`` in space: what touches at the postures, and where the hands come."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from teo_common.arrays import Array
from teo_description.clearance import watched_pairs
from teo_description.humanoid import SIDES, Side
from teo_description.kinematic_checks import Finding
from teo_description.robot import Robot

# So near a point counts as reached [m].
_NEAR = 0.01

# So deep a finger tip that is put on the body may be in its shapes [m]: as much as the point is off them.
_TOUCH = 0.02

# Weight of the fingers' direction: turned by 30 deg counts as much as 5 cm; and of each joint's angle, which
# chooses among equals [m/rad].
_POINTED, _EASY = 0.1, 1e-3

# Starts of the search beside the ready posture: a free elbow must be led past a wide body. Eight found a
# way to half of Robonaut 2's places, 32 to three quarters.
_STARTS = 32


class Reached(NamedTuple):
    """How near a hand came."""

    distance: float
    """From the point, of the best posture that touches nothing else [m]; infinite without one."""
    why: str
    """What stands in the way; empty where it was reached."""
    positions: dict[str, float]
    """The posture [rad]."""

    @property
    def ok(self) -> bool:
        """Whether the point is reached."""
        return not self.why


class ArmReach:
    """Brings one hand to points, whichever way it is turned, with straight fingers and the body at home."""

    def __init__(self, robot: Robot, side: Side) -> None:
        """Look at one side."""
        humanoid = robot.humanoid
        self._robot, self.side = robot, side
        self._arm = humanoid.arm(side)
        frames = humanoid.file.hand.palm, next(iter(humanoid.file.hand.fingers.values()))[3]
        self.palm, self.tip = (
            frame if side == "right" else humanoid.mirrored_name(frame) for frame in frames
        )
        limits, natural = humanoid.limits(self._arm), humanoid.file.natural_arm
        bounds = np.radians([natural.lower_deg, natural.upper_deg])
        if side == "left":
            bounds = np.sort(bounds * humanoid.mirror_signs(self._arm), axis=0)
        self._lower, self._upper = np.maximum(limits.lower, bounds[0]), np.minimum(limits.upper, bounds[1])
        ready = humanoid.ready[humanoid.columns(self._arm)]
        dice = np.random.default_rng(3)
        inside = np.clip(ready, self._lower, self._upper)
        self._starts = [inside, *dice.uniform(self._lower, self._upper, (_STARTS, len(self._arm)))]

    def to(self, point: Array, frame: str, *, body: bool) -> Reached:
        """Bring a frame to a point.

        Args:
            point: In ``base_link`` [m]. Shape (3,).
            frame: Of the hand.
            body: Whether the point is on the body, which may then be touched there.
        """
        best = Reached(math.inf, "out of reach", {})
        allowed = -_TOUCH if body else 0.0
        for start in self._starts:
            found = least_squares(
                lambda x: self._off(x, frame, point),
                np.clip(start, self._lower + 1e-6, self._upper - 1e-6),
                jac=lambda x: self._robot.jacobian(self._q(x), frame, self._arm)[:3],
                bounds=(self._lower, self._upper),
                max_nfev=60,
            )
            distance = float(np.linalg.norm(found.fun))
            positions = dict(zip(self._arm, found.x.tolist(), strict=True))
            if distance > _NEAR:
                if distance < best.distance and best.why.startswith("out"):
                    best = Reached(distance, f"out of reach by {distance * 1e3:.0f} mm", positions)
                continue
            nearest = self._robot.clearance(self._robot.configuration(positions))
            if nearest.distance >= allowed:
                return Reached(distance, "", positions)
            best = Reached(distance, f"{nearest.first} is in {nearest.second}", positions)
        return best

    def posture(self, palm: Array, elbow: Array, fingers: Array) -> dict[str, float]:
        """The arm that comes nearest to a palm and an elbow, touching nothing if that can be; [rad] by joint.

        Args:
            palm: Where the palm is, in ``base_link`` [m]. Shape (3,).
            elbow: Where the elbow is [m]. Shape (3,).
            fingers: Which way the straight fingers point; any length. Shape (3,).
        """
        humanoid = self._robot.humanoid
        link = humanoid.file.collision.right_arm.forearm[0]
        upper = link if self.side == "right" else humanoid.mirrored_name(link)
        way = fingers / np.linalg.norm(fingers)

        def off(x: Array) -> Array:
            hand, bend = self._robot.placements(self._q(x), (self.palm, upper))
            turned = _POINTED * (hand[:3, 0] - way)
            return np.concatenate([hand[:3, 3] - palm, bend[:3, 3] - elbow, turned, _EASY * x])

        bounds = (self._lower, self._upper)
        found = [
            least_squares(off, np.clip(start, self._lower + 1e-6, self._upper - 1e-6), bounds=bounds)
            for start in self._starts
        ]
        found.sort(key=lambda one: float(one.cost))
        clear = (one for one in found if self._robot.clearance(self._q(one.x)).distance > _NEAR)
        best = next(clear, found[0])
        return dict(zip(self._arm, best.x.tolist(), strict=True))

    def _q(self, x: Array) -> Array:
        return self._robot.configuration(dict(zip(self._arm, x.tolist(), strict=True)))

    def _off(self, x: Array, frame: str, point: Array) -> Array:
        off: Array = self._robot.placement(self._q(x), frame)[:3, 3] - point
        return off


# Share of the places that each hand should come to. TEO's come to 83 %: like a person's, a hand does not come
# to its own shoulder, and a sign whose place is out of reach is made beside it.
_PLACES_WANTED = 0.75

# Share of the grid before the chest.
_GRID_WANTED = 0.6

# The grid before the chest, about the place ``space`` [m]: where most signs are made.
_GRID = np.array(list(product((-0.08, 0.0, 0.08), (-0.12, 0.0, 0.12), (-0.1, 0.0, 0.1))))


def collision_checks(robot: Robot) -> Iterator[Finding]:
    """Every part that is watched has a shape, and none touches another at rest."""
    humanoid = robot.humanoid
    watched = {link for pair in watched_pairs(humanoid) for link in pair}
    links = humanoid.urdf_tree().findall("link")
    shaped = {link.attrib["name"] for link in links if link.find("collision") is not None}
    bare = sorted(watched - shaped)
    yield Finding(
        not bare, "every link that is watched has a shape", ", ".join(bare) or "all have", "collision.shapes"
    )
    apart = humanoid.with_both_arms(humanoid.hanging, humanoid.file.detour.apart_deg)
    for title, posture, field in (
        ("home", humanoid.hanging, "postures.home_deg"),
        ("ready", humanoid.ready, "postures.ready_deg"),
        ("arms apart", apart, "detour.apart_deg"),
    ):
        nearest = robot.clearance(robot.configurations(posture))
        yield Finding(
            nearest.distance > 0.0,
            f"nothing touches at {title}",
            f"nearest: {nearest.distance * 1e3:.0f} mm, {nearest.first} and {nearest.second}",
            field,
        )


def reach_checks(robot: Robot) -> Iterator[Finding]:
    """Which places and which points before the chest the hands come to, the other arm at home."""
    if robot.clearance(robot.configuration({})).distance <= 0.0:
        yield Finding(
            False, "reach is looked at once nothing touches at home", "it does", "places", needed=False
        )
        return
    for side in SIDES:
        arm = ArmReach(robot, side)
        places = _reached_places(robot, arm)
        failed = [f"{name} ({reach.why})" for name, reach in places.items() if not reach.ok]
        share = 1.0 - len(failed) / len(places)
        yield Finding(
            share >= _PLACES_WANTED,
            f"the {side} hand comes to at least {_PLACES_WANTED:.0%} of the places",
            f"{share:.0%} of {len(places)}" + (f"; not {', '.join(failed)}" if failed else ""),
            "places",
        )
        grid = np.array(robot.humanoid.file.places["space"].point) + _GRID
        mirror = np.array([1.0, -1.0 if side == "left" else 1.0, 1.0])
        count = sum(arm.to(point * mirror, arm.palm, body=False).ok for point in grid)
        yield Finding(
            count >= _GRID_WANTED * len(grid),
            f"the {side} palm comes to at least {_GRID_WANTED:.0%} of a grid before the chest",
            f"{count / len(grid):.0%} of {len(grid)} points",
            "places.space",
        )


def _reached_places(robot: Robot, arm: ArmReach) -> dict[str, Reached]:
    """For every place how an arm comes there: with the finger tip on the body, with the palm in the air."""
    found = {}
    for name, place in robot.humanoid.file.places.items():
        point = np.array(place.point) * [1.0, -1.0 if arm.side == "left" else 1.0, 1.0]
        found[name] = arm.to(point, arm.tip if place.body else arm.palm, body=place.body)
    return found
