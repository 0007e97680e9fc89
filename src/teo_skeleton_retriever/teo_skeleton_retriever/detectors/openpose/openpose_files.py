# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The files that OpenPose's `--write_json` writes, in all its versions.

Versions 0.1 (body), 1.0 (face and hands), 1.1 (candidates), 1.2 (3D), 1.3 (person_id). The oldest releases
called the two-dimensional arrays by the bare name, without `_2d`; so do many tools that imitate them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import UNKNOWN_ID, Person2D

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
    columns: int
    """numbers per keypoint"""


# In the order in which OpenPose writes them.
PARTS = (
    PartKeys("body", ("pose_keypoints_2d", "pose_keypoints", "body_parts"), 3),
    PartKeys("face", ("face_keypoints_2d", "face_keypoints"), 3),
    PartKeys("left_hand", ("hand_left_keypoints_2d", "hand_left_keypoints"), 3),
    PartKeys("right_hand", ("hand_right_keypoints_2d", "hand_right_keypoints"), 3),
    PartKeys("body_3d", ("pose_keypoints_3d",), 4),
    PartKeys("face_3d", ("face_keypoints_3d",), 4),
    PartKeys("left_hand_3d", ("hand_left_keypoints_3d",), 4),
    PartKeys("right_hand_3d", ("hand_right_keypoints_3d",), 4),
)


@dataclass(frozen=True, eq=False)
class OpenPoseFrame:
    """All people of one image.

    Attributes:
        people: In OpenPose's order, which says nothing about who is who in the next image.
        part_candidates: Body parts before they were assembled to people: x, y [px], score by body part index.
            Shape (n, 3) each; empty without `--part_candidates`.
        version: Of the file format.
    """

    people: tuple[Person2D, ...]
    part_candidates: Mapping[int, FloatArray] = field(default_factory=dict)
    version: float = VERSION


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
    return OpenPoseFrame(
        tuple(_person(person, f"{source}: people[{i}]") for i, person in enumerate(people)),
        _candidates(data.get("part_candidates", []), source),
        _version(data.get("version", VERSION), source),
    )


def _version(value: object, source: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or float(value) not in _VERSIONS:
        raise RetrieverError(
            "unknown_version", f"{source}: expected 'version' among {_VERSIONS}, got {value!r:.40}"
        )
    return float(value)


def _person(data: object, source: str) -> Person2D:
    if not isinstance(data, dict):
        raise RetrieverError("not_a_person", f"{source}: expected an object, got {_kind(data)}")
    parts = {part.attribute: _part(data, part, source) for part in PARTS}
    person_id = _person_id(data.get("person_id", [UNKNOWN_ID]), source)
    try:
        return Person2D(**parts, person_id=person_id)
    except RetrieverError as error:
        raise RetrieverError(error.code, f"{source}: {error.sentence}") from error


def _part(person: Mapping[str, object], part: PartKeys, source: str) -> FloatArray:
    for key in part.keys:
        if key in person:
            return _table(person[key], part.columns, f"{source}.{key}")
    return frozen(np.zeros((0, part.columns)))


def _person_id(value: object, source: str) -> int:
    # OpenPose writes a list of one; some tools that imitate it write the number.
    number = value[0] if isinstance(value, list) and len(value) == 1 else value
    if isinstance(number, bool) or not isinstance(number, int):
        raise RetrieverError(
            "bad_person_id", f"{source}.person_id: expected a list of one whole number, got {value!r:.40}"
        )
    return number


def _candidates(value: object, source: str) -> dict[int, FloatArray]:
    if not isinstance(value, list) or not all(isinstance(entry, dict) for entry in value):
        raise RetrieverError(
            "bad_candidates", f"{source}.part_candidates: expected a list of objects, got {_kind(value)}"
        )
    found: dict[int, FloatArray] = {}
    for entry in value:
        for key, numbers in entry.items():
            if not (key.isascii() and key.isdigit()):
                raise RetrieverError(
                    "bad_candidates",
                    f"{source}.part_candidates: expected indices of body parts, got {key!r:.40}",
                )
            found[int(key)] = _table(numbers, 3, f"{source}.part_candidates.{key}")
    return found


def _table(value: object, columns: int, source: str) -> FloatArray:
    if not isinstance(value, list):
        raise RetrieverError("not_a_list", f"{source}: expected a list of numbers, got {_kind(value)}")
    if not all(isinstance(number, int | float) and not isinstance(number, bool) for number in value):
        raise RetrieverError("not_numbers", f"{source}: expected numbers only")
    if len(value) % columns:
        raise RetrieverError(
            "wrong_length", f"{source}: expected {columns} numbers per keypoint, got {len(value)} in all"
        )
    try:
        table = np.array(value, dtype=np.float64).reshape(-1, columns)
    except OverflowError as error:
        raise RetrieverError("not_finite", f"{source}: expected finite numbers, got a huge one") from error
    if not np.isfinite(table).all():
        raise RetrieverError("not_finite", f"{source}: expected finite numbers, got NaN or infinity")
    return frozen(table)


def _kind(value: object) -> str:
    return "nothing" if value is None else type(value).__name__
