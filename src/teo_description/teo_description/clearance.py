# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far a humanoid is from touching itself."""

from __future__ import annotations

from collections.abc import Collection
from itertools import product
from typing import NamedTuple

import msgspec
import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from teo_description.humanoid import SIDES, Humanoid, Side
from teo_description.robot_schema import ArmLinks


class Clearance(NamedTuple):
    """The closest pair of links."""

    distance: float
    """Distance [m]; negative is the depth of the overlap."""
    first: str
    """Name of one link."""
    second: str
    """Name of the other link."""


class Contact(NamedTuple):
    """Two links that are near each other or overlap."""

    distance: float
    """Distance [m]; negative is the depth of the overlap."""
    first: str
    """Name of one link."""
    second: str
    """Name of the other link."""
    first_point: NDArray[np.float64]
    """Where the one is nearest to the other, in ``base_link`` [m]. Shape (3,)."""
    second_point: NDArray[np.float64]
    """Where the other is nearest to the one [m]. Shape (3,)."""
    normal: NDArray[np.float64]
    """Way along which the other link leaves the one, unit vector. Shape (3,)."""
    may_be_meant: bool
    """Whether a signer may mean these to touch: a hand and anything, or both arms.

    An upper arm or forearm is beside the own trunk in most postures and touches it in no sign.
    """


def watched_pairs(humanoid: Humanoid) -> tuple[tuple[str, str], ...]:
    """Pairs of links that must not touch.

    Upper arm, forearm and hand of each side against trunk, head, pelvis and legs; all of one arm from the
    shoulder on against all of the other; and each hand against its own shoulder, upper arm and elbow. Left
    out are neighbours (a link and the next, the two links at a shoulder or wrist), which touch or nearly
    touch at every pose because of how their joint is built, the pairs that the description allows, and the
    parts of one hand among themselves: fingers and thumb are meant to meet there.
    """
    collision = humanoid.file.collision
    pairs: list[tuple[str, str]] = []
    arms = {side: _arm_links(humanoid, side) for side in SIDES}
    for arm in arms.values():
        pairs += product(arm.upper_arm + arm.forearm + arm.hand, collision.torso)
        # The rest of the hand's own arm: two joints at the wrist lie between it and the elbow link.
        pairs += product(arm.hand[1:], (*arm.shoulder, *arm.upper_arm, arm.forearm[0]))
    left, right = (arm.shoulder + arm.upper_arm + arm.forearm + arm.hand for arm in arms.values())
    pairs += product(left, right)
    allowed = {frozenset(pair) for pair in collision.allowed}
    return tuple(pair for pair in pairs if frozenset(pair) not in allowed)


def _arm_links(humanoid: Humanoid, side: Side) -> ArmLinks:
    right = humanoid.file.collision.right_arm
    if side == "right":
        return right
    parts = msgspec.structs.asdict(right)
    return ArmLinks(**{part: tuple(map(humanoid.mirrored_name, links)) for part, links in parts.items()})


class ClearanceChecker:
    """Exact distances between the collision shapes of `watched_pairs`, the nearest pairs first.

    A pair of shapes is measured only when the distance of their bounding spheres leaves room for a smaller
    result than the one found, which makes the answer exact at a small part of the cost. A pair of shapes that
    overlaps at home would be an error of the description: a test forbids it.
    """

    def __init__(self, model: pin.Model, humanoid: Humanoid, *, of: Collection[str] = ()) -> None:
        """Watch all pairs, or only those with one of some links."""
        self._model = model
        self._data = model.createData()
        self._geometry = pin.buildGeomFromUrdfString(model, humanoid.urdf_text(), pin.GeometryType.COLLISION)
        objects = list(self._geometry.geometryObjects)
        links = [model.frames[item.parentFrame].name for item in objects]
        by_link: dict[str, list[int]] = {}
        for index, link in enumerate(links):
            by_link.setdefault(link, []).append(index)
        pairs = [
            (first, second)
            for one, other in watched_pairs(humanoid)
            if not of or one in of or other in of
            for first, second in product(by_link.get(one, ()), by_link.get(other, ()))
        ]
        for first, second in pairs:
            self._geometry.addCollisionPair(pin.CollisionPair(first, second))
        self._geometry_data = self._geometry.createData()
        for request in self._geometry_data.distanceRequests:
            request.enable_signed_distance = True
        self._links = links
        self._torso = frozenset(humanoid.file.collision.torso)
        self._hands = frozenset(link for side in SIDES for link in _arm_links(humanoid, side).hand)
        self._firsts, self._seconds = np.array(pairs).T.copy()
        # Where shapes are, in the memory that Pinocchio writes to: asking for all anew takes longer than
        # forward kinematics and all distances together. Boxes and rods have their origin at their centre.
        self._poses = self._geometry_data.oMg.tolist()
        self._centres = [pose.translation for pose in self._poses]
        for item in objects:
            item.geometry.computeLocalAABB()
        radii = np.array([item.geometry.aabb_radius for item in objects])
        self._reach = radii[self._firsts] + radii[self._seconds]

    def clearance(self, q: NDArray[np.float64]) -> Clearance:
        """Smallest distance at a configuration, shape (nq,)."""
        bounds = self._bounds(q)
        closest = int(bounds.argmin())
        best = self._distance(closest)
        nearer = np.flatnonzero(bounds < best)
        of_nearer = bounds[nearer]
        order = of_nearer.argsort()
        for index, bound in zip(nearer[order].tolist(), of_nearer[order].tolist(), strict=True):
            if bound >= best:
                break
            distance = self._distance(index)
            if distance < best:
                best, closest = distance, index
        return Clearance(best, *self._links_of(closest))

    def contacts(self, q: NDArray[np.float64], within: float) -> list[Contact]:
        """All pairs of shapes nearer to each other than a distance [m] at a configuration, shape (nq,)."""
        found = []
        for index in np.flatnonzero(self._bounds(q) < within).tolist():
            result = pin.computeDistance(self._geometry, self._geometry_data, index)
            if result.min_distance < within:
                links = self._links_of(index)
                found.append(
                    Contact(
                        float(result.min_distance),
                        *links,
                        np.array(result.getNearestPoint1()),
                        np.array(result.getNearestPoint2()),
                        np.array(result.normal),
                        self._may_be_meant(set(links)),
                    )
                )
        return found

    def _links_of(self, pair: int) -> tuple[str, str]:
        return self._links[self._firsts[pair]], self._links[self._seconds[pair]]

    def _may_be_meant(self, links: set[str]) -> bool:
        return links.isdisjoint(self._torso) or not links.isdisjoint(self._hands)

    def _distance(self, pair: int) -> float:
        """Distance of a pair of shapes where they were placed last [m]."""
        return float(pin.computeDistance(self._geometry, self._geometry_data, pair).min_distance)

    def _bounds(self, q: NDArray[np.float64]) -> NDArray[np.float64]:
        """What the distance of each pair is not below, by their bounding spheres [m]."""
        pin.updateGeometryPlacements(self._model, self._data, self._geometry, self._geometry_data, q)
        centres = np.concatenate(self._centres).reshape(-1, 3).T.copy()
        apart = centres.take(self._firsts, axis=1) - centres.take(self._seconds, axis=1)
        bounds: NDArray[np.float64] = np.sqrt(np.einsum("ij,ij->j", apart, apart)) - self._reach
        return bounds
