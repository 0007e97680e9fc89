# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Commands that have moved to `teo_sign_capture`: they work from here for one release more, with a note."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.metadata import entry_points

_NOW = "teo_sign_capture"


def _moved(name: str) -> Callable[[], None]:
    def main() -> None:
        print(
            f"{name}: has moved: ros2 run {_NOW} {name} (this name works until release 0.3)", file=sys.stderr
        )
        found = [
            point
            for point in entry_points(group="console_scripts", name=name)
            if point.module.partition(".")[0] == _NOW
        ]
        if not found:
            print(
                f"not_installed: {name}: expected the package {_NOW}, which is not installed; "
                "install requirements/capture.txt and build the package",
                file=sys.stderr,
            )
            raise SystemExit(1)
        found[0].load()()

    return main


capture_demonstration = _moved("capture_demonstration")
capture_letters = _moved("capture_letters")
capture_node = _moved("capture_node")
capture_numbers = _moved("capture_numbers")
capture_scores = _moved("capture_scores")
perform_scores = _moved("perform_scores")
