# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Motions by chance, to be learned from: arms go where no script of the benches sends them on purpose."""

from __future__ import annotations

import numpy as np

from teo_synthetic_signer.script.keys import ArmKey, Key, Vector
from teo_synthetic_signer.script.scripts import HANGING, REST, add_script

# In this order, so that a seed draws the same.
_SHAPES = (
    *("relaxed", "open", "flat", "fist", "index", "middle", "little", "v", "u", "w", "b", "l", "y", "horns"),
    *("thumb_up", "c", "o", "claw", "hook", "bent", "f"),
)
_AT_BODY = ("temple", "forehead", "mouth", "chin", "ear", "other_shoulder", "sternum", "belly", "upper_chest")


def add_random_scripts(count: int, seed: int, name: str) -> None:
    """Make scripts known: arms hang, go before the body or to a place on it; the body turns, leans and nods.

    Args:
        count: How many.
        seed: Of what is done.
        name: What the scripts' names begin with.
    """
    random = np.random.default_rng(seed)

    def vector(low: Vector, high: Vector) -> Vector:
        x, y, z = random.uniform(low, high).tolist()
        return x, y, z

    def arm() -> ArmKey:
        kind = random.uniform()
        if kind < 0.2:
            return HANGING
        at, offset = "shoulders", vector((0.08, -0.05, -0.45), (0.45, 0.45, 0.2))
        if kind < 0.5:
            at, offset = str(random.choice(_AT_BODY)), vector((0.02, -0.05, -0.05), (0.2, 0.12, 0.05))
        return ArmKey(
            at=at,
            offset=offset,
            fingers=vector((-0.3, -1.0, -0.4), (1.0, 0.4, 1.0)),
            palm=vector((-1.0, -1.0, -1.0), (1.0, 0.3, 1.0)),
            shape=str(random.choice(_SHAPES)),
            swivel=random.uniform(-0.3, 0.5),
        )

    def keys() -> tuple[Key, ...]:
        heading = random.choice((0.0, 0.0, 1.0)) * random.uniform(-0.6, 0.6)
        return (
            REST,
            *(
                Key(
                    right=arm(),
                    left=arm(),
                    move=random.uniform(0.3, 0.5),
                    hold=0.1,
                    heading=heading,
                    lean=vector((-0.05, -0.05, -0.1), (0.12, 0.05, 0.1)),
                    head=vector((-0.4, -0.15, -0.1), (0.4, 0.25, 0.1)),
                    keep_out=True,
                )
                for _ in range(4)
            ),
        )

    for i in range(count):
        add_script(f"{name}_{i}", keys(), "arms move by chance")
