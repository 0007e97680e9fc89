"""Overlay pictures as an H.264 film that runs at the pace of the recording."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import av
import cv2

from teo_skeleton_retriever.camera.color_image import ColorArray
from teo_skeleton_retriever.output.output_file import temporary_for

_TICKS = 1000  # in a second: a film's times are whole milliseconds
_LONGEST_GAP = 2.0  # [s] a longer gap between images, or a stamp set back, is not sat through


class OverlayVideo:
    """Writes pictures with their stamps. A context manager: the file appears when the block ends well."""

    def __init__(self, path: Path) -> None:
        """Write nothing yet.

        Args:
            path: MP4 file to write, replaced if it exists; its folder exists.

        Raises:
            OutputError: there is no such folder, or the name does not end in .mp4.
        """
        self._path = path
        self._temporary = temporary_for(path, ".mp4")
        self._container: Any = None
        self._stream: Any = None
        self._start = 0.0
        self._last = 0.0
        self._ticks = -1

    def __enter__(self) -> Self:
        # faststart: the index comes first, so that a browser can start before it has everything.
        options = {"movflags": "faststart"}
        self._container = av.open(str(self._temporary), "w", format="mp4", options=options)
        return self

    def add(self, picture: ColorArray, stamp: float) -> None:
        """Append a picture; one of another size than the first is scaled to it.

        Args:
            picture: RGB. Shape (height, width, 3).
            stamp: when it was taken [s].
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

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if self._stream is not None:
                self._container.mux(self._stream.encode(None))
                self._container.close()
                if kind is None:
                    self._temporary.replace(self._path)
        finally:
            self._temporary.unlink(missing_ok=True)
