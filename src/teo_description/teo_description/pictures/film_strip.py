# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Several moments of a motion side by side on one picture."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest

import numpy as np

from teo_description.errors import DescriptionError
from teo_description.pictures.captions import captioned
from teo_description.pictures.renderer import Image

# White between the pictures [pixel].
_GAP = 4


def film_strip(frames: Sequence[Image], captions: Sequence[str] = (), columns: int = 6) -> Image:
    """Lay frames out in rows, left to right and top to bottom.

    Args:
        frames: Pictures of one size.
        captions: A text for each frame, or fewer: the rest go without.
        columns: How many a row.

    Returns:
        One picture.

    Raises:
        DescriptionError: ``empty_motion``, ``wrong_shape`` or ``bad_columns``.
    """
    if not frames:
        raise DescriptionError("empty_motion", "expected at least one frame for a film strip, got none")
    if columns < 1:
        raise DescriptionError("bad_columns", f"expected one column or more, got {columns}")
    if len(captions) > len(frames):
        raise DescriptionError("wrong_shape", f"expected at most {len(frames)} captions, got {len(captions)}")
    height, width, _ = frames[0].shape
    if any(frame.shape != frames[0].shape for frame in frames):
        raise DescriptionError("wrong_shape", "expected frames of one size, got several")
    columns = min(columns, len(frames))
    rows = -(-len(frames) // columns)
    strip = np.full((rows * (height + _GAP) + _GAP, columns * (width + _GAP) + _GAP, 3), 255, np.uint8)
    for index, (frame, caption) in enumerate(zip_longest(frames, captions, fillvalue="")):
        row, column = divmod(index, columns)
        top, left = _GAP + row * (height + _GAP), _GAP + column * (width + _GAP)
        strip[top : top + height, left : left + width] = captioned(frame, caption)  # type: ignore[arg-type]
    return strip
