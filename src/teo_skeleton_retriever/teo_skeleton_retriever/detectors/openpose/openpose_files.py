# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The files that OpenPose's `--write_json` writes, in all its versions.

Versions 0.1 (body), 1.0 (face and hands), 1.1 (candidates), 1.2 (3D), 1.3 (person_id). The oldest releases
called the two-dimensional arrays by the bare name, without `_2d`; so do many tools that imitate them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D

# The version that is written.
VERSION = 1.3
# The versions that are read.
_VERSIONS = (0.1, 1.0, 1.1, 1.2, 1.3)


class PartKeys(NamedTuple):
    """Where one part of a person stands in the file."""

    attribute: str
    """of `Person2D`"""
    keys: tuple[str, ...]
    """in the file; the first is the present one"""


_COLUMNS = 3  # numbers of a keypoint: x, y [px], score
# In the order in which OpenPose writes them. What it may write besides (3D points, candidates of body
# parts, ids) is not used.
PARTS = (
    PartKeys("body", ("pose_keypoints_2d", "pose_keypoints", "body_parts")),
    PartKeys("face", ("face_keypoints_2d", "face_keypoints")),
    PartKeys("left_hand", ("hand_left_keypoints_2d", "hand_left_keypoints")),
    PartKeys("right_hand", ("hand_right_keypoints_2d", "hand_right_keypoints")),
)


@dataclass(frozen=True, eq=False)
class OpenPoseFrame:
    """All people of one image.

    Attributes:
        people: In OpenPose's order, which says nothing about who is who in the next image.
    """

    people: tuple[Person2D, ...]


# A person is about 10 kB of text; nothing that OpenPose writes comes near this.
MAX_FILE_BYTES = 64 * 1024 * 1024


def read_frame(path: Path) -> OpenPoseFrame:
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


def parse_frame(content: bytes | str, *, source: str = "OpenPose JSON") -> OpenPoseFrame:
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
    return OpenPoseFrame(tuple(_person(person, f"{source}: people[{i}]") for i, person in enumerate(people)))


def _check_version(value: object, source: str) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float) or float(value) not in _VERSIONS:
        raise RetrieverError(
            "unknown_version", f"{source}: expected 'version' among {_VERSIONS}, got {value!r:.40}"
        )


def _person(data: object, source: str) -> Person2D:
    if not isinstance(data, dict):
        raise RetrieverError("not_a_person", f"{source}: expected an object, got {_kind(data)}")
    parts = {part.attribute: _part(data, part, source) for part in PARTS}
    try:
        return Person2D(**parts)
    except RetrieverError as error:
        raise RetrieverError(error.code, f"{source}: {error.sentence}") from error


def _part(person: Mapping[str, object], part: PartKeys, source: str) -> FloatArray:
    for key in part.keys:
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
