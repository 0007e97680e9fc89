# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the synthetic signer raises."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeVar

from teo_skeleton_retriever.errors import RetrieverError


class SyntheticError(RetrieverError):
    """A take that cannot be rendered as it was asked for."""


Named = TypeVar("Named")


def named(kind: str, name: str, known: Mapping[str, Named]) -> Named:
    """Give what has a name in a table.

    Raises:
        SyntheticError: "unknown_" and the kind, if nothing has that name.
    """
    if name not in known:
        raise unknown_name(kind, name, known)
    return known[name]


def unknown_name(kind: str, name: str, known: Iterable[str]) -> SyntheticError:
    """Build the error for a name that is in no list."""
    return SyntheticError(f"unknown_{kind}", f"expected a {kind} of {', '.join(known)}; got {name!r}")
