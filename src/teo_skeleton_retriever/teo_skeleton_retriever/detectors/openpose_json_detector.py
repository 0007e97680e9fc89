# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keypoints of OpenPose: read as it writes them, read beside a recording, or known already."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.detector import ImageArray, check_image
from teo_skeleton_retriever.detectors.openpose_files import PERIOD, OpenPoseFolder, People, StampTable
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25

# Source of the figures: OpenPose 1.7, `keypointScaler.cpp`: fractions are of size - 1, one factor for both
# axes where an image is fitted into a resolution. Pixels of the image; of the network's input; of the
# output; [0, 1]; [-1, 1].
_SOURCE, _NET, _OUTPUT, _UNIT, _SYMMETRIC = range(5)


class KeypointScale:
    """Brings keypoints into pixels.

    Args:
        keypoint_scale: OpenPose's option of that name: 0 to 4.
        resolution: Width, height of the network's input for 1 (`--net_resolution`), of the output for 2
            (`--output_resolution`); the image was fitted into it.

    Raises:
        RetrieverError: No such scale, or a resolution is missing, superfluous or none.
    """

    def __init__(self, keypoint_scale: int, resolution: Sequence[int] | None) -> None:
        if keypoint_scale not in range(5):
            raise RetrieverError("bad_scale", f"expected a keypoint_scale of 0 to 4, got {keypoint_scale!r}")
        fitted = keypoint_scale in (_NET, _OUTPUT)
        if fitted and (resolution is None or len(resolution) != 2 or min(resolution) < 2):
            raise RetrieverError(
                "bad_resolution",
                f"keypoint_scale {keypoint_scale}: expected the resolution (width, height) [px] that "
                f"keypoints are in, got {resolution!r}",
            )
        if not fitted and resolution is not None:
            raise RetrieverError(
                "bad_resolution", f"keypoint_scale {keypoint_scale}: expected no resolution, got {resolution}"
            )
        self._kind = keypoint_scale
        self._resolution = resolution

    def to_pixels(self, person: Person2D, width: int, height: int) -> Person2D:
        """Give a person in BODY_25 and in pixels of an image of this size; what is unseen becomes zero."""
        scale, offset = self._factors(width, height)
        return replace(
            person,
            body=_scaled(as_body_25(person.body), scale, offset),
            left_hand=_scaled(person.left_hand, scale, offset),
            right_hand=_scaled(person.right_hand, scale, offset),
            face=_scaled(person.face, scale, offset),
        )

    def _factors(self, width: int, height: int) -> tuple[FloatArray, float]:
        last = np.array([width - 1.0, height - 1.0])
        if self._kind == _UNIT:
            return last, 0.0
        if self._kind == _SYMMETRIC:
            return last / 2.0, 1.0
        if self._resolution is None:
            return np.ones(2), 0.0
        into = np.array(self._resolution, dtype=np.float64) - 1.0
        return np.full(2, 1.0 / min(into / np.maximum(last, 1.0))), 0.0


def _scaled(table: FloatArray, scale: FloatArray, offset: float) -> FloatArray:
    seen = table[:, 2:] > 0.0  # in [-1, 1] OpenPose writes -1, -1, 0 for what it did not see
    return np.where(seen, np.column_stack([(table[:, :2] + offset) * scale, table[:, 2]]), 0.0)


Found = TypeVar("Found")
_PAIRINGS = ("order", "stamp", "newest")


