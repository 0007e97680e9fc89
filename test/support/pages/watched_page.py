# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What tests do and see on the console's page."""

from __future__ import annotations

import io
import json
import re
import struct
import time
from itertools import pairwise
from pathlib import Path

import numpy as np
from axe_playwright_python.sync_playwright import Axe
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Page, WebSocket, expect

PATIENCE = 90.0  # [s] for what a page shows, on a loaded machine
DIFFERENT = 3.0  # mean difference of two pictures' pixels, of 255, above which they show different things

# Notes every caption as it is lit.
NOTE_LIT = """
() => {
  window.lit = [];
  window.stood = 0; // [ms] the longest that the page drew nothing
  let before = performance.now();
  requestAnimationFrame(function drawn(now) {
    window.stood = Math.max(window.stood, now - before);
    before = now;
    requestAnimationFrame(drawn);
  });
  new MutationObserver(() => {
    const now = document.querySelector(".token.lit");
    if (now && now !== window.last) {
      window.lit.push(now.dataset.gloss);
      window.until = Date.now() / 1000; // [s] when the last was lit
    }
    window.last = now;
  }).observe(document.querySelector(".captions"), { subtree: true, attributes: true, childList: true });
}
"""


class Poses:
    """The poses that a page receives."""

    def __init__(self) -> None:
        self.heard: list[tuple[float, tuple[float, ...]]] = []

    def listen(self, socket: WebSocket) -> None:
        socket.on("framereceived", self._take)

    def _take(self, payload: str | bytes) -> None:
        if isinstance(payload, bytes):
            stamp, *positions = struct.unpack(f"<d{(len(payload) - 8) // 4}f", payload)
            self.heard.append((stamp, tuple(positions)))

    def farthest(self, since: float = 0.0) -> float:
        """How far any joint has moved since a time of the node's [rad]."""
        positions = [pose for stamp, pose in self.heard if stamp >= since]
        return max((max(joint) - min(joint) for joint in zip(*positions, strict=True)), default=0.0)

    def longest_gap(self, begin: float, end: float) -> float:
        """How long no pose came between two times of the node's [s]."""
        stamps = [begin, *(stamp for stamp, _ in self.heard if begin < stamp < end), end]
        return max(after - before for before, after in pairwise(stamps))

    def wait_until(self, page: Page, stamp: float) -> None:
        """Wait for a pose of this time of the node's or a later one [s]; one comes every second at least."""
        deadline = time.monotonic() + PATIENCE
        while self.heard[-1][0] < stamp:
            assert time.monotonic() < deadline, (self.heard[-1][0], stamp)
            page.wait_for_timeout(20)


def sign(page: Page, text: str) -> None:
    page.fill("#text", text)
    page.press("#text", "Enter")


def wait_until_ready(page: Page) -> None:
    expect(page.locator("#status")).to_have_text(re.compile("^(Listo|Ready)"))


def seen(page: Page) -> NDArray[np.int16]:
    """The robot's picture, in grey, each row from left to right."""
    image = Image.open(io.BytesIO(page.locator(".stage").screenshot())).convert("L")
    return np.asarray(image, np.int16)


def seen_anew(page: Page, before: list[NDArray[np.int16]]) -> NDArray[np.int16]:
    """The robot's picture as soon as it stands still and shows something else than each picture before."""
    deadline = time.monotonic() + PATIENCE
    last = seen(page)
    while True:
        now = seen(page)
        apart = [float(np.abs(now - other).mean()) for other in before]
        if np.array_equal(now, last) and all(each > DIFFERENT for each in apart):
            return now
        assert time.monotonic() < deadline, apart
        last = now


def accessible(page: Page) -> None:
    """Nothing that axe-core finds stands in anybody's way."""
    expect(page.locator("#content h1")).to_be_attached()  # the tab is there
    found = Axe().run(page).response["violations"]
    assert not found, json.dumps([(each["id"], [node["html"] for node in each["nodes"]]) for each in found])


def photograph(page: Page, pictures: Path, name: str) -> None:
    """From its top, at the width of a desk and of a telephone."""
    page.evaluate("window.scrollTo(0, 0)")
    for width, where in ((1100, "desk"), (390, "phone")):
        page.set_viewport_size({"width": width, "height": 800})
        page.screenshot(path=pictures / f"{name}_{where}.png")
    page.set_viewport_size({"width": 1100, "height": 760})


def tab_to(page: Page, wanted: str) -> None:
    """Go to an element by its id or its words with the Tab key alone, and press Enter."""
    for _ in range(60):
        page.keyboard.press("Tab")
        here = page.evaluate("[document.activeElement.id, document.activeElement.textContent.trim()]")
        if wanted in here:
            page.keyboard.press("Enter")
            return
    raise AssertionError(f"{wanted} is not reached by the Tab key")
