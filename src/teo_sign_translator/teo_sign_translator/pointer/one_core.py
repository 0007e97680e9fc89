"""Keeping NumPy's matrix products on one core while a sentence is translated."""

from __future__ import annotations

from contextlib import AbstractContextManager
from functools import cache

import numpy as np  # noqa: F401 - its BLAS must be loaded before it can be found
from threadpoolctl import ThreadpoolController  # type: ignore[import-untyped] # ships no types


def one_core() -> AbstractContextManager[object]:
    """Let BLAS use one thread inside the `with`, and as many as before behind it (8 µs).

    The products of one sentence are so small that sharing them out costs more than it gains, and on a busy
    machine each waits for its slowest part: 46 ms a sentence were measured where one core took 3.
    """
    limiter: AbstractContextManager[object] = _blas().limit(limits=1)
    return limiter


@cache
def _blas() -> ThreadpoolController:
    return ThreadpoolController().select(user_api="blas")
