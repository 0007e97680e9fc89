# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The folder into which OpenPose writes a file of keypoints for each image, and which image each is of."""

from __future__ import annotations

import bisect
import csv
import math
import os
import re
import time
from collections.abc import Mapping
from pathlib import Path

from teo_skeleton_retriever.detectors.openpose.openpose_files import OpenPoseFrame, read_frame
from teo_skeleton_retriever.errors import RetrieverError

# The frame's number is what the name ends in: `000000000012_keypoints.json`, `video_12_keypoints.json`.
_NAME = re.compile(r"(?:^|.*?)(\d+)_keypoints\.json")
# How a file looks that is still being written; nothing else of it can be right.
_HALF_WRITTEN = frozenset({"not_json", "not_text"})
# A folder's time of change is coarse (jiffies, or 10 ms on some file systems): one that changed just now may
# change again without telling.
_SETTLED_NS = 100_000_000
# Between two looks at the folder [s]; short beside the 0.2 s that OpenPose takes for an image.
PERIOD = 0.01


class OpenPoseFolder:
    """Finds files by frame number and reads them when they are whole.

    Args:
        folder: What `--write_json` was given.

    Raises:
        RetrieverError: There is no such folder.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._scanned_ns = -1
        self._files: dict[int, Path] = {}
        self._names: set[str] = set()
        self.files()

    def files(self) -> Mapping[int, Path]:
        """Give the files by frame number, whole or not; looks only if the folder has changed.

        Raises:
            RetrieverError: The folder is gone or cannot be read, or a name carries no number.
        """
        try:
            changed_ns = self._folder.stat().st_mtime_ns
            if changed_ns != self._scanned_ns:
                with os.scandir(self._folder) as entries:  # ten thousand files in a few milliseconds
                    for entry in entries:
                        self._add(entry.name)
                # Coarse times: believe them only when they are old.
                self._scanned_ns = changed_ns if time.time_ns() - changed_ns > _SETTLED_NS else -1
        except OSError as error:
            raise RetrieverError(
                "no_folder", f"{self._folder}: expected a folder of OpenPose's files, got: {error.strerror}"
            ) from error
        return self._files

    def read(self, path: Path) -> OpenPoseFrame | None:
        """Read a file; None if it is not whole yet.

        Raises:
            RetrieverError: It is whole and not OpenPose's.
        """
        try:
            return read_frame(path)
        except RetrieverError as error:
            if error.code in _HALF_WRITTEN:
                return None
            raise RetrieverError("bad_file", error.sentence) from error

    def _add(self, name: str) -> None:
        if name in self._names or name.startswith(".") or not name.endswith("_keypoints.json"):
            return
        match = _NAME.fullmatch(name)
        if match is None:
            raise RetrieverError(
                "no_number", f"{self._folder / name}: expected a name that ends in a frame number"
            )
        number = int(match[1])
        if number in self._files:
            raise RetrieverError(
                "two_series",
                f"{self._folder}: expected one file of number {number}, got {self._files[number].name} "
                f"and {name}; take a folder for each recording",
            )
        self._names.add(name)
        self._files[number] = self._folder / name


# How far a stamp may be off [s]: half the time between two images of a usual camera.
NEAR = 1.0 / 60.0


class StampTable:
    """Frame numbers by time.

    Args:
        stamps: The time of each frame [s] by its number, or a text file of `number,stamp` lines, with or
            without a headline.

    Raises:
        RetrieverError: The file cannot be read, or something in it is no number or no time.
    """

    def __init__(self, stamps: Mapping[int, float] | Mapping[str, float] | str | Path) -> None:
        pairs = stamps.items() if isinstance(stamps, Mapping) else _lines(Path(stamps))
        self._frames = sorted((_stamp(stamp), _number(number)) for number, stamp in pairs)
        if not self._frames:
            raise RetrieverError("no_stamps", "expected at least one frame number with its time, got none")

    def number_at(self, stamp: float) -> int | None:
        """Give the number of the frame taken nearest to a time [s], if it is near."""
        after = bisect.bisect_left(self._frames, (stamp, -1))
        neighbours = self._frames[max(after - 1, 0) : after + 1]
        found, number = min(neighbours, key=lambda frame: abs(frame[0] - stamp))
        return number if abs(found - stamp) <= NEAR else None


def _lines(path: Path) -> list[tuple[str, str]]:
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = [row for row in csv.reader(file) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise RetrieverError("bad_stamps", f"{path}: expected lines of number,stamp, got: {error}") from error
    if rows and not rows[0][0].strip().isdecimal():
        rows = rows[1:]
    for row in rows:
        if len(row) != 2:
            raise RetrieverError("bad_stamps", f"{path}: expected number,stamp, got {','.join(row):.80}")
    return [(row[0], row[1]) for row in rows]


def _number(value: object) -> int:
    try:
        number = int(str(value))
    except ValueError:
        number = -1
    if number < 0:
        raise RetrieverError("bad_stamps", f"expected frame numbers from 0, got {value!r:.40}")
    return number


def _stamp(value: object) -> float:
    try:
        stamp = float(str(value))
    except ValueError:
        stamp = math.nan
    if not math.isfinite(stamp):
        raise RetrieverError("bad_stamps", f"expected a finite time [s] for each frame, got {value!r:.40}")
    return stamp
