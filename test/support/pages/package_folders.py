# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where the packages are: what runs in `src`, what makes in `studio`, the stand-in for `ros2` in `tools`."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).parents[3]
SHELVES = tuple(ROOT / name for name in ("src", "studio", "tools"))

#: Folder of each Python package, by its name.
FOLDERS = {path.parent.name: path.parent for shelf in SHELVES for path in sorted(shelf.glob("*/setup.py"))}
