# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One demonstration of a sign: found in a recording, and brought onto TEO."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from teo_description.robot import Robot
from teo_sign_capture.retarget.robot_motion import RobotMotion, retarget_motion
from teo_sign_capture.tracks.segmentation import SignSpan, stays_low, the_sign
from teo_sign_capture.tracks.signer_motion import SIDES_OF, measure_person, signer_motion
from teo_sign_capture.tracks.skeleton_track import WRIST, Flags, SkeletonTrack, seen
from teo_sign_capture.tracks.smoothing import Gap, runs, smooth_track
from teo_signs.errors import LutError
from teo_signs.sign_schema import Handedness, Kind

# [s] Length of the recording before and after a cut in which it is seen where the hands rest, and from which
# keypoints lost at its edges are filled in: a sign's way up takes less than a second.
_CONTEXT = 3.0
# A hand that is lost for more than this share of the stroke, while the other is not, and that moves by less
# than `_STILL` [m], is passive and left out.
_MOSTLY, _STILL = 0.5, 0.08
# Share of a stroke that may be cut off where a hand is lost at its beginning and end: of half a second three
# images at 25 Hz.
_TRIMMED = 0.25
# Share of a hand's keypoints that must be seen for its shape to be known.
_SEEN = 0.5
# [Hz] Frames a second below which signing cannot be read (ITU-T Series H, Supplement 1, 1999), nor captured.
_LEAST_RATE = 12.0
# [s] Rounding of sums of times and of stamps; frames are a hundred times as far apart.
_ROUNDING = 1e-4


@dataclass(frozen=True, kw_only=True)
class Cut:
    """Which part of a recording to look at, in its own time; None for its beginning or end [s]."""

    start: float | None = None
    end: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class SignTake:
    """One demonstration of a sign, on TEO.

    Attributes:
        source: Name of the recording.
        recorded: Day of the recording if it is known.
        span: Where the sign is in the recording.
        has_rest: Whether the hands are seen at rest before or after it, or somebody chose where it begins or
            ends.
        track: The person during the stroke, smoothed; its times begin at 0.
        motion: TEO during the stroke.
        gaps: Times in the recording in which a hand that signs was lost and is filled in.
        lost: Share of the stroke's frames in which a hand that signs was lost [1].
        smoothing: By how much smoothing moved the keypoints of the hands that sign, root mean square [m].
    """

    source: str
    recorded: str | None
    span: SignSpan
    has_rest: bool
    track: SkeletonTrack
    motion: RobotMotion
    gaps: tuple[Gap, ...]
    lost: float
    smoothing: float


def capture_take(
    robot: Robot,
    track: SkeletonTrack,
    *,
    cut: Cut | None = None,
    handedness: Handedness | None = None,
    kind: Kind = "lexical",
) -> SignTake:
    """Find the sign in a recording and bring it onto TEO.

    Args:
        robot: The robot.
        track: The person, as recorded.
        cut: The part to look at; all of it without.
        handedness: Hands that make the sign; those that leave rest without.
        kind: Of the sign.

    Raises:
        LutError: "outside_recording", "no_motion", "several_signs", "too_long", "few_frames", "hand_lost" or
            what `signer_motion` and `retarget_motion` raise.
    """
    cut = cut or Cut()
    offset, raw = _around(track, cut)
    smoothed = smooth_track(raw)
    span = the_sign(
        smoothed.track,
        offset=offset,
        start=None if cut.start is None else cut.start - offset,
        end=None if cut.end is None else cut.end - offset,
    )
    _check_rate(raw, span)
    handedness = handedness or _without_unseen(smoothed.track, span)
    span = _while_seen(smoothed.track, replace(span, handedness=handedness))
    gaps = tuple(
        gap
        for gap in smoothed.gaps
        if gap.part.removesuffix("_hand") in SIDES_OF[handedness]
        and gap.start < span.end
        and gap.end > span.start
    )
    stroke = smoothed.track.between(span.start - _ROUNDING, span.end + _ROUNDING)
    _check_seen(stroke, handedness, offset + span.start)
    signer = signer_motion(stroke, handedness=handedness, person=measure_person(track))
    return SignTake(
        source=track.source,
        recorded=track.recorded,
        span=_moved(span, offset),
        has_rest=not (span.cut_start and span.cut_end) or cut != Cut(),
        track=stroke,
        motion=retarget_motion(robot, signer, spelled=kind == "letter"),
        gaps=tuple(replace(gap, start=gap.start + offset, end=gap.end + offset) for gap in gaps),
        lost=_lost(raw, span),
        smoothing=_difference(raw, smoothed.track, span),
    )


