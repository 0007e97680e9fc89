# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Places of articulation: where on the body a sign is made.

Where they are on a robot is said in its ``robot.yaml``, for the right hand; left and right are mirrored for
the left hand. Robots are not built as people are: a place is named by the part of the body, never by a
distance from another.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid, load_humanoid
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


# On the body from the crown down, then in the air: before the chest, lower, at the shoulder, beside the face,
# before it.
_NAMES = (
    "head_top", "forehead", "temple", "eye", "nose", "ear", "cheek", "mouth", "mouth_corner", "chin",
    "throat", "shoulder", "other_shoulder", "upper_chest", "chest", "other_chest", "belly",
    "space", "low_space", "middle_space", "shoulder_space", "high_space", "face_space", "beside_head",
)  # fmt: skip

# The robot whose body and hand scores are written for.
WRITTEN_FOR = "teo"

# Points of the other hand that a hand may be at; resolved when the other hand is placed.
OTHER_HAND = ("other_palm", "other_back", "other_fingertips", "other_index_side", "other_wrist")

NAMES = (*_NAMES, *OTHER_HAND)


def find_place(humanoid: Humanoid, name: str) -> Place:
    """A place on a robot by its name.

    Raises:
        ValueError: There is none.
    """
    found = humanoid.file.places.get(name)
    if found is None:
        raise ValueError(f"expected a place among {', '.join(humanoid.file.places)}; got {name!r}")
    outward = np.array(found.outward)
    return Place(np.array(found.point), outward / np.linalg.norm(outward), found.body)


def written_place(name: str) -> Place:
    """A place on the body that scores are written for: their centimetres are counted from there.

    Raises:
        ValueError: There is none.
    """
    return find_place(load_humanoid(WRITTEN_FOR), name)


def split_place(text: str) -> tuple[str, Array]:
    """`mouth 3 front 2 out`: the name, and how far from it [m]. Offsets are written in centimetres.

    Raises:
        ValueError: The name is none of `NAMES`, or the rest no displacement.
    """
    name, _, rest = text.strip().partition(" ")
    if name not in NAMES:
        raise ValueError(f"expected a place among {', '.join(NAMES)}; got {name!r}")
    return name, 0.01 * displacement(rest)
