# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Paths of a neck joint that make a gesture: shakes, nods, and leans throughout a question.

Each gesture offers several paths, the best first. Some may be too fast for the joint: `Splicer.spliced`
returns None for them. The times of the hands are given, and it is the head that adapts: a gesture begins
before its signs and ends after them where the neck needs longer, and has fewer swings where there is less
time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import NamedTuple

from teo_motion.trajectory.joint_motion import JointMotion
from teo_motion.trajectory.splice import Splicer, StandPoint, position_at, rest_after, shifted

# How far the head turns to either side in a shake [rad], as in the table's sign NO. The front of TEO's head,
# 0.1 m from the axis, moves by 42 mm then: more than a degree of sight for somebody 2 m away. A swing of
# 24 deg takes the neck 0.68 s at 50 deg/s and 7 rad/s^2, so that it shakes at 0.7 Hz; people are about twice
# as fast, and more than 12 deg would be slower still.
_SHAKE = math.radians(12.0)

# A nod [rad]: from a little up to down, as the table's SÍ, which goes from -6 to 8 deg.
_NOD = (math.radians(-5.0), math.radians(9.0))

# Times the least time of a move from rest to rest [1]: unhurried first, then as the limits allow; the last is
# for a joint that is on its way already where the gesture begins.
_EASES = (1.5, 1.1, 2.5)

# Swings of a shake take so many times their least time [1]: a little more, for they are seldom too slow.
_SWING_EASE = 1.02

# A position that is kept for less than this is not seen to be kept, and left out [s].
_LEAST_HOLD = 0.3

# Times the least time of the swing into a sign's own motion or out of it [1]: the sign may shake as well.
_JOIN_EASE = 1.1

# Moves between equal positions still take a time [s].
_LEAST_MOVE = 0.05

# A shake turns to either side [1]: less than two swings is looking aside.
_LEAST_SWINGS = 2


class NeckPath(NamedTuple):
    """What a joint does instead of its part in the plan."""

    begin: float
    """When it leaves its motion [s]."""
    points: tuple[StandPoint, ...]
    """Where it stands still in between, in order of time."""
    end: float
    """When it is back on its motion [s]."""


class GestureWindow(NamedTuple):
    """The time for a gesture of one joint, between signs that move the joint themselves."""

    begin: float
    """Earliest instant at which the joint may leave its motion [s]."""
    first: float
    """When the gesture is to begin [s]."""
    last: float
    """When it is to end [s]."""
    end: float
    """Latest instant at which the joint must be back on its motion [s]."""
    comes_from_sign: bool
    """Whether the window begins where a sign that is part of the gesture ends."""
    goes_on_into_sign: bool
    """Whether it ends where such a sign begins."""
    motion: JointMotion
    """The joint's motion without the gesture; it may jump where the window begins and ends."""
    least_time: Callable[[float], float]
    """Time that the joint needs for a distance [rad] from rest to rest [s]."""

    def time_in(self, position: float, ease: float) -> float:
        """Time to take from the plan's motion to a position [s]."""
        left = self._position(max(self.begin, self.first - ease * self.least_time(position)))
        return max(_LEAST_MOVE, ease * self.least_time(position - left))

    def time_out(self, position: float, ease: float) -> float:
        """Time to take from a position back to the plan's motion [s]."""
        met = self._position(min(self.end, self.last + ease * self.least_time(position)))
        return max(_LEAST_MOVE, ease * self.least_time(position - met))

    @property
    def before(self) -> float:
        """Where the joint is as the window begins [rad]."""
        return position_at(self.motion, self.begin, side="left")

    @property
    def behind(self) -> float:
        """Where it is as the window ends [rad]."""
        return position_at(self.motion, self.end, side="right")

    def _position(self, time: float) -> float:
        return self.before if time <= self.begin else position_at(self.motion, time, side="right")


