# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A picture as an array: words at its foot, several side by side, a PNG file."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import zip_longest
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image as PilImage
from PIL import ImageDraw, ImageFont

from teo_common.atomic_files import write_atomically
from teo_description.errors import DescriptionError

# Red, green, blue in 0..255. Shape (height, width, 3).
Image = NDArray[np.uint8]

_INK, _BAND = (25, 30, 40), (255, 255, 255)
_BAND_OPACITY = 0.82
# Our own copy (see NOTICE), so that accents look the same on a machine without any fonts.
_FONT = Path(__file__).parent / "fonts" / "DejaVuSans.ttf"


def captioned(image: Image, caption: str) -> Image:
    """Return the picture with a line of text on a light band at its foot; without text, the picture itself.

    The letters are a twentieth of the picture's height, smaller where a long text would not fit, down to a
    third of that; what is still too long ends in an ellipsis.

    Args:
        image: Shape (height, width, 3).
        caption: Any text of the Latin, Greek or Cyrillic scripts; line breaks become spaces.
    """
    height, width = image.shape[:2]
    # No font fits more than a letter in two pixels; a long text is not measured letter by letter beyond that.
    caption = " ".join(caption[: 4 * width].split())[: width // 2]
    if not caption:
        return image
    band = _band(caption.encode("utf-8", "replace").decode("utf-8"), width, height)
    result = image.copy()
    foot = result[height - band.shape[0] :]
    foot[:] = (foot * (1.0 - _BAND_OPACITY) + band * _BAND_OPACITY).astype(np.uint8)
    return result


@lru_cache(maxsize=64)  # one caption stays for many frames
def _band(caption: str, width: int, height: int) -> Image:
    """The band with the text on it. Shape (about height / 12, width, 3)."""
    largest = max(8, height // 20)
    rows = min(height, largest * 8 // 5)
    band = PilImage.new("RGB", (width, rows), _BAND)
    draw = ImageDraw.Draw(band)
    room = 0.96 * width
    font = _font(largest)
    for size in range(largest, max(7, largest // 3) - 1, -1):
        font = _font(size)
        if draw.textlength(caption, font=font) <= room:
            break
    text = caption
    while len(text) > 1 and draw.textlength(text, font=font) > room:
        text = text.rstrip("…")[:-1] + "…"
    draw.text((width / 2, rows / 2), text, fill=_INK, font=font, anchor="mm")
    return np.asarray(band)


@lru_cache(maxsize=64)
def _font(size: int) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(str(_FONT), size)


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


def save_png(path: Path, image: Image) -> None:
    """Write a picture as PNG, whole or not at all.

    Raises:
        DescriptionError: ``wrong_shape`` for an empty picture.
    """
    if image.size == 0:
        raise DescriptionError("wrong_shape", f"expected a picture, got an array of shape {image.shape}")
    # A third of the size of OpenCV's own choice, for 20 ms a film strip.
    packed = (cv2.IMWRITE_PNG_COMPRESSION, 6)
    _, encoded = cv2.imencode(".png", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), packed)
    write_atomically(path, encoded.tobytes())
