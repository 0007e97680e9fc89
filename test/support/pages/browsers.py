# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A browser without a window or a graphics card, and what its camera sees: a person who greets."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import av
import pytest
from playwright.sync_api import Browser, sync_playwright

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# WebGL 2 by the processor, and nothing that a browser does for itself in the background.
OPTIONS = (
    "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
)  # fmt: skip
# A greeting of the synthetic signer: synthesize --script greeting --body man_average --rate 30.
GREETING = Path(__file__).parents[3] / "src" / "teo_console" / "test" / "data" / "greeting.mp4"
CAMERA_RATE = 15  # [Hz] of such a camera, from when it is switched on: half of the greeting's
# The sign takes 3 s, after the countdown of 3 s and once in the 6 s that are recorded then, though a loaded
# machine begins two seconds late [s].
REST_BEFORE, REST_AFTER = 5.5, 8.0


def browser_path() -> str | None:
    """A browser on the path; None if there is none."""
    return next(filter(None, map(shutil.which, BROWSERS)), None)


@contextmanager
def launched(*options: str) -> Iterator[Browser]:
    """A browser without a window; without one there is nothing to test with."""
    path = browser_path()
    if path is None:
        pytest.skip(f"no browser: install one of {', '.join(BROWSERS)}")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=[*OPTIONS, *options])
        yield browser
        browser.close()


def seeing(film: Path) -> str:
    """The browser's option that makes a film what its camera sees, over and over."""
    return f"--use-file-for-fake-video-capture={film}"


def write_camera_film(path: Path) -> None:
    """Write what the camera sees, as YUV4MPEG2: a person at rest, who greets, and is at rest again."""
    with av.open(str(GREETING)) as film:
        images = [image.reformat(format="yuv420p") for image in film.decode(video=0)][::2]
    pictures = [b"FRAME\n" + image.to_ndarray().tobytes() for image in images]
    with path.open("wb") as file:
        file.write(f"YUV4MPEG2 W{images[0].width} H{images[0].height} F{CAMERA_RATE}:1\n".encode())
        file.writelines([pictures[0]] * round(REST_BEFORE * CAMERA_RATE))
        file.writelines(pictures)
        file.writelines([pictures[-1]] * round(REST_AFTER * CAMERA_RATE))
