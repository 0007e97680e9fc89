# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The hand map as a picture: what each axis of a hand moves."""

from __future__ import annotations

import math

import numpy as np

from teo_description.pictures.camera import Camera
from teo_description.pictures.film_strip import film_strip
from teo_description.pictures.renderer import Image, Renderer
from teo_description.robot import Robot

# How far the camera is from the palm and what it leaves out before it [m]: the robot's own trunk.
_DISTANCE, _NEAR = 0.6, 0.4

_SIZE = (260, 260)


def hand_sheet(robot: Robot, renderer: Renderer) -> Image:
    """A row for each axis of the right hand, at its lower limit, half way and at its upper limit.

    The others are at their lower limits, the arms away from the body; the hand is seen from before its palm
    and from the thumb's side.
    """
    humanoid = robot.humanoid
    names = humanoid.hand("right")
    limits = humanoid.limits(names)
    apart = humanoid.with_both_arms(humanoid.hanging, humanoid.file.detour.apart_deg)
    away = dict(zip(humanoid.commanded_joints, apart.tolist(), strict=True))
    palm = robot.placement(robot.configuration(away), humanoid.file.hand.palm)
    towards = palm[:3, 2] - 0.5 * palm[:3, 1]
    middle = palm[:3, :3] @ np.array([0.04, 0.0, 0.0])
    eye = middle + _DISTANCE * towards / np.linalg.norm(towards)
    camera = Camera(
        position=(float(eye[0]), float(eye[1]), float(eye[2])),
        target=(float(middle[0]), float(middle[1]), float(middle[2])),
        field_of_view=math.radians(26.0),
        size=_SIZE,
        near=_NEAR,
        follows=humanoid.file.hand.palm,
    )
    straight = away | dict(zip(names, limits.lower.tolist(), strict=True))
    frames, captions = [], []
    for name, low, high in zip(names, limits.lower.tolist(), limits.upper.tolist(), strict=True):
        for share in (0.0, 0.5, 1.0):
            value = low + share * (high - low)
            frames.append(renderer.render({**straight, name: value}, camera))
            captions.append(f"{name} {math.degrees(value):.0f}°")
    return film_strip(frames, captions, 6)
