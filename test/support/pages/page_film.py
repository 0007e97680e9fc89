# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A short film of what tests do in the browser, as README.md and docs/console.md show it."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import Page

WIDTH, HEIGHT = 880, 608  # pixels, as wide as a README is shown
_STEP = 0.2  # [s] between two pictures of the film
_EVERY = 3  # of the browser's pictures, of which a robot in motion makes fifteen a second
_LONGEST = 1.0  # [s] that a picture stands at most: a loaded machine's waits are left out
_QUALITY = 60  # of WebP: letters stay clear, and the whole below 2 MB


class Scene:
    """Pictures of one page. `running` may be set to False while nothing happens that is worth a film."""

    def __init__(self) -> None:
        """Begin without a picture."""
        self.running = True
        self.shots: list[tuple[float, bytes]] = []


class Film:
    """Pictures of pages, one scene after the other."""

    def __init__(self, *, wanted: bool) -> None:
        """Begin without a picture.

        Args:
            wanted: False to take none: a film costs a minute of processor time.
        """
        self._wanted = wanted
        self._scenes: list[Scene] = []

    @contextmanager
    def scene(self, page: Page) -> Iterator[Scene]:
        """Film a page while something is done on it: the browser sends a picture whenever one has changed."""
        scene = Scene()
        if not self._wanted:
            yield scene
            return
        session = page.context.new_cdp_session(page)

        def take(frame: dict[str, Any]) -> None:
            if scene.running:
                scene.shots.append((frame["metadata"]["timestamp"], base64.b64decode(frame["data"])))
            session.send("Page.screencastFrameAck", {"sessionId": frame["sessionId"]})

        session.on("Page.screencastFrame", take)
        session.send(
            "Page.startScreencast",
            {
                "format": "jpeg",
                "quality": 85,
                "maxWidth": WIDTH,
                "maxHeight": HEIGHT,
                "everyNthFrame": _EVERY,
            },
        )
        try:
            yield scene
        finally:
            session.send("Page.stopScreencast")
            session.detach()
            if scene.shots:
                self._scenes.append(scene)

    def save(self, path: Path) -> None:
        """Write the scenes as an animated WebP; nothing without a picture."""
        images, durations = [], []
        for scene in self._scenes:
            kept = _thinned(scene.shots)
            ends = [stamp for stamp, _ in kept[1:]] + [kept[-1][0] + _LONGEST]
            for (begin, jpeg), end in zip(kept, ends, strict=True):
                image = Image.open(io.BytesIO(jpeg)).convert("RGB")
                if image.width < image.height:
                    continue  # for a moment as wide as a telephone
                images.append(image.resize((WIDTH, HEIGHT)))
                durations.append(round(1000 * min(end - begin, _LONGEST)))
        if images:
            images[0].save(
                path, save_all=True, append_images=images[1:], duration=durations, quality=_QUALITY, method=4
            )


def _thinned(shots: list[tuple[float, bytes]]) -> list[tuple[float, bytes]]:
    """What of a scene goes into the film: the first picture, and each a step after the one before."""
    kept = shots[:1]
    for shot in shots[1:]:
        if shot[0] - kept[-1][0] >= _STEP:
            kept.append(shot)
    return kept
