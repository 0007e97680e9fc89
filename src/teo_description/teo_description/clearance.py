# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far TEO is from touching itself."""

from __future__ import annotations

from collections.abc import Collection
from itertools import product
from typing import NamedTuple

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray


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

    @property
    def may_be_meant(self) -> bool:
        """Whether a signer may mean these to touch: a hand and anything, or both arms.

        An upper arm or forearm is beside the own trunk in most postures and touches it in no sign.
        """
        links = {self.first, self.second}
        return links.isdisjoint(_TORSO) or not links.isdisjoint(_HANDS)


# What the joints of the head move.
HEAD_LINKS = ("AxialNeck_link", "FrontalNeck_link")

_TORSO = (
    "root_link",
    "AxialTrunk_link",
    "FrontalTrunk_link",
    *HEAD_LINKS,
    "FrontalLeftHip_link",
    "FrontalRightHip_link",
    "FrontalLeftKnee_link",
    "FrontalRightKnee_link",
)


def _shoulder(side: str) -> tuple[str, ...]:
    return f"Frontal{side}Shoulder_link", f"Sagittal{side}Shoulder_link"


def _upper_arm(side: str) -> tuple[str, ...]:
    return (f"Axial{side}Shoulder_link",)


def _forearm(side: str) -> tuple[str, ...]:
    return f"Frontal{side}Elbow_link", f"Axial{side}Wrist_link"


def _hand(side: str) -> tuple[str, ...]:
    fingers = [
        f"{side}{finger}Finger{part}_link"
        for finger in ("Index", "Middle", "Ring", "Pinky")
        for part in ("", "Middle", "Distal")
    ]
    thumb = (f"{side}HandAbductor_link", f"{side}ThumbFinger_link", f"{side}ThumbFingerDistal_link")
    return (f"Frontal{side}Wrist_link", f"{side}Hand_link", *thumb, *fingers)


_HANDS = frozenset((*_hand("Left"), *_hand("Right")))


def watched_pairs() -> tuple[tuple[str, str], ...]:
    """Pairs of links that must not touch.

    Upper arm, forearm and hand of each side against trunk, head, pelvis and legs; all of one arm from the
    shoulder on against all of the other; and each hand against its own shoulder, upper arm and elbow. Left
    out are neighbours (a link and the next, the two links at a shoulder or wrist), which touch or nearly
    touch at every pose because of how their joint is built, and the parts of one hand among themselves:
    fingers and thumb are meant to meet there.
    """
    pairs: list[tuple[str, str]] = []
    for side in ("Left", "Right"):
        pairs += product(_upper_arm(side) + _forearm(side) + _hand(side), _TORSO)
        # The rest of the hand's own arm: two joints at the wrist lie between it and the elbow link.
        pairs += product(_hand(side)[1:], (*_shoulder(side), *_upper_arm(side), _forearm(side)[0]))
    left, right = (
        _shoulder(side) + _upper_arm(side) + _forearm(side) + _hand(side) for side in ("Left", "Right")
    )
    pairs += product(left, right)
    return tuple(pairs)


class ClearanceChecker:
    """Exact distances between the collision shapes of `watched_pairs`, the nearest pairs first.

    A pair of shapes is measured only when the distance of their bounding spheres leaves room for a smaller
    result than the one found, which makes the answer exact at a small part of the cost. A pair of shapes that
    overlaps at `HOME` would be an error of the description: a test forbids it.
    """

    def __init__(self, model: pin.Model, urdf: str, *, of: Collection[str] = ()) -> None:
        """Watch all pairs, or only those with one of some links."""
        self._model = model
        self._data = model.createData()
        self._geometry = pin.buildGeomFromUrdfString(model, urdf, pin.GeometryType.COLLISION)
        objects = list(self._geometry.geometryObjects)
        links = [model.frames[item.parentFrame].name for item in objects]
        by_link: dict[str, list[int]] = {}
        for index, link in enumerate(links):
            by_link.setdefault(link, []).append(index)
        pairs = [
            (first, second)
            for one, other in watched_pairs()
            if not of or one in of or other in of
            for first, second in product(by_link[one], by_link[other])
        ]
        for first, second in pairs:
            self._geometry.addCollisionPair(pin.CollisionPair(first, second))
        self._geometry_data = self._geometry.createData()
        for request in self._geometry_data.distanceRequests:
            request.enable_signed_distance = True
        self._links = links
        self._pairs = np.array(pairs)
        # Where shapes are, in the memory that Pinocchio writes to: asking for all anew takes longer than
        # forward kinematics and all distances together. Boxes and rods have their origin at their centre.
        self._poses = self._geometry_data.oMg.tolist()
        self._centres = [pose.translation for pose in self._poses]
        for item in objects:
            item.geometry.computeLocalAABB()
        radii = np.array([item.geometry.aabb_radius for item in objects])
        self._reach = radii[self._pairs[:, 0]] + radii[self._pairs[:, 1]]

    def clearance(self, q: NDArray[np.float64]) -> Clearance:
        """Smallest distance at a configuration, shape (nq,)."""
        bounds = self._bounds(q)
        closest = int(bounds.argmin())
        best = self._distance(closest)
        nearer = np.flatnonzero(bounds < best)
        for index in nearer[np.argsort(bounds[nearer])]:
            if bounds[index] >= best:
                break
            distance = self._distance(int(index))
            if distance < best:
                best, closest = distance, int(index)
        first, second = self._pairs[closest]
        return Clearance(best, self._links[first], self._links[second])

    def contacts(self, q: NDArray[np.float64], within: float) -> list[Contact]:
        """All pairs of shapes nearer to each other than a distance [m] at a configuration, shape (nq,)."""
        found = []
        for index in np.flatnonzero(self._bounds(q) < within):
            result = pin.computeDistance(self._geometry, self._geometry_data, int(index))
            if result.min_distance < within:
                first, second = self._pairs[index]
                found.append(
                    Contact(
                        float(result.min_distance),
                        self._links[first],
                        self._links[second],
                        np.array(result.getNearestPoint1()),
                        np.array(result.getNearestPoint2()),
                        np.array(result.normal),
                    )
                )
        return found

    def _distance(self, pair: int) -> float:
        """Distance of a pair of shapes where they were placed last [m]."""
        return float(pin.computeDistance(self._geometry, self._geometry_data, pair).min_distance)

    def _bounds(self, q: NDArray[np.float64]) -> NDArray[np.float64]:
        """What the distance of each pair is not below, by their bounding spheres [m]."""
        pin.updateGeometryPlacements(self._model, self._data, self._geometry, self._geometry_data, q)
        centres = np.array(self._centres)
        apart = centres.take(self._pairs[:, 0], axis=0) - centres.take(self._pairs[:, 1], axis=0)
        bounds: NDArray[np.float64] = np.sqrt(np.einsum("ij,ij->i", apart, apart)) - self._reach
        return bounds
