# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where in a recording the signs are: hands leave rest and return; what lies between is a sign.

A sign is prepared by a way up and followed by a way down (Kita, van Gijn and van der Hulst 1998); an entry
holds the stroke between both, as the planner makes its own ways. The way up ends where the hands first slow
down clearly, or no longer go away from where they rest: a hand swung into its sign slows down nowhere.
The way down begins where they last do, so that holds, shakes and repetitions stay whole. In a film how far
forward a hand is, is guessed: one that comes straight up or falls straight down, as seen from the front, is
on its way, however it seems to swing forth and back meanwhile.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import (
    ELBOW,
    SHOULDER,
    WRIST,
    Flags,
    SkeletonTrack,
    seen,
    smoothed,
)
from teo_sign_capture.tracks.smoothing import runs
from teo_signs.errors import LutError
from teo_signs.sign_schema import Handedness

# [m] Shoulder to wrist of an adult, where the arm's own length is not seen.
_REACH = 0.52

# Lengths below are in reaches.
# Hands rest lower than this below the shoulders: in the lap, folded before the belly, hanging. The space in
# which people sign ends at the waist.
_LOW = 0.6
# Wrists lower than this are below the waist, on arms that hang: what is forward of such a hand follows, in a
# film without depth, from an arm that seems a little too short, and tells nothing.
_HANGS = 0.75
# Rest is no higher than this above the lowest place.
_REST_BAND = 0.25
# A hand this far from rest has left it; one this near has returned: 10 and 8 cm. Hands at rest sway by 3.
_LEAVES, _RETURNS = 0.20, 0.16
# A hand that gets no farther than this from rest was no sign: 18 cm, a scratch or a shift of weight.
_LEAST_WAY = 0.35
# Wrists nearer than this are of hands that may touch: 21 cm, two hands' lengths less what they are bent.
_MEETS = 0.4
# Share of the greatest distance from rest: a recording that begins with hands farther out begins within a
# sign.
_WITHIN = 0.6
# Where somebody chose to cut, hands farther from rest sign: 20 cm, beyond what is left of a way down.
_CUT = 0.4
# Share of the greatest distance from rest: nearer the way up has not ended, whichever way it bends.
_FAR = 0.5

# [m/s] Hands at rest are slower.
_SLOW = 0.25
# A speed that falls below this share of the fastest so far ends the way up.
_DIP = 0.35
# [m/s], of the fastest so far: a hand slower than both has arrived.
_STILL, _STILL_SHARE = 0.08, 0.10
# [s] Width of the Gaussian by which the speed is smoothed: keypoints tremble by 0.1 m/s.
_SPEED_WIDTH = 0.033
# [s] A shorter stay at rest is part of a sign that beats at rest; between two signs people rest for longer.
_LEAST_REST = 0.5
# Share of the largest sign's way from rest: hands that went less far beside it moved, but did not sign.
_FIDGET = 0.6
# [s] Up and down in less is no sign.
_LEAST_SIGN = 0.25
# Share of its speed with which a hand on its way goes straight away from rest, or back to it: 60 deg aside.
# An arm that swings up from hanging until its elbow is bent by 120 deg ends so.
_STRAIGHT = 0.5
# A hand that goes aside faster than this share of its fastest so far swings into its sign; a slower one
# arrives.
_SWINGS = 0.2
# Share of its way from rest after which a hand that swings into its sign without slowing down is in it: its
# path bends there long before it goes aside.
_SWUNG = 0.85
# [s] A sign that is but a touch lasts so long: what is shorter nobody reads.
_LEAST_STROKE = 0.3
# [s] The longest signs of the dictionary (compounds) take 3 s; what is longer is several.
_LONGEST_SIGN = 4.0
# [s] Rounding of sums of times and of stamps; frames are a hundred times as far apart.
_ROUNDING = 1e-4


