# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How deep the thumb is in a finger of its hand, by a collision library."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import coal
import numpy as np

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_names import LEFT_HAND, RIGHT_HAND

# Radii of the collision model's rods, from the knuckle on [m]: data/shapes.csv, typed once more.
FINGER_RADII, THUMB_RADII = (0.009, 0.0085, 0.008), (0.0095, 0.009)

_JOINTS = {"Right": RIGHT_HAND, "Left": LEFT_HAND}
_THUMB = ("ThumbFinger_link", "ThumbFingerDistal_link", "ThumbFingerTip")
_FINGERS = ("Index", "Middle", "Ring", "Pinky")
_PHALANGES = ("_link", "Middle_link", "Distal_link", "Tip")


def thumb_gap(robot: Robot, hand: Array, side: str) -> float:
    """Least distance of the thumb from the fingers [m]; negative is overlap.

    Args:
        robot: For the places of the parts.
        hand: Positions of the six axes, in the order of `RIGHT_HAND` [rad]. Shape (6,).
        side: "Right" or "Left".
    """
    q = robot.configuration(dict(zip(_JOINTS[side], hand.tolist(), strict=True)))
    thumb = list(_capsules(robot, q, side, _THUMB, THUMB_RADII))
    fingers = [
        capsule
        for finger in _FINGERS
        for capsule in _capsules(
            robot, q, side, [f"{finger}Finger{part}" for part in _PHALANGES], FINGER_RADII
        )
    ]
    request = coal.DistanceRequest()
    request.enable_signed_distance = True
    return min(
        float(coal.distance(*one, *other, request, coal.DistanceResult()))
        for one in thumb
        for other in fingers
    )


def _capsules(
    robot: Robot, q: Array, side: str, chain: Sequence[str], radii: Sequence[float]
) -> Iterator[tuple[coal.Capsule, coal.Transform3s]]:
    """Capsules between the origins of a chain's links and to its tip, as coal has them."""
    points = robot.placements(q, [f"{side}{name}" for name in chain])[:, :3, 3]
    for index, (begin, end, radius) in enumerate(zip(points[:-1], points[1:], radii, strict=True)):
        along = (end - begin) / np.linalg.norm(end - begin)
        end -= (index == len(radii) - 1) * radius * along
        aside = np.linalg.svd(along[None])[2][1]
        rotation = np.column_stack([aside, np.cross(along, aside), along])
        yield (
            coal.Capsule(radius, float((end - begin) @ along)),
            coal.Transform3s(rotation, (begin + end) / 2.0),
        )
