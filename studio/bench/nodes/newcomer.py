# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a clone to a sign of one's own that the robot signs: how long each step takes a newcomer.

In `bench`, on a machine with nothing else to do: `PYTHONPATH=../test/support python -m nodes.newcomer`.
Clones this checkout's last commit into a temporary folder, where `make demo VIEW=1` installs everything anew
and signs, then teaches the page a sign before a camera that shows the synthetic signer. Takes 2 GB.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from browsers import BROWSERS, OPTIONS, browser_path, seeing, write_camera_film
from playwright.sync_api import Page, sync_playwright

from report import Figure

_ROOT = Path(__file__).parents[3]
_DOMAIN = "18"
_PATIENCE = 1800.0  # [s] for what has no bound of its own: half an hour for an index far away
_WANTED = 300.0  # [s]: the five minutes that a visitor stays


class _Steps:
    """How long each step took."""

    def __init__(self) -> None:
        self._begin = self._last = time.monotonic()
        self.figures: list[Figure] = []

    def done(self, what: str) -> None:
        now = time.monotonic()
        self.figures.append(Figure(what, f"{now - self._last:.0f} s"))
        self._last = now

    def total(self) -> Figure:
        what = f"all of it (wanted: at most {_WANTED:.0f} s)"
        return Figure(what, f"{self._last - self._begin:.0f} s")


def measure() -> list[Figure]:
    """Times of each step, and of all together.

    Raises:
        RuntimeError: There is no browser, or the demo ended by itself.
    """
    browser = browser_path()
    if browser is None:
        raise RuntimeError(f"expected a browser on the path, one of {', '.join(BROWSERS)}")
    with tempfile.TemporaryDirectory(prefix="teo-newcomer-") as name:
        folder = Path(name)
        write_camera_film(folder / "camera.y4m")
        clone = folder / "clone"
        subprocess.run(["git", "clone", "--quiet", str(_ROOT), str(clone)], check=True)
        steps = _Steps()
        demo = subprocess.Popen(
            ["make", "demo", "VIEW=1", "TEXT=Hola."],
            cwd=clone,
            env=_environment(folder),
            stdout=(folder / "said").open("wb"),
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            _wait(demo, folder / "said", "in domain ")
            steps.done("installing and building")
            address = re.search(r"http://\S+", _wait(demo, folder / "said", "the page is at http"))
            assert address is not None
            steps.done("starting the nodes and the page")
            with sync_playwright() as playwright:
                options = [*OPTIONS, seeing(folder / "camera.y4m")]
                page = playwright.chromium.launch(executable_path=browser, args=options).new_page()
                page.set_default_timeout(_PATIENCE * 1e3)
                _teach(page, address.group(), steps)
        finally:
            os.killpg(demo.pid, signal.SIGINT)
            demo.wait(60.0)
    return [*steps.figures, steps.total()]


def _environment(folder: Path) -> dict[str, str]:
    """Nothing of this checkout's environment, and no signs of one's own."""
    kept = {
        name: value for name, value in os.environ.items() if name in ("HOME", "PATH", "LANG") or "PIP" in name
    }
    path = os.pathsep.join(each for each in kept["PATH"].split(os.pathsep) if not each.startswith(str(_ROOT)))
    return {**kept, "PATH": path, "ROS_DOMAIN_ID": _DOMAIN, "XDG_DATA_HOME": str(folder / "data")}


def _wait(demo: subprocess.Popen[bytes], said: Path, words: str) -> str:
    """All that the demo has said, once these words are among it."""
    deadline = time.monotonic() + _PATIENCE
    while words not in (text := said.read_text("utf-8", errors="replace")):
        if demo.poll() is not None or time.monotonic() > deadline:
            raise RuntimeError(f"expected the demo to say {words!r}, got:\n{text[-2000:]}")
        time.sleep(0.2)
    return text


def _teach(page: Page, address: str, steps: _Steps) -> None:
    """Show the camera a sign, accept it, and have the robot sign it."""
    page.goto(f"{address}#teach/SALUDAR")
    page.wait_for_selector("#camera-start")
    page.select_option(".camera select", "6")
    page.click("#camera-start")
    page.wait_for_selector("#camera-record:focus")
    page.keyboard.press("Enter")  # at once: a click waits until nothing moves
    page.wait_for_selector(".viewfinder", state="hidden")
    steps.done("opening the page and filming: 3 s of countdown, 6 s of film")
    page.wait_for_selector("#outcome-title")
    steps.done("from the film to the gates")
    for box in page.locator("form .tick:not([for=accept-keep]) input").all():
        box.check()
    page.click("form button[type=submit]")
    page.wait_for_selector("#accepted")
    steps.done("accepting it")
    page.click("form button.primary")
    page.click("nav a[href='#watch']")
    page.wait_for_selector(".history li:has-text('SALUDAR')")
    steps.done("the robot signs it, after the demo's text if that goes on")


if __name__ == "__main__":
    for figure in measure():
        print(f"{figure.what}: {figure.value}")