@dataclass(frozen=True, kw_only=True)
class SignSpan:
    """One sign in a recording.

    Attributes:
        leaves: When the hands leave rest [s].
        start: When the stroke begins [s].
        end: When the stroke ends [s].
        returns: When the hands are at rest again [s].
        handedness: The hands that take part.
        held: Hands that are held up for most of the sign and do nothing: they take no part.
        pauses: When the hands slow down within the stroke [s]: where several signs may meet.
        cut_start: The recording, or the part that was chosen, begins while the hands are away from rest.
        cut_end: Likewise its end.
    """

    leaves: float
    start: float
    end: float
    returns: float
    handedness: Handedness
    held: tuple[str, ...]
    pauses: tuple[float, ...]
    cut_start: bool
    cut_end: bool

    @property
    def duration(self) -> float:
        """How long the stroke lasts [s]."""
        return self.end - self.start


def find_signs(
    track: SkeletonTrack, *, start: float | None = None, end: float | None = None
) -> tuple[SignSpan, ...]:
    """Every sign of a smoothed track, in order.

    Where the hands rest, and whether they ever move, is seen in the whole track, also if only a part of it is
    looked at.

    Args:
        track: The person.
        start: Where the part begins that somebody chose [s]: hands that are away from rest there sign
            already. The track's beginning without.
        end: Likewise its end.

    Raises:
        LutError: "empty_track" if no frame is in the part.
    """
    times = track.times
    begin = 0 if start is None else int(np.searchsorted(times, start - _ROUNDING))
    stop = len(times) if end is None else int(np.searchsorted(times, end + _ROUNDING))
    if begin >= stop:
        raise LutError(
            "empty_track",
            f"{track.source}: expected frames between {start} and {end} s, got none: it lasts from 0 to "
            f"{times[-1]:.2f} s",
        )
    reach = _reach(track)
    away = {side: _distance_from_rest(track, side, reach) for side in WRIST}
    out = np.logical_or(*(_has_left(distance) for distance in away.values()))
    out[:begin] = out[stop:] = False
    # A short rest between two beats joins what is around it.
    for first, last in runs(~out):
        if first > begin and last < stop - 1 and times[last] - times[first] < _LEAST_REST:
            out[first : last + 1] = True
    ways = {
        (first, last): max(float(np.nanmax(one[first : last + 1], initial=0.0)) for one in away.values())
        for first, last in runs(out)
        if times[last] - times[first] >= _LEAST_SIGN
    }
    least = max(_LEAST_WAY, _FIDGET * max(ways.values(), default=0.0))
    cut = start is not None, end is not None
    return tuple(
        _span(track, away, reach, first, last, part=(begin, stop - 1), cut=cut)
        for (first, last), way in ways.items()
        if way >= least
    )


def the_sign(
    track: SkeletonTrack, *, offset: float = 0.0, start: float | None = None, end: float | None = None
) -> SignSpan:
    """The one sign of a smoothed track.

    Args:
        track: The person.
        offset: What is added to times in messages, where the track is a part of a recording [s].
        start: See `find_signs`.
        end: Likewise.

    Raises:
        LutError: "empty_track", "no_motion", "several_signs" or "too_long", naming where things are.
    """
    spans = find_signs(track, start=start, end=end)
    if not spans:
        length = (track.times[-1] if end is None else end) - (0.0 if start is None else start)
        raise LutError(
            "no_motion",
            f"{track.source}: expected hands that leave rest and return, got none that goes "
            f"{100.0 * _LEAST_WAY * _reach(track):.0f} cm from it within {length:.1f} s",
        )
    if len(spans) > 1:
        where = "; ".join(
            f"--start {span.leaves + offset:.2f} --end {span.returns + offset:.2f}" for span in spans
        )
        raise LutError(
            "several_signs", f"{track.source}: expected one sign, got {len(spans)}. Take one: {where}"
        )
    span = spans[0]
    if span.duration > _LONGEST_SIGN:
        pauses = ", ".join(f"{pause + offset:.2f}" for pause in span.pauses) or "no time"
        raise LutError(
            "too_long",
            f"{track.source}: expected a sign of at most {_LONGEST_SIGN:g} s, got hands that are away from "
            f"rest for {span.returns - span.leaves:.1f} s: probably several signs. They slow down "
            f"at {pauses} s: cut there with --start and --end",
        )
    return span


