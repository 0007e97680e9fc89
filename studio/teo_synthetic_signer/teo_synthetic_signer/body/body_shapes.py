# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The people that can be rendered."""

from __future__ import annotations

from dataclasses import dataclass

from teo_synthetic_signer.body.phenotype import Phenotype
from teo_synthetic_signer.errors import unknown_name

# Red, green, blue of a surface, each 0 to 1.
Color = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class BodyShape:
    """One person: build, skin, hair and clothes.

    Attributes:
        phenotype: What gives the body its shape.
        skin: Colour.
        hair: Colour.
        long_hair: Whether it falls to the shoulders.
        shirt: Colour.
        sleeve: How far sleeves reach, 0 at the shoulder, 1 at the elbow, 2 at the wrist.
        trousers: Colour.
    """

    phenotype: Phenotype
    skin: Color
    hair: Color
    long_hair: bool = False
    shirt: Color
    sleeve: float
    trousers: Color


BODIES: dict[str, BodyShape] = {
    "woman_average": BodyShape(
        phenotype=Phenotype(gender=1.0, muscle=0.4, height=0.4, proportions=0.2),
        skin=(0.82, 0.62, 0.50),
        hair=(0.16, 0.10, 0.06),
        shirt=(0.10, 0.16, 0.30),
        sleeve=1.9,
        trousers=(0.12, 0.12, 0.14),
    ),
    "man_average": BodyShape(
        phenotype=Phenotype(gender=0.0, muscle=0.35, height=0.41, proportions=0.2),
        skin=(0.80, 0.58, 0.45),
        hair=(0.10, 0.07, 0.05),
        shirt=(0.35, 0.36, 0.38),
        sleeve=0.7,
        trousers=(0.10, 0.14, 0.26),
    ),
    "man_tall": BodyShape(
        phenotype=Phenotype(
            gender=0.0, height=0.46, weight=0.4, proportions=0.2, african=1.0, asian=0, caucasian=0
        ),
        skin=(0.36, 0.22, 0.15),
        hair=(0.03, 0.03, 0.03),
        shirt=(0.62, 0.60, 0.52),
        sleeve=1.9,
        trousers=(0.16, 0.15, 0.13),
    ),
    "woman_small": BodyShape(
        phenotype=Phenotype(
            gender=1.0, height=0.33, weight=0.4, proportions=0.3, african=0, asian=1.0, caucasian=0
        ),
        skin=(0.84, 0.66, 0.52),
        hair=(0.04, 0.03, 0.03),
        long_hair=True,
        shirt=(0.45, 0.12, 0.14),
        sleeve=0.8,
        trousers=(0.20, 0.20, 0.22),
    ),
    "man_heavy": BodyShape(
        phenotype=Phenotype(gender=0.0, age=0.8, height=0.42, weight=0.8, african=0, asian=0, caucasian=1.0),
        skin=(0.85, 0.64, 0.54),
        hair=(0.35, 0.33, 0.31),
        shirt=(0.12, 0.28, 0.18),
        sleeve=1.9,
        trousers=(0.13, 0.13, 0.17),
    ),
    "woman_old": BodyShape(
        phenotype=Phenotype(
            gender=1.0, age=0.9, height=0.36, weight=0.6, african=0.3, asian=0, caucasian=1.0
        ),
        skin=(0.76, 0.56, 0.44),
        hair=(0.62, 0.60, 0.58),
        shirt=(0.30, 0.20, 0.38),
        sleeve=1.4,
        trousers=(0.22, 0.20, 0.19),
    ),
}


def body_shape(name: str) -> BodyShape:
    """Give a person by name.

    Raises:
        SyntheticError: Nobody has that name.
    """
    if name not in BODIES:
        raise unknown_name("body", name, BODIES)
    return BODIES[name]
