# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Overlay pictures as an H.264 film that runs at the pace of the recording."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import cv2

from teo_skeleton_retriever.camera.raw_image import ColorArray
from teo_skeleton_retriever.output.output_file import output_file

_TICKS = 1000  # in a second: a film's times are whole milliseconds
_LONGEST_GAP = 2.0  # [s] a longer gap between images, or a stamp set back, is not sat through


class OverlayVideo:
    """Writes pictures with their stamps to an MP4 file; see `overlay_video`."""

    def __init__(self, container: Any) -> None:
        self._container = container
        self._stream: Any = None
        self._start = 0.0
        self._last = 0.0
        self._ticks = -1

    def add(self, picture: ColorArray, stamp: float) -> None:
        """Append a picture; one of another size than the first is scaled to it.

        Args:
            picture: RGB. Shape (height, width, 3).
            stamp: When it was taken [s].
        """
        # The format wants even sizes.
        height, width = (size - size % 2 for size in picture.shape[:2])
        if self._stream is None:
            self._stream = self._container.add_stream("libx264", rate=30)
            self._stream.width, self._stream.height, self._stream.pix_fmt = width, height, "yuv420p"
            self._stream.codec_context.time_base = Fraction(1, _TICKS)
            # One thread leaves the rest of the machine to the detector.
            self._stream.codec_context.thread_count = 1
            self._stream.options = {"preset": "veryfast", "crf": "21"}
        size = (self._stream.width, self._stream.height)
        fitting = picture[:height, :width] if (width, height) == size else cv2.resize(picture, size)
        frame = av.VideoFrame.from_ndarray(fitting, format="rgb24")
        if not 0.0 <= stamp - self._last <= _LONGEST_GAP:
            # Go on a tick later, as if this had been taken then.
            self._start = stamp - (self._ticks + 1) / _TICKS
        self._last = stamp
        self._ticks = max(round((stamp - self._start) * _TICKS), self._ticks + 1)
        frame.pts, frame.time_base = self._ticks, Fraction(1, _TICKS)
        self._container.mux(self._stream.encode(frame))

    def finish(self) -> None:
        """Write what the encoder holds back."""
        if self._stream is None:
            raise _NoPictureError
        self._container.mux(self._stream.encode(None))


class _NoPictureError(Exception):
    """There is nothing to make a film of."""


@contextmanager
def overlay_video(path: Path) -> Iterator[OverlayVideo]:
    """Write an MP4 file, which appears when the block ends well and there was a picture.

    Args:
        path: File to write, replaced if it exists; its folder exists.

    Raises:
        RetrieverError: There is no such folder, or the name does not end in .mp4.
    """
    # faststart: the index comes first, so that a browser can start before it has everything.
    options = {"movflags": "faststart"}
    with (
        suppress(_NoPictureError),
        output_file(path, ".mp4") as temporary,
        av.open(str(temporary), "w", format="mp4", options=options) as container,
    ):
        film = OverlayVideo(container)
        yield film
        film.finish()
