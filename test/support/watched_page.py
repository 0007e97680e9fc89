# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What tests do and see on the console's page."""

from __future__ import annotations

import io
import re

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Page, WebSocket, expect

from teo_console.protocol.poses import decode_pose

# Notes every caption as it is lit.
NOTE_LIT = """
() => {
  window.lit = [];
  new MutationObserver(() => {
    const now = document.querySelector(".token.lit");
    if (now && now !== window.last) window.lit.push(now.dataset.gloss);
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
            self.heard.append(decode_pose(payload))

    def farthest(self, since: float = 0.0) -> float:
        """How far any joint has moved since a time of the node's [rad]."""
        positions = [pose for stamp, pose in self.heard if stamp >= since]
        return max((max(joint) - min(joint) for joint in zip(*positions, strict=True)), default=0.0)


def sign(page: Page, text: str) -> None:
    page.fill("#text", text)
    page.press("#text", "Enter")


def wait_until_ready(page: Page) -> None:
    expect(page.locator("#status")).to_have_text(re.compile("^(Listo|Ready)"))


def seen(page: Page) -> NDArray[np.int16]:
    """The robot's picture, in grey, each row from left to right."""
    image = Image.open(io.BytesIO(page.locator(".stage").screenshot())).convert("L")
    return np.asarray(image, np.int16)


def tab_to(page: Page, wanted: str) -> None:
    """Go to an element by its id or its words with the Tab key alone, and press Enter."""
    for _ in range(60):
        page.keyboard.press("Tab")
        here = page.evaluate("[document.activeElement.id, document.activeElement.textContent.trim()]")
        if wanted in here:
            page.keyboard.press("Enter")
            return
    raise AssertionError(f"{wanted} is not reached by the Tab key")
