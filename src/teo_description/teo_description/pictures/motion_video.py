# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A motion as an H.264 film."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import ExitStack, suppress
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import av

from teo_common.atomic_files import atomic_path
from teo_description.errors import DescriptionError
from teo_description.pictures.picture import Image, captioned


class MotionVideo:
    """Writes frames to an MP4 (H.264, yuv420p: every browser and player reads it).

    A context manager. The file appears under its name, whole, when the block ends without an error, and not
    at all otherwise.
    """

    def __init__(self, path: Path, *, frames_per_second: float = 25.0) -> None:
        """Check the figures; nothing is written before the first frame.

        Args:
            path: File to write; its folder exists.
            frames_per_second: Frames for each second of the film.

        Raises:
            DescriptionError: ``bad_rate`` or ``missing_folder``.
        """
        if not 1.0 <= frames_per_second <= 240.0:
            raise DescriptionError(
                "bad_rate", f"expected 1 to 240 frames per second, got {frames_per_second}"
            )
        if not path.parent.is_dir():
            raise DescriptionError(
                "missing_folder", f"expected an existing folder for {path.name}, got {path.parent}"
            )
        self._path = path
        self._rate = Fraction(frames_per_second).limit_denominator(1001)
        self._open = ExitStack()
        self._container: Any = None
        self._stream: Any = None
        self._shape: tuple[int, ...] | None = None
        self.frame_count = 0
        """Frames added so far."""

    def __enter__(self) -> Self:
        temporary = self._open.enter_context(atomic_path(self._path))
        self._open.push(self._finish)
        # faststart: the index comes first, so a browser can start before it has everything.
        self._container = av.open(str(temporary), "w", format="mp4", options={"movflags": "faststart"})
        return self

    def add(self, frame: Image, caption: str = "") -> None:
        """Append a frame, with a line of text at its foot.

        Raises:
            DescriptionError: ``wrong_shape`` when it is not an even-sized picture like those before.
        """
        if self._stream is None:
            self._start(frame)
        if frame.shape != self._shape:
            raise DescriptionError(
                "wrong_shape", f"expected a frame of shape {self._shape} like the first, got {frame.shape}"
            )
        picture = av.VideoFrame.from_ndarray(captioned(frame, caption), format="rgb24")
        picture.pts = self.frame_count
        picture.time_base = 1 / self._rate
        self._container.mux(self._stream.encode(picture))
        self.frame_count += 1

    def _start(self, frame: Image) -> None:
        if frame.ndim != 3 or frame.shape[2] != 3 or frame.shape[0] % 2 or frame.shape[1] % 2:
            raise DescriptionError(
                "wrong_shape", f"expected a picture of even height and width, 3 colours; got {frame.shape}"
            )
        self._shape = frame.shape
        stream = self._container.add_stream("libx264", rate=self._rate)
        stream.height, stream.width = frame.shape[:2]
        stream.pix_fmt = "yuv420p"
        # One thread: films are made while other processes move the robot. veryfast takes about 2 ms a frame.
        stream.codec_context.thread_count = 1
        stream.options = {"preset": "veryfast", "crf": "21"}
        self._stream = stream

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._open.__exit__(kind, error, trace)

    def _finish(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is None and self.frame_count:
            self._container.mux(self._stream.encode(None))
            self._container.close()
            return
        with suppress(av.FFmpegError):  # a film without an ending is not valid, and it is thrown away
            self._container.close()
        if kind is None:
            raise DescriptionError(
                "empty_motion", f"expected at least one frame for {self._path.name}, got none"
            )


def write_video(
    path: Path,
    frames: Iterable[Image],
    captions: Iterable[str] = (),
    *,
    frames_per_second: float = 25.0,
) -> int:
    """Write frames, drawn as they are needed, to an MP4; captions may run out before the frames do.

    Returns:
        How many frames were written.

    Raises:
        DescriptionError: see `MotionVideo`.
    """
    texts = iter(captions)
    with MotionVideo(path, frames_per_second=frames_per_second) as video:
        for frame in frames:
            video.add(frame, next(texts, ""))
    return video.frame_count