def _reach(track: SkeletonTrack) -> float:
    """Length of the arm, elbow stretched [m]."""
    lengths = []
    for side in WRIST:
        points = track.body.positions[:, [SHOULDER[side], ELBOW[side], WRIST[side]]]
        upper, fore = np.linalg.norm(np.diff(points, axis=1), axis=-1).T
        if np.isfinite(upper).any() and np.isfinite(fore).any():
            lengths.append(float(np.nanmedian(upper) + np.nanmedian(fore)))
    return float(np.mean(lengths)) if lengths else _REACH


def stays_low(track: SkeletonTrack, side: str) -> bool:
    """Whether a wrist, where it is seen, stays below the space in which people sign."""
    heights = track.body.positions[:, WRIST[side], 2]
    known = heights[np.isfinite(heights)]
    return bool(known.size) and float(np.percentile(known, 95.0)) < -_LOW * _reach(track)


def _distance_from_rest(track: SkeletonTrack, side: str, reach: float) -> Array:
    """How far a wrist is from where it rests [reach]; 0 while it is lost low, NaN while lost high."""
    wrist = track.body.positions[:, WRIST[side]] / reach
    known = seen(wrist)
    if not known.any():
        return np.zeros(len(wrist))  # an arm that is never seen hangs out of the image
    height = wrist[:, 2]
    lowest = float(np.nanpercentile(height, 5.0))
    resting = known & (height < min(-_LOW, lowest + _REST_BAND)) & (_speed(track, [side]) < _SLOW)
    if resting.any():
        way = wrist - np.median(wrist[resting], axis=0)
        way[height < -_HANGS, 0] = 0.0
        distance: Array = np.linalg.norm(way, axis=-1)
    else:  # never seen at rest: how far it is above the space where hands rest
        distance = np.maximum(height + _LOW + _LEAVES, 0.0)
    for first, last in runs(~known):
        beside = [height[index] for index in (first - 1, last + 1) if 0 <= index < len(height)]
        # Hands that hang are often below the image: lost beside a low place is at rest.
        distance[first : last + 1] = 0.0 if min(beside) < -_LOW + _REST_BAND else np.nan
    return distance


def _has_left(distance: Array) -> Flags:
    """Whether a hand is away from rest, with hysteresis; lost hands keep what they did."""
    out = np.zeros(len(distance), dtype=bool)
    # NaN before anything is known is taken for away: the recording begins within a sign.
    now = bool(len(distance)) and not distance[0] < _LEAVES
    for index, value in enumerate(distance):
        if np.isfinite(value):
            now = bool(value > (_RETURNS if now else _LEAVES))
        out[index] = now
    return out


def _span(
    track: SkeletonTrack,
    away: Mapping[str, Array],
    reach: float,
    first: int,
    last: int,
    *,
    part: tuple[int, int],
    cut: tuple[bool, bool],
) -> SignSpan:
    inside = slice(first, last + 1)
    far = {side: float(np.nanmax(distance[inside], initial=0.0)) for side, distance in away.items()}
    # The hand that gets farther leads; the other takes part if it is away for half of the time and does
    # something there.
    lead = max(far, key=lambda side: far[side])
    raised = [side for side, one in away.items() if side == lead or _has_left(one)[inside].mean() > 0.5]
    sides = [side for side in raised if side == lead or _is_used(track, side, inside, reach)]
    times, speed = track.times, _speed(track, sides)[inside]
    distance = np.nan_to_num(away[lead][inside])
    aside = _aside(track, lead, reach)[inside] & _aside(_from_the_front(track), lead, reach)[inside]
    start = _arrival(speed, aside, distance)
    end = len(speed) - 1 - _arrival(speed[::-1], aside[::-1], distance[::-1])
    # A recording that was cut there, while the hands were away, begins or ends with the stroke.
    if first == part[0] and distance[0] > (_CUT if cut[0] else _WITHIN * distance.max()):
        start = 0
    if last == part[1] and distance[-1] > (_CUT if cut[1] else _WITHIN * distance.max()):
        end = len(distance) - 1
    if start > end:  # straight there and back without a stop
        start = end = int(distance.argmax())
    start, end = _at_least(times[inside], start, end)
    return SignSpan(
        leaves=float(times[max(first - 1, part[0])]),
        start=float(times[first + start]),
        end=float(times[first + end]),
        returns=float(times[min(last + 1, part[1])]),
        handedness="both" if len(sides) == 2 else "right" if sides[0] == "right" else "left",
        held=tuple(side for side in raised if side not in sides),
        pauses=tuple(float(times[first + index]) for index in _dips(speed) if start < index < end),
        cut_start=first == part[0],
        cut_end=last == part[1],
    )


