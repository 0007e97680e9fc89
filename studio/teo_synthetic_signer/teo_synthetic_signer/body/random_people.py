# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""People by chance, to be rendered beside those that have a name."""

from __future__ import annotations

import numpy as np

from teo_synthetic_signer.body.body_shapes import BodyShape, Color, Phenotype


def random_people(count: int, seed: int, name: str) -> dict[str, BodyShape]:
    """Adults of all sorts, half of them women.

    Args:
        count: How many.
        seed: Of who they are.
        name: What their names begin with.
    """
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
