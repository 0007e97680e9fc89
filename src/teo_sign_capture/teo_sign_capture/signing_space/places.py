# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Places of articulation on TEO: where on the body a sign is made.

Read off the shapes of the robot description with head and trunk at home, for the right hand, in
``base_link`` [m]; on the surface that counts in a collision, which before the face is up to 3 cm off what is
seen: there a hand stops. Left and right are mirrored for the left hand. TEO's shoulders are nearly twice as
far apart as a person's and its head is small; a place is therefore named by the part of the body, never by a
distance from another.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.signing_space.directions import displacement


@dataclass(frozen=True, slots=True)
class Place:
    """A point and the way out of the body there.

    Attributes:
        point: In ``base_link``, for the right hand [m]. Shape (3,).
        outward: Unit vector away from the body. Shape (3,).
        body: Whether it is on the body, where a centimetre tells a chin from a mouth; else in the air.
    """

    point: Array
    outward: Array
    body: bool


_FRONT, _OUT, _UP = (1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0)
_CHEEK, _TEMPLE = (0.75, -0.66, 0.0), (0.45, -0.89, 0.0)
# name: point, outward, on the body
_PLACES: dict[str, tuple[tuple[float, float, float], tuple[float, float, float], bool]] = {
    "head_top": ((0.0, -0.02, 0.815), _UP, True),
    "forehead": ((0.102, -0.010, 0.770), _FRONT, True),
    "temple": ((0.057, -0.099, 0.750), _TEMPLE, True),
    "eye": ((0.102, -0.034, 0.723), _FRONT, True),
    "nose": ((0.102, 0.0, 0.695), _FRONT, True),
    "ear": ((0.0, -0.099, 0.710), _OUT, True),
    "cheek": ((0.102, -0.060, 0.680), _CHEEK, True),
    "mouth": ((0.102, 0.0, 0.668), _FRONT, True),
    "mouth_corner": ((0.102, -0.035, 0.668), _CHEEK, True),
    "chin": ((0.102, 0.0, 0.640), _FRONT, True),
    "throat": ((0.050, 0.0, 0.590), _FRONT, True),
    "shoulder": ((0.060, -0.300, 0.530), _FRONT, True),
    "other_shoulder": ((0.100, 0.200, 0.500), _FRONT, True),
    "upper_chest": ((0.125, -0.040, 0.490), _FRONT, True),
    "chest": ((0.125, -0.020, 0.420), _FRONT, True),
    "other_chest": ((0.125, 0.090, 0.450), _FRONT, True),
    "belly": ((0.105, 0.0, 0.300), _FRONT, True),
    # In the air: before the chest, lower, at the shoulder, beside the face, before it.
    "space": ((0.340, -0.100, 0.430), _FRONT, False),
    "low_space": ((0.340, -0.120, 0.310), _FRONT, False),
    "middle_space": ((0.340, 0.0, 0.430), _FRONT, False),
    "shoulder_space": ((0.340, -0.260, 0.560), _FRONT, False),
    "high_space": ((0.380, -0.250, 0.700), _FRONT, False),
    "face_space": ((0.300, -0.020, 0.660), _FRONT, False),
    "beside_head": ((0.100, -0.200, 0.740), _OUT, False),
}

# Points of the other hand that a hand may be at; resolved when the other hand is placed.
OTHER_HAND = ("other_palm", "other_back", "other_fingertips", "other_index_side", "other_wrist")

NAMES = (*_PLACES, *OTHER_HAND)


def find_place(name: str) -> Place:
    """A place by its name.

    Raises:
        ValueError: There is none.
    """
    if name not in _PLACES:
        raise ValueError(f"expected a place among {', '.join(NAMES)}; got {name!r}")
    point, outward, body = _PLACES[name]
    return Place(np.array(point), np.array(outward) / np.linalg.norm(outward), body)


def split_place(text: str) -> tuple[str, Array]:
    """`mouth 3 front 2 out`: the name, and how far from it [m]. Offsets are written in centimetres.

    Raises:
        ValueError: The name is none of `NAMES`, or the rest no displacement.
    """
    name, _, rest = text.strip().partition(" ")
    if name not in NAMES:
        raise ValueError(f"expected a place among {', '.join(NAMES)}; got {name!r}")
    return name, 0.01 * displacement(rest)
