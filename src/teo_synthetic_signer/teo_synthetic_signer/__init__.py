# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""People who sign before a depth camera: rendered colour and depth, with the true place of each keypoint.

`render_take` gives the frames of a take. The names below are loaded when they are first used, so that
importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from teo_synthetic_signer.take.take import Take, TakeOptions, render_take
    from teo_synthetic_signer.take.take_bag import write_take
    from teo_synthetic_signer.take.truth import SyntheticFrame, Truth

__all__ = ["SyntheticFrame", "Take", "TakeOptions", "Truth", "render_take", "write_take"]

_MODULE_OF = {
    "SyntheticFrame": "take.truth",
    "Take": "take.take",
    "TakeOptions": "take.take",
    "Truth": "take.truth",
    "render_take": "take.take",
    "write_take": "take.take_bag",
}


def __getattr__(name: str) -> object:
    """Load a public name from its module."""
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE_OF[name]}"), name)