def hold_paths(position: float, window: GestureWindow) -> Iterator[NeckPath]:
    """Paths that keep a position [rad] over the whole gesture."""
    for ease in _EASES:
        time_in, time_out = window.time_in(position, ease), window.time_out(position, ease)
        arrival = max(window.first, window.begin + time_in)
        departure = min(window.last, window.end - time_out)
        if departure - arrival >= _LEAST_HOLD:
            points = (StandPoint(arrival, position), StandPoint(departure, position))
            yield NeckPath(arrival - time_in, points, departure + time_out)


def nod_paths(strength: float, window: GestureWindow) -> Iterator[NeckPath]:
    """Paths that nod: lowest in the middle of the sign, or as near to it as the window allows."""
    positions = tuple(strength * angle for angle in _NOD)
    for ease in _EASES:
        for turns in (positions, positions[1:]):
            steps = [later - earlier for earlier, later in pairwise((0.0, *turns, 0.0))]
            takes = [ease * window.least_time(step) for step in steps]
            earliest = (window.first + window.last) / 2.0 - sum(takes[:-1])
            begin = max(window.begin, min(earliest, window.end - sum(takes)))
            times = list(accumulate(takes, initial=begin))
            if times[-1] <= window.end:
                points = tuple(StandPoint(time, turn) for time, turn in zip(times[1:-1], turns, strict=True))
                yield NeckPath(begin, points, times[-1])


def shake_paths(strength: float, window: GestureWindow) -> Iterator[NeckPath]:
    """Paths that shake the head over the whole gesture."""
    swing = _SWING_EASE * window.least_time(2.0 * _SHAKE)
    # Away from where the motion of a sign before or after is; else to the right first, as in NO.
    right = -strength * _SHAKE
    begins = math.copysign(right, -window.before) if window.comes_from_sign else right
    ends = math.copysign(right, -window.behind) if window.goes_on_into_sign else right
    for ease in _EASES:
        time_in = window.time_in(begins, min(ease, _JOIN_EASE) if window.comes_from_sign else ease)
        time_out = window.time_out(ends, min(ease, _JOIN_EASE) if window.goes_on_into_sign else ease)
        times = _turns(window, window.begin + time_in, window.end - time_out, swing)
        if not times:
            continue
        turns = [begins * (-1.0) ** index for index in range(len(times))]
        if window.goes_on_into_sign and turns[-1] != ends:
            if window.comes_from_sign:  # one swing too many
                times, turns = _evenly(times[0], times[-1], len(times) - 1), turns[:-1]
            else:
                turns = [-turn for turn in turns]
        if turns:
            points = tuple(StandPoint(time, turn) for time, turn in zip(times, turns, strict=True))
            begin = window.begin if window.comes_from_sign else times[0] - time_in
            yield NeckPath(begin, points, window.end if window.goes_on_into_sign else times[-1] + time_out)


def _turns(window: GestureWindow, earliest: float, latest: float, swing: float) -> list[float]:
    """When a shake turns [s]: a swing apart, from about the gesture's beginning to about its end."""
    most = math.floor((latest - earliest) / swing)
    first, last = max(earliest, window.first), min(latest, window.last)
    wanted = round((last - first) / swing)
    if window.comes_from_sign and window.goes_on_into_sign:
        return _evenly(earliest, latest, most + 1)
    if window.comes_from_sign or window.goes_on_into_sign:
        swings = min(max(wanted, 1), most)
        begin = first if window.comes_from_sign else last - swings * swing
    else:
        swings = min(max(wanted, _LEAST_SWINGS), most)
        if swings < _LEAST_SWINGS:
            return []
        begin = min(first, latest - swings * swing)
    return [begin + index * swing for index in range(swings + 1)]


def _evenly(first: float, last: float, count: int) -> list[float]:
    """So many instants from the first to the last [s]; one alone is in the middle."""
    if count == 1:
        return [(first + last) / 2.0]
    return [first + index * (last - first) / (count - 1) for index in range(count)]


