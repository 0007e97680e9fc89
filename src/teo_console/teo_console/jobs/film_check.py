# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Looks at a film in a process of its own: `python film_check.py FORMAT FILE` prints its figures as JSON.

FFmpeg reads what a stranger may have made. It is told the container, so that no playlist is taken for a film,
and may open this one file alone; what breaks here breaks a process with limits.
"""

from __future__ import annotations

import json
import sys
from typing import Any, NoReturn

# Narrower pictures show no fingers [pixels].
_LEAST_WIDTH = 160
# A side of the largest pictures that telephones film [pixels].
_MOST_SIDE = 4096
# [s] Ten times a sign with a rest before and after; capture asks for a cut of longer ones in any case.
_MOST_SECONDS = 60.0
# Packets of a minute at the highest rate of telephones.
_MOST_PACKETS = 60 * 240


def main(container_format: str, path: str) -> None:
    """Print width, height [pixels], seconds and images of a film, or why it is none ("bad_film")."""
    import av  # here: a process that only imports this module needs no FFmpeg

    try:
        # Names beside the images are of no account, and in any encoding.
        only = {"protocol_whitelist": "file"}
        with av.open(path, format=container_format, options=only, metadata_errors="replace") as film:
            figures = _figures(film)
    except (av.error.FFmpegError, ValueError, OSError) as error:
        _refuse(f"expected a film that can be read, got: {error}")
    print(json.dumps(figures))


def _figures(film: Any) -> dict[str, float]:
    stream = film.streams.best("video")  # a cover is a stream of images too
    if stream is None:
        _refuse("expected a stream of images, got none")
    width, height = stream.codec_context.width, stream.codec_context.height
    if min(width, height) < _LEAST_WIDTH or max(width, height) > _MOST_SIDE:
        _refuse(f"expected images of {_LEAST_WIDTH} to {_MOST_SIDE} pixels a side, got {width}x{height}")
    images, last, first, shown = 0, 0.0, None, False
    for packet in film.demux(stream):
        if packet.pts is None:
            continue
        shown = shown or bool(packet.decode())  # the first image may need more than the first packet
        images += 1
        seconds = float(packet.pts * packet.time_base)
        first = seconds if first is None else min(first, seconds)
        last = max(last, seconds)
        if images > _MOST_PACKETS or last - first > _MOST_SECONDS:
            _refuse(f"expected a film of at most {_MOST_SECONDS:g} s, got a longer one: cut the sign out")
    if first is None or not shown or images < 2:
        _refuse("expected a film with images, got none that can be shown")
    return {"width": width, "height": height, "seconds": round(last - first, 3), "images": images}


def _refuse(reason: str) -> NoReturn:
    sys.exit(f"bad_film: {reason}")


if __name__ == "__main__":
    main(*sys.argv[1:3])
