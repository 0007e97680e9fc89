# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The files that OpenPose's `--write_json` writes, in all its versions, and the folder of them.

Versions 0.1 (body), 1.0 (face and hands), 1.1 (candidates), 1.2 (3D), 1.3 (person_id). The oldest releases
called the two-dimensional arrays by the bare name, without `_2d`; so do many tools that imitate them.
"""

from __future__ import annotations

import bisect
import csv
import json
import math
import os
import re
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D

# The version that is written.
VERSION = 1.3
# The versions that are read.
_VERSIONS = (0.1, 1.0, 1.1, 1.2, 1.3)


_COLUMNS = 3  # numbers of a keypoint: x, y [px], score
# The keys of each part of a `Person2D` in the file, the present one first, in the order in which OpenPose
# writes them. What it may write besides (3D points, candidates of body parts, ids) is not used.
PARTS = {
    "body": ("pose_keypoints_2d", "pose_keypoints", "body_parts"),
    "face": ("face_keypoints_2d", "face_keypoints"),
    "left_hand": ("hand_left_keypoints_2d", "hand_left_keypoints"),
    "right_hand": ("hand_right_keypoints_2d", "hand_right_keypoints"),
}
# All people of one image, in OpenPose's order, which says nothing about who is who in the next image.
People = tuple[Person2D, ...]

# A person is about 10 kB of text; nothing that OpenPose writes comes near this.
MAX_FILE_BYTES = 64 * 1024 * 1024


def read_frame(path: Path) -> People:
    """Read one file.

    Raises:
        RetrieverError: The file is missing, too large, no JSON or not OpenPose's; the sentence names it.
    """
    try:
        size = path.stat().st_size
        if size > MAX_FILE_BYTES:
            raise RetrieverError(
                "too_large",
                f"{path}: expected at most {MAX_FILE_BYTES} bytes, got {size}; is it a keypoint file?",
            )
        content = path.read_bytes()
    except OSError as error:
        raise RetrieverError(
            "unreadable", f"{path}: expected a readable file, got: {error.strerror}"
        ) from error
    return parse_frame(content, source=str(path))


def parse_frame(content: bytes | str, *, source: str = "OpenPose JSON") -> People:
    """Read the text of one file.

    Args:
        content: UTF-8 text, with or without a byte order mark.
        source: What errors call it.

    Raises:
        RetrieverError: The code says what is wrong, the sentence where.
    """
    try:
        text = content if isinstance(content, str) else content.decode("utf-8-sig")
        data = json.loads(text)
    except UnicodeDecodeError as error:
        raise RetrieverError(
            "not_text", f"{source}: expected UTF-8 text, got byte {error.start} of none"
        ) from error
    except (json.JSONDecodeError, RecursionError, ValueError) as error:
        raise RetrieverError(
            "not_json",
            f"{source}: expected JSON, got: {error}; an empty or cut file is one still being written",
        ) from error
    if not isinstance(data, dict):
        raise RetrieverError("not_an_object", f"{source}: expected an object, got {_kind(data)}")
    people = data.get("people")
    if not isinstance(people, list):
        raise RetrieverError("no_people", f"{source}: expected a list 'people', got {_kind(people)}")
    _check_version(data.get("version", VERSION), source)
    return tuple(_person(person, f"{source}: people[{i}]") for i, person in enumerate(people))


def _check_version(value: object, source: str) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float) or float(value) not in _VERSIONS:
        raise RetrieverError(
            "unknown_version", f"{source}: expected 'version' among {_VERSIONS}, got {value!r:.40}"
        )


def _person(data: object, source: str) -> Person2D:
    if not isinstance(data, dict):
        raise RetrieverError("not_a_person", f"{source}: expected an object, got {_kind(data)}")
    parts = {part: _part(data, keys, source) for part, keys in PARTS.items()}
    try:
        return Person2D(**parts)
    except RetrieverError as error:
        raise RetrieverError(error.code, f"{source}: {error.sentence}") from error


def _part(person: Mapping[str, object], keys: tuple[str, ...], source: str) -> FloatArray:
    for key in keys:
        if key in person:
            return _table(person[key], f"{source}.{key}")
    return frozen(np.zeros((0, _COLUMNS)))


def _table(value: object, source: str) -> FloatArray:
    if not isinstance(value, list):
        raise RetrieverError("not_a_list", f"{source}: expected a list of numbers, got {_kind(value)}")
    if not all(isinstance(number, int | float) and not isinstance(number, bool) for number in value):
        raise RetrieverError("not_numbers", f"{source}: expected numbers only")
    if len(value) % _COLUMNS:
        raise RetrieverError(
            "wrong_length", f"{source}: expected {_COLUMNS} numbers per keypoint, got {len(value)} in all"
        )
    try:
        table = np.array(value, dtype=np.float64).reshape(-1, _COLUMNS)
    except OverflowError as error:
        raise RetrieverError("not_finite", f"{source}: expected finite numbers, got a huge one") from error
    if not np.isfinite(table).all():
        raise RetrieverError("not_finite", f"{source}: expected finite numbers, got NaN or infinity")
    return frozen(table)


def _kind(value: object) -> str:
    return "nothing" if value is None else type(value).__name__


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

    def read(self, path: Path) -> People | None:
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
