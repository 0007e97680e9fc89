# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where a network is trained: the device, the threads of its CPU, its random numbers."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import torch

from teo_sign_translator.errors import TranslationError


def named_device(name: str | None) -> torch.device:
    """The device of a name as PyTorch has it; if None, an accelerator if there is one, else the CPU.

    Raises:
        TranslationError: "invalid_config" if this machine has no such device.
    """
    if name is None:
        return torch.device("cuda" if torch.cuda.is_available() else "cpu")
    try:
        device = torch.device(name)
        torch.empty(0, device=device)
    except (RuntimeError, AssertionError) as error:  # the latter is how PyTorch says "built without CUDA"
        raise TranslationError(
            "invalid_config", f"expected a device of this machine such as cpu or cuda, got '{name}': {error}"
        ) from error
    return device


@contextmanager
def one_thread() -> Iterator[None]:
    """Let PyTorch use one thread of the CPU inside the `with`, and as many as before behind it.

    The products of a batch are small. One thread needs 0.9 ms of an AMD EPYC for a pair; two, on a machine
    that others use as well, 10.6 ms, since each waits for the other and burns its core meanwhile.
    """
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        yield
    finally:
        torch.set_num_threads(before)


@contextmanager
def seeded(seed: int) -> Iterator[None]:
    """PyTorch's random numbers from a seed; the caller's go on afterwards."""
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        yield
