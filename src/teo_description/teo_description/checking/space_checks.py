# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a robot touches at its postures, and where in the signing space its hands come."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from teo_common.arrays import Array
from teo_description.checking.arm_reach import ArmReach, Reached
from teo_description.checking.finding import Finding
from teo_description.clearance import watched_pairs
from teo_description.humanoid import SIDES
from teo_description.robot import Robot

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
    bare = sorted(watched - set(robot.shaped_links))
    yield Finding(
        not bare, "every link that is watched has a shape", ", ".join(bare) or "all have", "collision.shapes"
    )
    apart = humanoid.with_both_arms(humanoid.hanging, humanoid.file.detour.apart_deg)
    for title, posture, field in (
        ("home", humanoid.hanging, "postures.home_deg"),
        ("ready", humanoid.ready, "postures.ready_deg"),
        ("arms apart", apart, "detour.apart_deg"),
    ):
        positions = dict(zip(humanoid.commanded_joints, posture.tolist(), strict=True))
        nearest = robot.clearance(robot.configuration(positions))
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
        grid = _grid_points(robot)
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


def _grid_points(robot: Robot) -> Array:
    """Points before the chest for the right hand [m]. Shape (n, 3)."""
    points: Array = np.array(robot.humanoid.file.places["space"].point) + _GRID
    return points
