# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What benches keep on disk between runs, for as long as the code that made it is the same."""

from __future__ import annotations

import hashlib
import os
from importlib.util import find_spec
from pathlib import Path


def kept_folder(bench: str, *makers: str) -> Path:
    """Give the folder for what a bench keeps: another one as soon as a maker's source differs.

    Args:
        bench: Its name.
        makers: Packages or modules by their dotted names, whose code decides what is kept.
    """
    digest = hashlib.sha256()
    for path in sorted(path for maker in makers for path in _sources(maker)):
        digest.update(path.read_bytes())
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return base / "teo" / bench / digest.hexdigest()[:12]


def _sources(maker: str) -> list[Path]:
    spec = find_spec(maker)
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError(f"expected a module or a package called {maker}, found none")
    places = spec.submodule_search_locations
    return [path for place in places for path in Path(place).rglob("*.py")] if places else [Path(spec.origin)]
