"""From a person's recording to a sign of the table."""

from __future__ import annotations

import datetime
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from teo_description import description_hash
from teo_description.robot import Robot
from teo_lut_executor.capture.knot_reduction import deviation, reduce_to_knots
from teo_lut_executor.capture.measures import limit_margin_deg
from teo_lut_executor.capture.motion_retarget import RobotMotion, retarget_motion
from teo_lut_executor.capture.playback import Playback, play
from teo_lut_executor.capture.segment import SignSpan, the_sign
from teo_lut_executor.capture.skeleton_track import SkeletonTrack
from teo_lut_executor.capture.smoothing import Gap, smooth_track
from teo_lut_executor.capture.takes import Combined, combine
from teo_lut_executor.lut_error import LutError
from teo_lut_executor.sign import Sign, gloss_key
from teo_lut_executor.sign_schema import Handedness, Kind, Provenance, Standing

Array = NDArray[np.float64]

MOST_OUT_OF_REACH = 0.12
"""[m] A hand that is farther than this from where it belongs is at another place: forehead, mouth, chin and
chest are 12 cm apart."""
_SHARE = 95.0
"""[%] Of the frames, so that a single one decides nothing."""
_HANDS = {"right": ("right_hand",), "left": ("left_hand",), "both": ("right_hand", "left_hand")}


@dataclass(frozen=True, kw_only=True)
class Cut:
    """Which part of a recording to look at, in its own time; None for its beginning or end [s]."""

    start: float | None = None
    end: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Take:
    """One demonstration of a sign, on TEO.

    Attributes:
        source: Name of the recording.
        recorded: Day of the recording if it is known.
        span: Where the sign is in the recording.
        track: The person during the stroke, smoothed; its times begin at 0.
        motion: TEO during the stroke.
        gaps: Times in the recording in which a hand that signs was lost and is filled in.
        lost: Share of the stroke's frames in which a hand that signs was lost [1].
        smoothing: By how much smoothing moved the keypoints of the hands that sign, root mean square [m].
    """

    source: str
    recorded: str | None
    span: SignSpan
    track: SkeletonTrack
    motion: RobotMotion
    gaps: tuple[Gap, ...]
    lost: float
    smoothing: float


@dataclass(frozen=True, kw_only=True)
class Origin:
    """What an entry says of where it comes from, beside what the recording itself knows.

    Attributes:
        source: Name of the recording, and what tells it from others.
        standing: How well founded the form is.
        licence: Terms of the recording.
        notes: What a reader must know; may be empty.
    """

    source: str
    standing: Standing
    licence: str
    notes: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Captured:
    """A sign, and what it was made of.

    Attributes:
        sign: The entry.
        takes: Every take that was looked at.
        combined: Which of them the entry is made of, and why.
    """

    sign: Sign
    takes: tuple[Take, ...]
    combined: Combined

    @property
    def take(self) -> Take:
        """The take that leads."""
        return self.takes[self.combined.leader]


def capture_take(
    robot: Robot, track: SkeletonTrack, *, cut: Cut | None = None, handedness: Handedness | None = None
) -> Take:
    """Find the sign in a recording and bring it onto TEO.

    Args:
        robot: The robot.
        track: The person, as recorded.
        cut: The part to look at; all of it without.
        handedness: Hands that make the sign; those that leave rest without.

    Raises:
        LutError: "outside_recording", "no_motion", "several_signs", "too_long", "hand_lost", "unreachable",
            or what `retarget_motion` raises.
    """
    cut = cut or Cut()
    offset, part = _cut(track, cut)
    smoothed = smooth_track(part)
    span = the_sign(smoothed.track, offset=offset)
    handedness = handedness or span.handedness
    span = replace(span, handedness=handedness)
    gaps = tuple(
        gap
        for gap in smoothed.gaps
        if gap.part in _HANDS[handedness] and gap.start < span.end and gap.end > span.start
    )
    _check_gaps(track.source, span, gaps, offset)
    stroke = smoothed.track.between(span.start, span.end)
    raw = part.between(span.start, span.end)
    motion = retarget_motion(robot, stroke, handedness=handedness)
    _check_reach(track.source, motion, offset + span.start)
    return Take(
        source=track.source,
        recorded=track.recorded,
        span=_moved(span, offset),
        track=stroke,
        motion=motion,
        gaps=tuple(replace(gap, start=gap.start + offset, end=gap.end + offset) for gap in gaps),
        lost=_lost(raw, handedness),
        smoothing=_difference(raw, stroke, handedness),
    )


def make_sign(
    robot: Robot, gloss: str, takes: Sequence[Take], origin: Origin, *, kind: Kind = "lexical"
) -> Captured:
    """Make an entry of takes of one sign.

    Args:
        robot: The robot.
        gloss: Name of the sign.
        takes: At least one.
        origin: For the provenance.
        kind: Of the sign.

    Raises:
        LutError: "takes_differ", or what the planner says of a sign that it cannot play.
    """
    combined = combine(robot, [take.motion for take in takes], [take.source for take in takes])
    used = [takes[index] for index in combined.used]
    knots = reduce_to_knots(combined.times, combined.positions)
    sign = Sign(
        gloss=gloss_key(gloss),
        language="lse",
        kind=kind,
        handedness=takes[combined.leader].span.handedness,
        joints=combined.joints,
        times=combined.times[knots],
        knots=combined.positions[knots],
        provenance=_provenance(origin, takes, combined),
        quality={},
    )
    playback = play(robot, sign, combined.times, combined.positions)
    reduction = float(deviation(combined.times, combined.positions, knots).max())
    quality = _quality(used, sign, playback, reduction)
    return Captured(sign=replace(sign, quality=quality), takes=tuple(takes), combined=combined)


