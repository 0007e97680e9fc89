# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Plans as pictures: a film, and a strip with the middle of every sign."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from pathlib import Path

from teo_description.humanoid import Humanoid
from teo_description.pictures.rendering import MotionVideo, camera_named, film_strip, render_pose, save_png
from teo_motion.sentence.plan import Plan
from teo_signs.tokens import Token

_FRAMES_PER_SECOND = 25

_CAMERA = "front"
_STRIP_SIZE = (400, 400)
_PAUSE = "(pause)"


def frames(plan: Plan) -> range:
    """Numbers of the frames of a plan's film; the last shows the robot at rest again."""
    return range(math.ceil(plan.duration * _FRAMES_PER_SECOND) + 1)


def write_film(path: Path, plan: Plan, humanoid: Humanoid, numbers: Iterable[int]) -> None:
    """Write a film of a plan, with the gloss of each sign at its foot.

    Args:
        path: MP4 to write; its folder exists.
        plan: What to show.
        humanoid: Who signs it.
        numbers: `frames` of the plan, wrapped if the caller shows progress.
    """
    with MotionVideo(path, frames_per_second=_FRAMES_PER_SECOND) as film:
        for number in numbers:
            time = number / _FRAMES_PER_SECOND
            index = plan.token_at(time)
            caption = "" if index is None else _caption(plan.timings[index].token)
            film.add(render_pose(_pose(plan, time), _CAMERA, robot=humanoid.name), caption)


def write_strip(path: Path, plan: Plan, humanoid: Humanoid) -> None:
    """Write a picture with the robot at rest, in the middle of every sign, and at rest again."""
    moments = list(_moments(plan))
    camera = camera_named(_CAMERA, humanoid).sized(*_STRIP_SIZE)
    pictures = [render_pose(_pose(plan, time), camera, robot=humanoid.name) for time, _ in moments]
    save_png(path, film_strip(pictures, [caption for _, caption in moments], columns=6))


def _moments(plan: Plan) -> Iterator[tuple[float, str]]:
    yield 0.0, "(rest)"
    for timing in plan.timings:
        yield timing.start + timing.duration / 2.0, _caption(timing.token)
    yield plan.duration, "(rest)"


def _caption(token: Token) -> str:
    return token.gloss or _PAUSE


def _pose(plan: Plan, time: float) -> dict[str, float]:
    return dict(zip(plan.names, plan.at(time).position.tolist(), strict=True))