# From and to [s].
Times = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Lean:
    """A joint's motion with a lean.

    Attributes:
        motion: The motion.
        start: When the joint first leans as far as it will [s].
        end: When it last does [s].
    """

    motion: JointMotion
    start: float
    end: float


class Leaning:
    """Leans one joint throughout a question, with what signs do with it on top.

    A sign that bows the head itself, as BEBER does, bows it from where the question has it, or from less far
    where the neck ends: its own movement stays whole. A question about being ill would else end with the
    raised head of ENFERMO and look like another.
    """

    def __init__(self, splicer: Splicer, least_time: Callable[[float], float]) -> None:
        """Lean a joint that keeps its limits, and needs a time [s] for a distance [rad] from rest to rest."""
        self._splicer = splicer
        self._least_time = least_time

    def leaned(
        self,
        motion: JointMotion,
        angle: float,
        during: Times,
        kept: Sequence[Times],
        shifts: Sequence[float],
        begin: float = 0.0,
    ) -> Lean | None:
        """The motion with a lean; None if there is no time for any.

        Args:
            motion: Motion of the joint.
            angle: Where to lean while no sign turns the joint [rad].
            during: When to lean [s].
            kept: When the joint is to move as it does, in order.
            shifts: By how much it may be turned then [rad], between 0 and `angle` or 0. Neighbours without
                time for the way from one to the other are turned by the lesser.
            begin: Until when the joint stands still [s].
        """
        levels = [0.0, *shifts, 0.0]
        gaps = list(pairwise([begin, *(time for times in kept for time in times), motion.duration]))[::2]
        while True:
            leaned = motion
            for (start, end), level in zip(kept, levels[1:-1], strict=True):
                if level:
                    leaned = shifted(leaned, start, end, level)
            seen = [time for times, level in zip(kept, levels[1:-1], strict=True) if level for time in times]
            for index, gap in enumerate(gaps):
                found = self._across(leaned, angle, during, gap, (levels[index], levels[index + 1]))
                if found is None:
                    levels[index] = levels[index + 1] = min(levels[index], levels[index + 1], key=abs)
                    levels[0] = levels[-1] = 0.0
                    break
                leaned, times = found
                seen += times
            else:
                return Lean(motion=leaned, start=min(seen), end=max(seen)) if seen else None

    def _across(
        self, motion: JointMotion, angle: float, during: Times, gap: Times, levels: Times
    ) -> tuple[JointMotion, tuple[float, ...]] | None:
        """The motion across a gap between kept times, and when it is at the angle; None if impossible."""
        begin, end = gap
        if begin >= end:
            return (motion, ()) if levels[0] == levels[1] else None
        window = GestureWindow(
            begin=begin,
            first=max(begin, during[0]),
            last=min(end, during[1]),
            end=end,
            comes_from_sign=False,
            goes_on_into_sign=False,
            motion=motion,
            least_time=self._least_time,
        )
        for path in (*hold_paths(angle, window), *self._straight(motion, angle, gap, levels)):
            spliced = self._splicer.spliced(motion, path.begin, path.points, path.end)
            if spliced is not None:
                return spliced, tuple(point.time for point in path.points)
        if levels[0] != levels[1]:
            return None
        return shifted(motion, begin, end, levels[0]), ()

    def _straight(self, motion: JointMotion, angle: float, gap: Times, levels: Times) -> Iterator[NeckPath]:
        """Paths from one level [rad] to the other: late where the first is 0, early where the second is."""
        begin, end = gap
        if levels[0] == levels[1]:
            return
        for ease in _EASES:
            takes = ease * self._least_time(angle)
            if not levels[0]:
                yield NeckPath(max(begin, end - takes), (), end)
            elif not levels[1]:
                yield NeckPath(begin, (), min(end, rest_after(motion, begin + takes)))
        yield NeckPath(begin, (), end)
