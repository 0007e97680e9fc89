# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The light in a room."""

from __future__ import annotations

from dataclasses import dataclass

from teo_synthetic_signer.errors import unknown_name


@dataclass(frozen=True, kw_only=True)
class Light:
    """A lamp, the ceiling, a little from the floor and from the camera.

    Strengths are parts of what white paper may reflect before it is burnt out.

    Attributes:
        towards: To the lamp: forwards to the camera, to the person's left, up. Of any length.
        lamp: Strength of the lamp.
        sky: Of the ceiling.
        ground: Of the floor.
        fill: Of the camera's side.
        tint: Red, green, blue of all of it.
    """

    towards: tuple[float, float, float] = (0.62, 0.38, 0.68)
    lamp: float = 0.50
    sky: float = 0.34
    ground: float = 0.14
    fill: float = 0.14
    tint: tuple[float, float, float] = (1.0, 1.0, 1.0)


LIGHTS: dict[str, Light] = {
    "room": Light(),
    "window": Light(towards=(0.15, -0.95, 0.30), lamp=0.75, sky=0.20, ground=0.08, fill=0.06),
    "ceiling": Light(towards=(0.05, 0.0, 1.0), lamp=0.60, sky=0.30, ground=0.08, fill=0.04),
    "evening": Light(
        towards=(0.40, 0.70, 0.25), lamp=0.28, sky=0.10, ground=0.07, fill=0.05, tint=(1.0, 0.84, 0.62)
    ),
}


def light_named(name: str) -> Light:
    """Give a light by name.

    Raises:
        SyntheticError: None has that name.
    """
    if name not in LIGHTS:
        raise unknown_name("light", name, LIGHTS)
    return LIGHTS[name]
