# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Takes that the retriever's constants are calibrated on: other bodies and motions than it is tested on."""

from __future__ import annotations

import numpy as np

from accuracy.takes import TakeSettings
from teo_synthetic_signer.body.body_shapes import BODIES, BodyShape, Color
from teo_synthetic_signer.body.phenotype import Phenotype

_MOTIONS = {
    "signing": (0.4, 2.2, 4.0, 6.2),
    "two_hands": (0.6, 2.0, 3.4),
    "hello": (0.3, 2.0),
    "side_step": (0.6, 2.4),
}
_BODIES = ("woman_average", "man_average", "man_heavy")
_SCENES = ("office", "studio", "living_room", "near_wall")
_DISTANCES = (1.2, 1.5, 1.8, 2.1)
_HEIGHTS = (1.1, 1.4, 1.6)  # [m]
_PEOPLE = 24
_SEED = 2024

TUNING_TAKES: tuple[TakeSettings, ...] = tuple(
    TakeSettings(
        script=script,
        body=_BODIES[(i + k) % 3],
        scene=_SCENES[(i + k) % 4],
        distance=_DISTANCES[(i + 3 * k) % 4],
        camera_height=_HEIGHTS[(i + 2 * k) % 3],
        start=start,
        seed=10 * i + k,
    )
    for i, (script, starts) in enumerate(_MOTIONS.items())
    for k, start in enumerate(starts)
)


def random_people() -> dict[str, BodyShape]:
    """Adults of all sorts, half of them women: how sizes go together is read off them."""
    random = np.random.default_rng(_SEED)

    def color() -> Color:
        red, green, blue = random.uniform(0.1, 0.6, 3).tolist()
        return red, green, blue

    people = {}
    for i in range(_PEOPLE):
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
        people[f"random_{i}"] = BodyShape(
            phenotype=phenotype,
            skin=(tone, 0.75 * tone, 0.6 * tone),
            hair=(0.1, 0.08, 0.06),
            shirt=color(),
            sleeve=random.uniform(0.6, 1.9),
            trousers=color(),
        )
    return people


BODIES |= random_people()
PEOPLE_TAKES: tuple[TakeSettings, ...] = tuple(
    TakeSettings(
        script=("signing", "two_hands", "hello", "side_step", "signing", "two_hands")[i % 6],
        body=f"random_{i}",
        scene=_SCENES[i % 4],
        distance=(1.3, 1.6, 1.9)[i % 3],
        camera_height=(1.1, 1.3, 1.5)[(i // 2) % 3],
        start=0.5 if i % 6 == 2 else (0.4, 2.0, 3.4)[(i // 3) % 3],
        seconds=1.4,
        rate=10.0,
        seed=900 + i,
    )
    for i in range(_PEOPLE)
)
"""One for each of the random people."""
