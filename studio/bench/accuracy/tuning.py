# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Takes that the retriever's constants are calibrated on: other bodies and motions than it is tested on."""

from __future__ import annotations

import math

import numpy as np

from accuracy.motions import add_random_scripts
from accuracy.people import random_people
from accuracy.takes import TakeSettings
from teo_synthetic_signer.body.body_shapes import BODIES

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


# How sizes go together is read off them.
BODIES |= random_people(_PEOPLE, _SEED, "random")
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


_MOTION_PEOPLE = 55
BODIES |= random_people(_MOTION_PEOPLE, 86_028, "learned")
add_random_scripts(_MOTION_PEOPLE, 1_299_709, "motion")


def _motion_takes() -> tuple[TakeSettings, ...]:
    random = np.random.default_rng(15_485)
    return tuple(
        TakeSettings(
            script=f"motion_{i}",
            body=f"learned_{i}",
            scene=_SCENES[int(random.integers(4))],
            light=("room", "window", "ceiling", "evening")[i % 4],
            distance=round(float(random.uniform(1.0, 2.5)), 2),
            camera_height=round(float(random.uniform(0.9, 1.8)), 2),
            camera_roll=round(math.radians(float(random.uniform(-12.0, 12.0))), 3),
            start=0.6,
            seconds=1.6,
            rate=10.0,
            seed=300_000 + i,
        )
        for i in range(_MOTION_PEOPLE)
    )


MOTION_TAKES: tuple[TakeSettings, ...] = _motion_takes()
"""Other people in motions that no other take has: where detectors put keypoints is read off them, too."""
