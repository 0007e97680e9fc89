# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Takes beside those that anything is calibrated on: held out, with faces behind arms, with several people.

The held-out takes are of other people, lights and cameras than all others, and are for a last look: whoever
changes a constant of the retriever looks at the others meanwhile. Once what was seen there has led to a
change they are known, move to `KNOWN_TAKES` or go, and others are held out in their place.
"""

from __future__ import annotations

import math

import numpy as np

from accuracy.people import random_people
from accuracy.takes import TakeSettings
from teo_synthetic_signer import Companion
from teo_synthetic_signer.body.body_shapes import BODIES

BODIES |= random_people(12, 314_159, "known")
BODIES |= random_people(10, 660_719, "held_out_before")
BODIES |= random_people(12, 1_061_033, "held_out")
BODIES |= random_people(8, 5_517, "beside")

_SCENES = ("office", "studio", "living_room", "near_wall")
_LIGHTS = ("room", "window", "ceiling", "evening")
_SCRIPTS = ("signing", "face", "two_hands", "crossing", "turning", "spelling")


def _other_people(name: str, *, count: int, cameras: int, seed: int) -> tuple[TakeSettings, ...]:
    """Cameras at 1 to 2.5 m, rolled by up to 12 degrees, as on a tripod that nobody levelled.

    Args:
        name: What the people's names begin with.
        count: Of takes, one for each of them.
        cameras: Seed of where the cameras are.
        seed: Of the first take's noise.
    """
    random = np.random.default_rng(cameras)
    return tuple(
        TakeSettings(
            script=_SCRIPTS[i % 6],
            body=f"{name}_{i}",
            scene=_SCENES[int(random.integers(4))],
            light=_LIGHTS[i % 4],
            distance=round(float(random.uniform(1.0, 2.5)), 2),
            camera_height=round(float(random.uniform(0.9, 1.8)), 2),
            camera_roll=round(math.radians(float(random.uniform(-12.0, 12.0))), 3),
            start=round(float(random.uniform(0.4, 3.0)), 1),
            seconds=1.2,
            rate=10.0,
            seed=seed + i,
        )
        for i in range(count)
    )


KNOWN_TAKES = (
    *_other_people("known", count=12, cameras=271_828, seed=120_000),
    *_other_people("held_out_before", count=10, cameras=577_215, seed=200_000),
)
HELD_OUT_TAKES = _other_people("held_out", count=12, cameras=433_494, seed=400_000)
OCCLUDED_TAKES: tuple[TakeSettings, ...] = tuple(
    TakeSettings(
        script="before_face",
        body=f"beside_{i}",
        scene=_SCENES[i % 4],
        distance=(1.2, 1.5, 1.8)[i % 3],
        camera_height=(1.2, 1.5)[i % 2],
        start=(0.5, 1.9, 2.6, 3.0)[i % 4],
        seconds=1.7,
        rate=10.0,
        seed=500 + i,
    )
    for i in range(6)
)
"""Arms and hands before faces and shoulders."""
SEVERAL_TAKES: tuple[TakeSettings, ...] = (
    TakeSettings(
        script="two_hands",
        body="beside_0",
        scene="office",
        distance=1.8,
        camera_height=1.4,
        start=0.5,
        rate=10.0,
        seed=600,
        companions=(Companion(body="beside_1", script="hello", behind=0.9, aside=0.75),),
    ),
    TakeSettings(
        script="hello",
        body="beside_2",
        scene="studio",
        distance=2.0,
        camera_height=1.3,
        start=0.4,
        rate=10.0,
        seed=601,
        companions=(Companion(body="beside_3", script="signing", behind=0.5, aside=-0.7),),
    ),
    TakeSettings(
        script="signing",
        body="beside_4",
        scene="living_room",
        distance=2.2,
        camera_height=1.4,
        start=0.6,
        rate=10.0,
        seed=602,
        companions=(
            Companion(body="beside_5", script="two_hands", behind=0.6, aside=0.8),
            Companion(body="beside_6", script="hello", behind=0.9, aside=-0.9),
        ),
    ),
    TakeSettings(
        script="crossing",
        body="beside_7",
        scene="studio",
        distance=1.9,
        camera_height=1.5,
        start=0.5,
        rate=10.0,
        seed=603,
        companions=(
            Companion(body="beside_0", script="still", behind=0.4, aside=-0.85),
            Companion(body="beside_2", script="face", behind=0.7, aside=0.75),
        ),
    ),
)
"""The signer is the nearest of two or three people."""
