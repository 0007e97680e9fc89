# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words on pictures."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
from PIL import Image as PilImage
from PIL import ImageDraw, ImageFont

from teo_description.pictures.renderer import Image

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
