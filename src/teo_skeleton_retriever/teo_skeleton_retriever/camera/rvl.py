# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Depth images in RVL: run lengths of unknown and known pixels, and differences of neighbours.

Source: A. D. Wilson, "Fast Lossless Depth Image Compression", ISS 2017. Numbers are split in groups of three
bits, the lowest first, each in a nibble whose top bit says that another follows; eight nibbles, the first on
top, are a little-endian word of 32 bits. The image is runs: how many pixels are unknown, how many known
follow, and for each of these by how much it differs from the known pixel before it (0 before the first);
signs alternate: 0, -1, 1, -2, 2, ...
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.errors import RetrieverError

_SHIFTS = np.arange(28, -1, -4, dtype=np.uint32)
_MAX_NIBBLES = 11  # 33 bits: more than any number of pixels


def decode_rvl(data: bytes, pixels: int) -> NDArray[np.uint16]:
    """Decode an image.

    Args:
        data: Words of nibbles; bytes beyond the last pixel do not matter.
        pixels: Of the image.

    Returns:
        [mm], 0 where unknown. Shape (pixels,).

    Raises:
        RetrieverError: The data end before the image does, or are not RVL.
    """
    numbers = _numbers(data)
    image = np.zeros(pixels, dtype=np.uint16)
    known_runs: list[slice] = []
    pixel = place = 0
    while pixel < pixels:
        if place + 2 > len(numbers):
            raise RetrieverError("wrong_length", f"expected {pixels} pixels of RVL, got {pixel}")
        unknown, known = int(numbers[place]), int(numbers[place + 1])
        place += 2
        pixel += unknown
        if pixel + known > pixels or place + known > len(numbers):
            raise RetrieverError("wrong_data", f"expected {pixels} pixels of RVL, got a run beyond them")
        if unknown == known == 0:
            raise RetrieverError("wrong_data", "expected RVL, got a run of no pixels")
        image[pixel : pixel + known] = 1  # marked; the values follow for all at once
        known_runs.append(slice(place, place + known))
        pixel += known
        place += known
    if known_runs:
        coded = np.concatenate([numbers[run] for run in known_runs])
        differences = (coded >> 1) ^ -(coded & 1)
        image[image == 1] = np.cumsum(differences).astype(np.uint16)
    return image


def _numbers(data: bytes) -> NDArray[np.int64]:
    """Read all numbers of a stream; what is left of one that is cut off is dropped."""
    words = np.frombuffer(data, dtype="<u4", count=len(data) // 4)
    nibbles = ((words[:, None] >> _SHIFTS) & 15).ravel().astype(np.int64)
    ends = np.flatnonzero(nibbles < 8)
    if not len(ends):
        return np.zeros(0, dtype=np.int64)
    starts = np.concatenate([[0], ends[:-1] + 1])
    if np.any(ends - starts >= _MAX_NIBBLES):
        raise RetrieverError("wrong_data", "expected RVL, got a number of more than 33 bits")
    nibbles = nibbles[: ends[-1] + 1]
    position = np.arange(len(nibbles)) - np.repeat(starts, ends - starts + 1)
    return np.add.reduceat((nibbles & 7) << (3 * position), starts)
