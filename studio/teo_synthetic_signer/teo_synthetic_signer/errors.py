# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the synthetic signer raises."""

from __future__ import annotations

from collections.abc import Iterable

from teo_skeleton_retriever.errors import RetrieverError


class SyntheticError(RetrieverError):
    """A take that cannot be rendered as it was asked for."""


def unknown_name(kind: str, name: str, known: Iterable[str]) -> SyntheticError:
    """Build the error for a name that is in no list."""
    return SyntheticError(f"unknown_{kind}", f"expected a {kind} of {', '.join(known)}; got {name!r}")
