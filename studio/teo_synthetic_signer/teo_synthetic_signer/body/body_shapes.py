# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The people that can be rendered, and from what a person is like to the shape of the body.

Source of the weights of MakeHuman's macro targets: Anny's `phenotype_blendshape_weights` (version 0.6.2):
each target stands for one combination of extremes ("female", "young", "maxweight", ...), and its weight is
the product of how near the person is to each, linearly between the neighbouring extremes. Anny's own bodies
were reproduced to 1e-13 m.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from itertools import product

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.body_data import load_body_data, load_target
from teo_synthetic_signer.errors import SyntheticError

_AGES = ((1 / 3, "child"), (2 / 3, "young"), (1.0, "old"))  # Anny's scale starts with babies at -1/3
_FOLDER = "macrodetails"
_NONE = 1e-9  # a weight below which a target is left out


@dataclass(frozen=True, kw_only=True)
class Phenotype:
    """What a person is like; every number from 0 to 1, where 0.5 is average, unless said otherwise.

    Attributes:
        gender: 0 male, 1 female.
        age: 1/3 child, 2/3 young adult (about 25 years), 1 old (about 90).
        muscle: How muscular.
        weight: How heavy for the height.
        height: How tall.
        proportions: 0 ideal, 1 uncommon.
        african: Share of these face and body proportions; the three are scaled to a sum of 1.
        asian: Likewise.
        caucasian: Likewise.
    """

    gender: float = 0.5
    age: float = 2 / 3
    muscle: float = 0.5
    weight: float = 0.5
    height: float = 0.5
    proportions: float = 0.5
    african: float = 1.0
    asian: float = 1.0
    caucasian: float = 1.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not 0.0 <= value <= 1.0:
                raise SyntheticError("bad_phenotype", f"{field.name}: expected 0 to 1, got {value}")
        if self.age < _AGES[0][0]:
            raise SyntheticError("bad_phenotype", f"age: expected 1/3 (child) to 1, got {self.age}")
        if self.african + self.asian + self.caucasian <= 0.0:
            raise SyntheticError("bad_phenotype", "expected one of african, asian, caucasian above 0")


def shape_vertices(phenotype: Phenotype) -> FloatArray:
    """Give the mesh of such a person in the pose of the template [m]. Shape (n, 3)."""
    vertices = load_body_data().vertices.copy()
    for name, weight in target_weights(phenotype):
        vertices += weight * load_target(name)
    return vertices


def target_weights(phenotype: Phenotype) -> Iterator[tuple[str, float]]:
    """Give the targets that make the person, each with its weight."""
    gender = _between(phenotype.gender, ((0.0, "male"), (1.0, "female")))
    age = _between(phenotype.age, _AGES)
    muscle = _extremes(phenotype.muscle, "muscle")
    weight = _extremes(phenotype.weight, "weight")
    height = _between(phenotype.height, ((0.0, "minheight"), (1.0, "maxheight")))
    ideal = _between(phenotype.proportions, ((0.0, "idealproportions"), (1.0, "uncommonproportions")))
    total = phenotype.african + phenotype.asian + phenotype.caucasian
    origin = {name: getattr(phenotype, name) / total for name in ("african", "asian", "caucasian")}
    build = (gender, age, muscle, weight)
    yield from _products(f"{_FOLDER}/universal-", *build)
    yield from _products(f"{_FOLDER}/", origin, gender, age)
    yield from _products(f"{_FOLDER}/height/", *build, height)
    yield from _products(f"{_FOLDER}/proportions/", *build, ideal)
    # Cup size and firmness are average, for which MakeHuman has no target: it is in the universal one.


def _products(prefix: str, *choices: dict[str, float]) -> Iterator[tuple[str, float]]:
    for combination in product(*(choice.items() for choice in choices)):
        weight = float(np.prod([share for _, share in combination]))
        if weight > _NONE:
            yield prefix + "-".join(name for name, _ in combination), weight


def _extremes(value: float, what: str) -> dict[str, float]:
    return _between(value, ((0.0, f"min{what}"), (0.5, f"average{what}"), (1.0, f"max{what}")))


def _between(value: float, anchors: tuple[tuple[float, str], ...]) -> dict[str, float]:
    """Split 1 between the two anchors around a value."""
    places = [place for place, _ in anchors]
    return {
        name: float(np.interp(value, places, np.eye(len(anchors))[i])) for i, (_, name) in enumerate(anchors)
    }


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


def random_people(count: int, seed: int, name: str) -> dict[str, BodyShape]:
    """Adults of all sorts, half of them women; their names begin with `name`."""
    random = np.random.default_rng(seed)

    def color() -> Color:
        red, green, blue = random.uniform(0.1, 0.6, 3).tolist()
        return red, green, blue

    people = {}
    for i in range(count):
        woman = float(i % 2)
        african, asian, caucasian = random.dirichlet([0.6, 0.6, 0.6]).tolist()
        phenotype = Phenotype(
            gender=woman,
            age=random.uniform(0.6, 0.95),
            muscle=random.uniform(0.3, 0.7),
            weight=random.uniform(0.35, 0.85),
            height=random.uniform(0.3, 0.5) - 0.04 * woman,
            proportions=random.uniform(0.15, 0.4),
            african=african,
            asian=asian,
            caucasian=caucasian,
        )
        tone = random.uniform(0.4, 0.85)
        people[f"{name}_{i}"] = BodyShape(
            phenotype=phenotype,
            skin=(tone, 0.75 * tone, 0.6 * tone),
            hair=(0.1, 0.08, 0.06),
            shirt=color(),
            sleeve=random.uniform(0.6, 1.9),
            trousers=color(),
        )
    return people