def _is_used(track: SkeletonTrack, side: str, inside: slice, reach: float) -> bool:
    """Whether a hand moves, or is where the other one comes to; else it rests, wherever it is held."""
    own, other = (
        track.body.positions[:, WRIST[one]] / reach for one in (side, "left" if side == "right" else "right")
    )
    with np.errstate(invalid="ignore"):
        near = np.linalg.norm((own - other)[inside], axis=-1) < _MEETS
    known = own[seen(own)]
    return bool(near.any() or (len(known) > 0 and np.linalg.norm(np.ptp(known, axis=0)) >= _LEAST_WAY))


def _speed(track: SkeletonTrack, sides: list[str]) -> Array:
    """Speed of the fastest of some wrists [m/s]; 0 where they are lost. Shape (n,)."""
    times = track.times
    if len(times) < 2:
        return np.zeros(len(times))
    wrists = track.body.positions[:, [WRIST[side] for side in sides]]
    velocity = np.gradient(wrists, times, axis=0)
    speed = np.nan_to_num(np.linalg.norm(velocity, axis=-1)).max(axis=1)
    return smoothed(times, speed, _SPEED_WIDTH)


def _from_the_front(track: SkeletonTrack) -> SkeletonTrack:
    """The person without depth."""
    return replace(track, body=replace(track.body, positions=track.body.positions * (0.0, 1.0, 1.0)))


def _aside(track: SkeletonTrack, side: str, reach: float) -> Flags:
    """Whether a hand far from rest goes neither straight away from it nor straight back. Shape (n,)."""
    times, distance = track.times, reach * _distance_from_rest(track, side, reach)
    if len(times) < 2:
        return np.zeros(len(times), dtype=bool)
    straight = np.abs(np.gradient(smoothed(times, distance, _SPEED_WIDTH), times))
    with np.errstate(invalid="ignore"):
        aside: Flags = straight < _STRAIGHT * _speed(track, [side])
        return aside & (distance > _FAR * np.nanmax(distance, initial=0.0))


def _arrival(speed: Array, aside: Flags, distance: Array) -> int:
    """Index at which a hand that leaves rest first slows down clearly or goes aside; past the end if none.

    A hand that swings into its sign is there for the last part of its way from rest already.

    Args:
        speed: [m/s]. Shape (n,).
        aside: Whether the hand goes neither away from rest nor back. Shape (n,).
        distance: From rest [reach]. Shape (n,).
    """
    fastest = 0.0
    for index in range(len(speed) - 1):
        fastest = max(fastest, float(speed[index]))
        if fastest < _SLOW:
            continue
        if speed[index] < max(_STILL, _STILL_SHARE * fastest):
            return index
        if speed[index] < _DIP * fastest and speed[index] <= speed[index + 1]:
            return index
        if aside[index] and speed[index] < _SWINGS * fastest:
            return index
        if aside[index]:
            return int(np.argmax(distance[: index + 1] >= _SWUNG * distance[index]))
    return len(speed)


def _dips(speed: Array) -> list[int]:
    """Where a hand slows down clearly between two faster movements: the slowest moment of each dip."""
    found: list[int] = []
    fastest, slowest = 0.0, -1
    for index, value in enumerate(speed.tolist()):
        if slowest < 0:  # in a movement
            fastest = max(fastest, value)
            if fastest > _SLOW and value < _DIP * fastest:
                slowest = index
        elif value < speed[slowest]:
            slowest = index
        elif value > max(_SLOW, float(speed[slowest]) / _DIP):
            found.append(slowest)
            fastest, slowest = value, -1
    return found


def _at_least(times: Array, start: int, end: int) -> tuple[int, int]:
    """Make a stroke that is but a touch last a little, evenly to both sides."""
    while times[end] - times[start] < _LEAST_STROKE and (start > 0 or end < len(times) - 1):
        start, end = max(start - 1, 0), min(end + 1, len(times) - 1)
    return start, end
