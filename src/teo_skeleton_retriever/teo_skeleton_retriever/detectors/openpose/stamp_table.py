# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""When the images were taken to which numbered keypoint files belong."""

from __future__ import annotations

import bisect
import csv
import math
from collections.abc import Mapping
from pathlib import Path

from teo_skeleton_retriever.errors import RetrieverError

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
