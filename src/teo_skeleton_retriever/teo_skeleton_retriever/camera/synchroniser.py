# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which depth image belongs to which colour image: by their stamps, within a bound, whatever came first."""

from __future__ import annotations

from bisect import insort
from collections import Counter, deque
from operator import attrgetter
from typing import Any, NamedTuple

# Colour images for which there is no depth image near enough.
NO_DEPTH = "no_depth"
# Depth images that no colour image asked for.
NO_COLOR = "no_color"
# Colour images of before one that was given out already: late, or a second one of the same time.
OVERTAKEN = "overtaken"

# [s] Half the time between images at 30 Hz: cameras that run on their own are never farther apart.
DEFAULT_SLOP = 0.017
# [s] Who allows more pairs images of different poses: such stamps are of different clocks.
GREATEST_SLOP = 1.0

_MISSES = 300  # Ten seconds at 30 Hz say how far apart two cameras are.
_BACKWARDS = 1_000_000_000  # [ns] A stamp so much earlier is a clock or a bag set back, not a late message.


class Pair(NamedTuple):
    """A colour image and the depth image of its time.

    Attributes:
        stamp: Of the colour image [ns].
        color: As it was given.
        depth: As it was given.
    """

    stamp: int
    color: Any
    depth: Any


class _Stamped(NamedTuple):
    stamp: int
    item: Any


_stamp_of = attrgetter("stamp")  # what waits is kept in the order of stamps, also where one comes late


class Synchroniser:
    """Pairs each colour image with the nearest depth image, and waits for it no longer than it must.

    A colour image waits until a depth image of its very stamp or of a later one has come: then no nearer one
    can come any more (a topic's stamps ascend). Pairs come out with ascending stamps. All times are those of
    stamps; when messages arrive does not matter. Stamps that jump back by more than a second start it anew.
    """

    def __init__(self, *, slop: int, capacity: int) -> None:
        """Wait for nothing yet.

        Args:
            slop: Greatest difference between the stamps of a pair [ns].
            capacity: Most images of each kind that wait.
        """
        if slop < 0 or capacity < 1:
            raise ValueError(f"expected slop >= 0 ns and capacity >= 1, got {slop} and {capacity}")
        self._slop = slop
        self._capacity = capacity
        self._colors: list[_Stamped] = []
        self._depths: list[_Stamped] = []
        self._given: int | None = None
        self._latest = {"color": 0, "depth": 0}  # stamps, each of its own clock if the two differ
        self.dropped: Counter[str] = Counter()
        """How many images were dropped, by reason."""
        self.misses: deque[int] = deque(maxlen=_MISSES)
        """How far the nearest depth image was from each of the latest colour images that found none [ns]."""

    def add_color(self, stamp: int, color: Any) -> list[Pair]:
        """Take a colour image; give the pairs that it completes, at most one."""
        self._note("color", stamp)
        if (self._given is not None and stamp <= self._given) or any(c.stamp == stamp for c in self._colors):
            self.dropped[OVERTAKEN] += 1
            return []
        insort(self._colors, _Stamped(stamp, color), key=_stamp_of)
        return self._match()

    def add_depth(self, stamp: int, depth: Any) -> list[Pair]:
        """Take a depth image; give the pairs that it completes, the oldest first."""
        self._note("depth", stamp)
        if any(d.stamp == stamp for d in self._depths):
            self.dropped[NO_COLOR] += 1
            return []
        insort(self._depths, _Stamped(stamp, depth), key=_stamp_of)
        return self._match()

    def finish(self) -> list[Pair]:
        """Give the pairs among what waits; for the end of a recording, where nothing is to come."""
        pairs = [pair for color in list(self._colors) if (pair := self._pair(color)) is not None]
        self._restart()
        return pairs

    def _match(self) -> list[Pair]:
        pairs = []
        # Where depth is late by more images than may wait, the nearest there is may still be near enough.
        while self._colors and (
            len(self._colors) > self._capacity
            or (self._depths and self._depths[-1].stamp >= self._colors[0].stamp)
        ):
            pair = self._pair(self._colors[0])
            if pair is not None:
                pairs.append(pair)
        while len(self._depths) > self._capacity:
            self._depths.pop(0)
            self.dropped[NO_COLOR] += 1
        return pairs

    def _pair(self, color: _Stamped) -> Pair | None:
        """Take a colour image from those that wait, with its depth image and what is older."""
        self._colors.remove(color)
        nearest = min(self._depths, key=lambda depth: abs(depth.stamp - color.stamp), default=None)
        if nearest is None or abs(nearest.stamp - color.stamp) > self._slop:
            self.dropped[NO_DEPTH] += 1
            if nearest is not None:
                self.misses.append(abs(nearest.stamp - color.stamp))
            return None
        before = self._depths.index(nearest)
        self.dropped[NO_COLOR] += before
        del self._depths[: before + 1]
        self._given = color.stamp
        return Pair(color.stamp, color.item, nearest.item)

    def _note(self, kind: str, stamp: int) -> None:
        """Start anew if the stamps of a kind were set back."""
        if stamp < self._latest[kind] - _BACKWARDS:
            self._restart()
        self._latest[kind] = max(self._latest[kind], stamp)

    def _restart(self) -> None:
        self.dropped[NO_DEPTH] += len(self._colors)
        self.dropped[NO_COLOR] += len(self._depths)
        self._colors, self._depths, self._given = [], [], None
        self._latest = {"color": 0, "depth": 0}
