# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A second look at a motion of TEO, by nothing that made it: limits and shapes read from the URDF anew.

Every pair of the robot's collision shapes is looked at (Coal), but for those of links at most three joints
apart, which touch because of how they are built, and those of one hand, whose fingers are meant to meet.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from itertools import combinations
from typing import NamedTuple

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from teo_names import COMMANDED_JOINTS, urdf_text

# [rad/s] TEO's drives (nodes/common-ipos.ini of teo-configuration-files).
MOST_SPEED = np.radians(50.0)
_ROUNDING = 1e-6
_NEIGHBOURS = 3  # joints between two links that touch by construction


class Violation(NamedTuple):
    """What a motion does that it must not."""

    what: str
    time: float


class SecondLook:
    """Looks at motions of the 28 commanded joints."""

    def __init__(self) -> None:
        text = urdf_text()
        self._model = pin.buildModelFromXML(text)
        self._data = self._model.createData()
        self._geometry = pin.buildGeomFromUrdfString(self._model, text, pin.GeometryType.COLLISION)
        self._links = [self._model.frames[shape.parentFrame].name for shape in self._geometry.geometryObjects]
        tree = ET.fromstring(text)
        self._parents = {
            joint.find("child").attrib["link"]: joint.find("parent").attrib["link"]  # type: ignore[union-attr]
            for joint in tree.iter("joint")
        }
        for one, other in combinations(range(len(self._links)), 2):
            if self._may_not_touch(self._links[one], self._links[other]):
                self._geometry.addCollisionPair(pin.CollisionPair(one, other))
        self._shapes = self._geometry.createData()
        # Finds what a look at pair after pair finds, eight times as fast: it passes over what is far apart.
        self._broad = pin.BroadPhaseManager_DynamicAABBTreeCollisionManager(
            self._model, self._geometry, self._shapes
        )
        self._rows = {name: self._row(name) for name in COMMANDED_JOINTS}
        self._following = [
            (
                self._row(joint.attrib["name"]),
                self._rows[mimic.attrib["joint"]],
                float(mimic.attrib.get("multiplier", 1.0)),
                float(mimic.attrib.get("offset", 0.0)),
            )
            for joint in tree.iter("joint")
            if (mimic := joint.find("mimic")) is not None
        ]

    @property
    def pairs(self) -> int:
        """How many pairs of shapes are looked at."""
        return len(self._geometry.collisionPairs)

    def first_violation(
        self, times: NDArray[np.float64], positions: NDArray[np.float64], *, look: int = 1
    ) -> Violation | None:
        """The first thing wrong with a motion, or None.

        Args:
            times: [s]. Shape (n,).
            positions: Of `COMMANDED_JOINTS` [rad]. Shape (n, 28).
            look: Shapes are looked at in every so manieth row; limits in all.
        """
        rows = list(self._rows.values())
        lower, upper = self._model.lowerPositionLimit[rows], self._model.upperPositionLimit[rows]
        outside = (positions < lower - _ROUNDING) | (positions > upper + _ROUNDING)
        # Fingers are driven by tendons: the drives' speed is that of head, trunk and arms.
        body = [index for index, name in enumerate(COMMANDED_JOINTS) if not _hand(name)]
        speeds = np.abs(np.diff(positions[:, body], axis=0)) / np.diff(times)[:, None]
        for what, where in (("outside a limit", outside), ("too fast", speeds > MOST_SPEED * (1.0 + 1e-3))):
            if where.any():
                return Violation(what, float(times[np.argwhere(where)[0, 0]]))
        for time, row in zip(times[::look], positions[::look], strict=True):
            q = pin.neutral(self._model)
            q[rows] = row
            for own, leading, factor, offset in self._following:
                q[own] = factor * q[leading] + offset
            if pin.computeCollisions(self._model, self._data, self._broad, q, True):
                pin.computeCollisions(self._model, self._data, self._geometry, self._shapes, q, True)
                touching = next(
                    pair
                    for pair, result in zip(
                        self._geometry.collisionPairs, self._shapes.collisionResults, strict=True
                    )
                    if result.isCollision()
                )
                first, second = self._links[touching.first], self._links[touching.second]
                return Violation(f"{first} in {second}", float(time))
        return None

    def _row(self, joint: str) -> int:
        return int(self._model.joints[self._model.getJointId(joint)].idx_q)

    def _may_not_touch(self, one: str, other: str) -> bool:
        if one == other or (_hand(one) and _hand(one) == _hand(other)):
            return False
        ways = [self._to_root(one), self._to_root(other)]
        common = len(set(ways[0]) & set(ways[1]))
        return len(ways[0]) + len(ways[1]) - 2 * common > _NEIGHBOURS

    def _to_root(self, link: str) -> list[str]:
        way = [link]
        while way[-1] in self._parents:
            way.append(self._parents[way[-1]])
        return way


def _hand(link: str) -> str:
    """Side of the hand that a link or joint belongs to; empty for others."""
    if "Hand" in link or "Finger" in link or link in ("FrontalRightWrist_link", "FrontalLeftWrist_link"):
        return "right" if "Right" in link else "left"
    return ""