class OpenPoseJsonDetector:
    """Gives what OpenPose wrote for an image. The image itself is looked at for its size only.

    How a file is found that belongs to an image:

    - `order`: the first image is the file of the lowest number, each following one that of the next number.
      For a folder beside a recording, and live where OpenPose sees every image that comes here.
    - `stamp`: by a table of the time of each number.
    - `newest`: the newest file that is whole and was not given before. For a camera that both watch; the
      keypoints are those of some image shortly before, which suits slow movements only.

    A frame that OpenPose left out is one without people; `missing` counts them.

    Args:
        folder: What OpenPose's `--write_json` was given.
        pairing: `order`, `stamp` or `newest`. Default: `stamp` if there are stamps, else `order`.
        stamps: The table for `stamp`; see `StampTable`.
        wait: How long a file is waited for that is not there, or not whole, yet [s]. OpenPose takes about
            0.2 s for an image on a good GPU.
        keypoint_scale: What OpenPose was given; see `KeypointScale`.
        resolution: Likewise.

    Raises:
        RetrieverError: No such folder, or options that do not go together.
    """

    name = "openpose_json"
    images_at_once = 1

    def __init__(
        self,
        *,
        folder: str | Path,
        pairing: str | None = None,
        stamps: Mapping[int, float] | Mapping[str, float] | str | Path | None = None,
        wait: float = 1.0,
        keypoint_scale: int = 0,
        resolution: Sequence[int] | None = None,
    ) -> None:
        pairing = pairing or ("order" if stamps is None else "stamp")
        if pairing not in _PAIRINGS or (pairing == "stamp") != (stamps is not None):
            raise RetrieverError(
                "bad_option",
                f"expected a pairing of {', '.join(_PAIRINGS)}, and stamps for 'stamp' alone, got "
                f"{pairing!r} {'without' if stamps is None else 'with'} stamps",
            )
        if not 0.0 <= wait < float("inf"):
            raise RetrieverError("bad_option", f"wait: expected a time [s], got {wait}")
        self._folder = OpenPoseFolder(Path(folder))
        self._table = None if stamps is None else StampTable(stamps)
        self._scale = KeypointScale(keypoint_scale, resolution)
        self._wait = wait
        self._newest = pairing == "newest"
        # What is there already was written before this began.
        self._last = max(self._folder.files(), default=-1) if self._newest else None
        self._closed = False
        self.missing = 0

    def detect(self, image: ImageArray, stamp: float) -> tuple[Person2D, ...]:
        """Give the people of the image; see `Detector.detect`.

        Raises:
            RetrieverError: A file did not come or was not whole in time, or is not OpenPose's. The next image
                is paired with its own file all the same.
        """
        if self._closed:
            raise RetrieverError("closed", "expected an open detector, got one that was closed")
        check_image(image, stamp)
        people = self._people(stamp)
        height, width = image.shape[:2]
        return tuple(self._scale.to_pixels(person, width, height) for person in people)

    def close(self) -> None:
        """Give nothing any more."""
        self._closed = True

    def _people(self, stamp: float) -> People:
        if self._newest:
            return self._within_wait(self._read_newest, "a new file")
        number = self._next_number() if self._table is None else self._table.number_at(stamp)
        if number is None:
            return self._left_out()
        return self._within_wait(lambda: self._read(number), f"the file of frame {number}")

    def _within_wait(self, look: Callable[[], Found | None], what: str) -> Found:
        deadline = time.monotonic() + self._wait
        while (found := look()) is None:
            if time.monotonic() >= deadline:
                raise RetrieverError("late", f"expected {what}, whole, within {self._wait} s; got none")
            time.sleep(PERIOD)
        return found

    def _next_number(self) -> int:
        if self._last is None:
            self._last = -1 + self._within_wait(
                lambda: min(self._folder.files(), default=None), "a first file"
            )
        self._last += 1
        return self._last

    def _read(self, number: int) -> People | None:
        files = self._folder.files()
        if number in files:
            return self._folder.read(files[number])
        # OpenPose writes in order: what a later file has overtaken does not come any more.
        return self._left_out() if any(other > number for other in files) else None

    def _read_newest(self) -> People | None:
        assert self._last is not None
        files = self._folder.files()
        for number in sorted((number for number in files if number > self._last), reverse=True):
            frame = self._folder.read(files[number])
            if frame is not None:
                self._last = number
                return frame
        return None

    def _left_out(self) -> People:
        self.missing += 1
        return ()


class ReplayDetector:
    """Gives what is known for the time of an image; nobody where nothing is known.

    Args:
        frames: The time [s] and the people of each image, in any order.
        folder: Instead, a folder of OpenPose's files that is written already.
        stamps: The time of each file's number; see `StampTable`. Without it, the images are those of the
            files in their order.

    Raises:
        RetrieverError: Neither frames nor folder, or both, or what `OpenPoseJsonDetector` raises.
    """

    name = "replay"
    images_at_once = 1

    def __init__(
        self,
        *,
        frames: Sequence[tuple[float, Sequence[Person2D]]] | None = None,
        folder: str | Path | None = None,
        stamps: Mapping[int, float] | Mapping[str, float] | str | Path | None = None,
    ) -> None:
        if (frames is None) == (folder is None) or (folder is None and stamps is not None):
            raise RetrieverError("bad_option", "expected either frames, or a folder with or without stamps")
        self._folder = (
            None if folder is None else OpenPoseJsonDetector(folder=folder, stamps=stamps, wait=0.0)
        )
        self._frames = [
            (stamp, tuple(replace(person, body=as_body_25(person.body)) for person in people))
            for stamp, people in frames or ()
        ]
        self._table = (
            StampTable({i: stamp for i, (stamp, _) in enumerate(self._frames)}) if self._frames else None
        )
        self._closed = False

    def detect(self, image: ImageArray, stamp: float) -> tuple[Person2D, ...]:
        """Give the people of that time; see `Detector.detect`."""
        if self._closed:
            raise RetrieverError("closed", "expected an open detector, got one that was closed")
        if self._folder is not None:
            return self._folder.detect(image, stamp)
        check_image(image, stamp)
        number = None if self._table is None else self._table.number_at(stamp)
        return () if number is None else self._frames[number][1]

    def close(self) -> None:
        """Give nothing any more."""
        self._closed = True