def _around(track: SkeletonTrack, cut: Cut) -> tuple[float, SkeletonTrack]:
    """A part of a recording and what is around it: when it begins [s], and the track as recorded."""
    last = float(track.times[-1])
    start, end = 0.0 if cut.start is None else cut.start, last if cut.end is None else cut.end
    if not 0.0 <= start < end <= last + _ROUNDING:
        raise LutError(
            "outside_recording",
            f"{track.source}: expected --start before --end, both between 0 and {last:.2f} s, got {start:g} "
            f"and {end:g} s",
        )
    times = track.times
    if np.count_nonzero((times >= start - _ROUNDING) & (times <= end + _ROUNDING)) < 2:
        raise LutError(
            "outside_recording", f"{track.source}: expected frames from {start:g} to {end:g} s, got none"
        )
    first = float(times[np.searchsorted(times, start - _CONTEXT)])
    return first, track.between(first, end + _CONTEXT)


def _without_unseen(track: SkeletonTrack, span: SignSpan) -> Handedness:
    """The hands that sign, less one that is lost at times and stays low, or mostly and stands still."""
    if span.handedness != "both":
        return span.handedness
    stroke = track.between(span.start - _ROUNDING, span.end + _ROUNDING)
    for side, other in (("right", "left"), ("left", "right")):
        lost, other_lost = _lost_frames(stroke, side).mean(), _lost_frames(stroke, other).mean()
        wrist = stroke.body.positions[:, WRIST[side]]
        moves = np.linalg.norm(np.ptp(wrist[seen(wrist)], axis=0)) if seen(wrist).any() else 0.0
        idle = (lost > 0.0 and stays_low(stroke, side)) or (lost > _MOSTLY and moves < _STILL)
        if idle and other_lost < _MOSTLY:
            return "right" if other == "right" else "left"
    return "both"


def _while_seen(track: SkeletonTrack, span: SignSpan) -> SignSpan:
    """The span without moments at its beginning and end in which a hand is lost, where they are few."""
    stroke = track.between(span.start - _ROUNDING, span.end + _ROUNDING)
    lost = np.any([_lost_frames(stroke, side) for side in SIDES_OF[span.handedness]], axis=0)
    known = np.flatnonzero(~lost)
    if not known.size:
        return span
    start, end = span.start + stroke.times[known[0]], span.start + stroke.times[known[-1]]
    if span.duration - (end - start) > _TRIMMED * span.duration:
        return span
    return replace(span, start=float(start), end=float(end))


def _lost_frames(track: SkeletonTrack, side: str) -> Flags:
    """In which frames a hand's shape is not known. Shape (T,)."""
    lost: Flags = seen(track.hand(side).positions).mean(axis=1) < _SEEN
    return lost


def _moved(span: SignSpan, offset: float) -> SignSpan:
    """A span in the time of the recording."""
    return replace(
        span,
        leaves=span.leaves + offset,
        start=span.start + offset,
        end=span.end + offset,
        returns=span.returns + offset,
        pauses=tuple(pause + offset for pause in span.pauses),
    )


def _check_rate(raw: SkeletonTrack, span: SignSpan) -> None:
    """Refuse a stroke of so few frames that anything may have happened between them."""
    rate = (np.count_nonzero(_stroke(raw, span)) - 1) / span.duration
    if rate < _LEAST_RATE * (1.0 - _ROUNDING):
        raise LutError(
            "few_frames",
            f"{raw.source}: expected {_LEAST_RATE:g} frames a second or more in the sign, got {rate:.1f}: "
            "record it at a higher rate, 25 or 30 a second",
        )


def _check_seen(stroke: SkeletonTrack, handedness: Handedness, start: float) -> None:
    """Refuse a stroke in which a hand is lost and cannot be filled in."""
    end = start + float(stroke.times[-1])
    for side in SIDES_OF[handedness]:
        for first, last in runs(_lost_frames(stroke, side)):
            raise LutError(
                "hand_lost",
                f"{stroke.source}: expected the {side} hand in view from {start:.2f} to "
                f"{end:.2f} s, got it lost from {start + stroke.times[first]:.2f} to "
                f"{start + stroke.times[last]:.2f} s: record it again, or name the hands with --hands",
            )


def _stroke(raw: SkeletonTrack, span: SignSpan) -> Flags:
    return (raw.times >= span.start - _ROUNDING) & (raw.times <= span.end + _ROUNDING)


def _lost(raw: SkeletonTrack, span: SignSpan) -> float:
    stroke = _stroke(raw, span)
    return float(max(_lost_frames(raw, side)[stroke].mean() for side in SIDES_OF[span.handedness]))


def _difference(raw: SkeletonTrack, smooth: SkeletonTrack, span: SignSpan) -> float:
    """By how much the hands of the stroke were moved, root mean square [m]."""
    away = [
        (smooth.hand(side).positions - raw.hand(side).positions)[_stroke(raw, span)]
        for side in SIDES_OF[span.handedness]
    ]
    return float(np.sqrt(np.nanmean(np.square(np.concatenate(away, axis=1)).sum(axis=2))))
