# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Films the robot while it moves."""

from __future__ import annotations

import multiprocessing
import signal
import sys
from collections.abc import Mapping
from pathlib import Path

from teo_description.pictures.rendering import MotionVideo, Renderer
from teo_description.robot import Robot

FRAMES_PER_SECOND = 25.0
_Frame = tuple[dict[str, float], str]


class LiveFilm:
    """An MP4 that grows as poses are added.

    Drawing happens in a process of its own, so that it never delays the listening; the file appears, whole,
    when the `with` block ends, and not at all when an exception ends it.
    """

    def __init__(self, path: Path, robot: str) -> None:
        """Prepare a film of a robot at `path`; its folder exists."""
        context = multiprocessing.get_context("spawn")
        self._frames: multiprocessing.Queue[_Frame | None] = context.Queue()
        self._process = context.Process(target=_draw, args=(path, robot, self._frames), daemon=True)

    def __enter__(self) -> LiveFilm:
        self._process.start()
        return self

    def add(self, positions: Mapping[str, float], caption: str) -> None:
        """Append a frame: joint positions [rad] by name, and a line of text."""
        self._frames.put((dict(positions), caption))

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is None:
            self._frames.put(None)
        else:  # what is left to draw would only keep the person from the reason
            self._process.terminate()
        self._process.join()
        self._frames.cancel_join_thread()  # nobody takes what it has not: our end would wait for that

    @property
    def whole(self) -> bool:
        """True once the film has been written."""
        return self._process.exitcode == 0


def _draw(path: Path, robot: str, frames: multiprocessing.Queue[_Frame | None]) -> None:
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # the unfinished file goes as the block ends
    renderer, frame = Renderer(Robot.load(robot)), frames.get()
    drawn, image = None, None
    with MotionVideo(path, frames_per_second=FRAMES_PER_SECOND) as video:
        while frame is not None:
            positions, caption = frame
            if image is None or positions != drawn:  # a robot that waits costs no drawing
                drawn, image = positions, renderer.render(positions)
            video.add(image, caption)
            frame = frames.get()