def _cut(track: SkeletonTrack, cut: Cut) -> tuple[float, SkeletonTrack]:
    """When the part begins [s], and the part."""
    last = float(track.times[-1])
    start, end = 0.0 if cut.start is None else cut.start, last if cut.end is None else cut.end
    if not 0.0 <= start < end <= last + 1e-6:
        raise LutError(
            "outside_recording",
            f"{track.source}: expected --start before --end, both between 0 and {last:.2f} s, got {start:g} "
            f"and {end:g} s",
        )
    part = track.between(start, end)
    return float(track.times[np.searchsorted(track.times, start)]), part


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


def _check_gaps(source: str, span: SignSpan, gaps: Sequence[Gap], offset: float) -> None:
    for gap in gaps:
        if not gap.filled:
            raise LutError(
                "hand_lost",
                f"{source}: expected the {gap.part.replace('_', ' ')} in view from {span.start + offset:.2f} "
                f"to {span.end + offset:.2f} s, got it lost from {gap.start + offset:.2f} to "
                f"{gap.end + offset:.2f} s: record it again, or name the hands that sign with --hands",
            )


def _check_reach(source: str, motion: RobotMotion, start: float) -> None:
    away = np.nanmax(motion.place_error, axis=1)
    if np.percentile(away, _SHARE) > MOST_OUT_OF_REACH:
        worst = int(np.argmax(away))
        raise LutError(
            "unreachable",
            f"{source}: expected hands at places that TEO reaches within {100.0 * MOST_OUT_OF_REACH:.0f} cm, "
            f"got one {100.0 * away[worst]:.0f} cm off at {start + motion.times[worst]:.2f} s",
        )


def _lost(raw: SkeletonTrack, handedness: Handedness) -> float:
    lost = [~np.isfinite(getattr(raw, part).positions).all(axis=2) for part in _HANDS[handedness]]
    return float(max((hand.mean(axis=1) > 0.5).mean() for hand in lost))


def _difference(raw: SkeletonTrack, smooth: SkeletonTrack, handedness: Handedness) -> float:
    away = [getattr(smooth, part).positions - getattr(raw, part).positions for part in _HANDS[handedness]]
    return float(np.sqrt(np.nanmean(np.square(np.concatenate(away, axis=1)).sum(axis=2))))


def _provenance(origin: Origin, takes: Sequence[Take], combined: Combined) -> Provenance:
    take = takes[combined.leader]
    gaps = [gap for index in combined.used for gap in takes[index].gaps]
    filled = "; ".join(f"{gap.part.replace('_', ' ')} {gap.start:.2f} to {gap.end:.2f} s" for gap in gaps)
    notes = (
        combined.reason if len(takes) > 1 else "",
        f"Lost and filled in: {filled}." if filled else "",
        origin.notes,
    )
    return Provenance(
        standing=origin.standing,
        source=origin.source,
        method=(
            "keypoints in space smoothed by their sigma, stroke cut out, brought onto TEO frame by frame, "
            "reduced to knots (lut capture)"
        ),
        recorded=take.recorded,
        created=datetime.date.today().isoformat(),
        licence=origin.licence,
        description_hash=description_hash(),
        notes=" ".join(filter(None, notes)),
    )


def _quality(takes: Sequence[Take], sign: Sign, playback: Playback, reduction: float) -> dict[str, float]:
    def usual(errors: str) -> float:
        """The worse hand's error that 95 of 100 frames keep below, mean of the takes."""
        figures = [np.nanpercentile(getattr(take.motion, errors), _SHARE, axis=0) for take in takes]
        return float(np.mean([np.nanmax(figure) for figure in figures]))

    figures = {
        "place_error_p95_mm": 1000.0 * usual("place_error"),
        "palm_error_p95_deg": np.degrees(usual("palm_error")),
        "finger_error_p95_deg": np.degrees(usual("finger_error")),
        "flexion_error_p95_deg": np.degrees(usual("flexion_error")),
        "smoothing_mm": 1000.0 * max(take.smoothing for take in takes),
        "lost_percent": 100.0 * max(take.lost for take in takes),
        "knots_error_deg": np.degrees(reduction),
        "played_error_deg": np.degrees(playback.path_error),
        "stretch_times": playback.stretch,
        "clearance_mm": 1000.0 * playback.clearance,
        "limit_margin_deg": limit_margin_deg(sign.joints, sign.knots),
        "takes_count": float(len(takes)),
    }
    # Adding zero takes the sign from -0.0.
    return {
        name: round(float(value), 2 if name == "stretch_times" else 1) + 0.0
        for name, value in figures.items()
    }
