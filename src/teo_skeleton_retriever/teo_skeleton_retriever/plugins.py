# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Detectors and retrievers that packages offer by entry points; each is imported when it is asked for."""

from __future__ import annotations

from importlib.metadata import entry_points
from typing import Any

from teo_skeleton_retriever.errors import RetrieverError

# Groups of entry points: what finds people in images, and what follows them in space.
DETECTOR_GROUP = "teo_skeleton_retriever.detectors"
RETRIEVER_GROUP = "teo_skeleton_retriever.retrievers"


def plugin(group: str, name: str) -> Any:
    """Load what an installed package offers under a name.

    Args:
        group: Of the entry points.
        name: Of one of them.

    Raises:
        RetrieverError: "not_installed": no package offers it, or a package that it imports is absent.
    """
    for point in entry_points(group=group, name=name):
        try:
            return point.load()
        except ModuleNotFoundError as error:
            raise RetrieverError(
                "not_installed", f"{name}: expected the Python package {error.name}, found none; install it"
            ) from error
    raise RetrieverError(
        "not_installed",
        f"{name}: expected an installed package that offers it in the group {group}, found none; "
        "`make setup` installs all",
    )
