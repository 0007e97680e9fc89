# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Time to draw a picture of TEO and to find how far it is from touching itself, on one core."""

from __future__ import annotations

import time
from collections.abc import Callable

import cv2
import numpy as np

from report import Figure, percentiles
from teo_description.pictures.rendering import Renderer, cameras
from teo_description.robot import Robot
from teo_names import COMMANDED_JOINTS, joint_limits

POSES = 200


def measure() -> list[Figure]:
    """Figures of `POSES` random poses within the limits."""
    cv2.setNumThreads(1)
    limits = joint_limits()
    generator = np.random.default_rng(0)
    values = generator.uniform(limits.lower, limits.upper, (POSES, len(COMMANDED_JOINTS)))
    poses = [dict(zip(COMMANDED_JOINTS, row.tolist(), strict=True)) for row in values]
    renderer, robot = Renderer(), Robot.load()
    figures = [
        percentiles(
            f"draw one frame, camera {camera}, 640x480",
            [timed(renderer.render, pose, camera) for pose in poses[:60]],
        )
        for camera in cameras(robot.humanoid)
    ]
    configurations = [robot.configuration(pose) for pose in poses]
    robot.clearance(configurations[0])  # builds the collision model
    distances = [timed(robot.clearance, configuration) for configuration in configurations]
    return [*figures, percentiles("self-collision distance of one pose", distances)]


def timed(work: Callable[..., object], *arguments: object) -> float:
    """Seconds that a call takes."""
    start = time.perf_counter()
    work(*arguments)
    return time.perf_counter() - start
