# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From takes to a sign of the table: made, played by the planner as a check, and judged."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from msgspec.structs import replace as changed

from teo_common.arrays import Array
from teo_description.humanoid import Side
from teo_description.robot import Robot
from teo_motion.planner import DEFAULT_PERIOD, Planner
from teo_motion.sentence.plan import Plan, sample_at
from teo_motion.sentence.signing_style import SigningStyle
from teo_sign_capture.entries.gates import Verdict, accepted_standing, judge, objections
from teo_sign_capture.entries.take import SignTake
from teo_sign_capture.entries.take_combination import Combined, combine
from teo_sign_capture.retarget.handshapes import HeldShape
from teo_sign_capture.retarget.knots import (
    TOLERANCE,
    deviations,
    limit_margin_deg,
    reduce_to_knots,
    smoothest_motion,
    tube_radii,
)
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError, PlanError
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_schema import Kind, Provenance, Standing
from teo_signs.tokens import Kind as TokenKind
from teo_signs.tokens import Token

# [m] Said in the entry's notes: the hand may be at another place, forehead, mouth, chin and chest are so far
# apart.
_SAID_OUT_OF_REACH = 0.12
# [%] Percentile over the frames that errors are given at, so that a single one decides nothing.
_SHARE = 95.0
# Decimals of figures, where they are not one.
_DECIMALS = {"stretch_times": 2, "major_place_wrong": 2, "stroke_s": 2, "movement_s": 2}
# How much a hand is on the body, 0 to 1, from which on its place counts as a contact's: a keypoint is within
# 5 cm of the skin, as those of finger tips and palms that touch are.
_TOUCHING = 0.9


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
        verdicts: How it stands at every gate.
    """

    sign: Sign
    takes: tuple[SignTake, ...]
    combined: Combined
    verdicts: tuple[Verdict, ...]

    @property
    def take(self) -> SignTake:
        """The take that leads."""
        return self.takes[self.combined.leader]


def make_sign(
    robot: Robot,
    gloss: str,
    takes: Sequence[SignTake],
    origin: Origin,
    *,
    language: str = DEFAULT_LANGUAGE,
    kind: Kind = "lexical",
    accept: bool = False,
) -> Captured:
    """Make an entry of takes of one sign.

    Args:
        robot: The robot.
        gloss: Name of the sign.
        takes: At least one.
        origin: For the provenance.
        language: Code of its sign language.
        kind: Of the sign.
        accept: Whether a sign beyond a gate is taken all the same, one level less well founded.

    Raises:
        LutError: "takes_differ", or what the planner says of a sign that it cannot play.
        RefusedError: The sign is beyond a gate.
    """
    combined = combine(robot, [take.motion for take in takes], [take.source for take in takes])
    used = [takes[index] for index in combined.used]
    sign = Sign(
        gloss=gloss_key(gloss),
        language=language,
        robot=robot.humanoid.name,
        kind=kind,
        handedness=takes[combined.leader].span.handedness,
        joints=combined.joints,
        times=combined.times,
        knots=combined.positions,
        provenance=_provenance(robot, origin, takes, combined),
        quality={},
    )
    sign, playback = _played(robot, sign)
    away = deviations(combined.times, combined.positions, sign.times, sign.knots).max(axis=0)
    quality = _quality(robot, used, sign, playback, away) | {"takes_count": float(len(takes))}
    # A letter is a posture that is held: clips of the alphabet begin and end with the hand raised.
    has_rest = kind == "letter" or any(take.has_rest for take in used)
    share = playback.slowest / sign.duration if sign.duration else 0.0
    worst = _worst_moments(takes[combined.leader], share)
    verdicts = judge(quality, duration=sign.duration, has_rest=has_rest, worst=worst)
    standing = accepted_standing(sign.gloss, origin.standing, verdicts, accept=accept)
    provenance = _accepted(sign.provenance, standing, objections(verdicts))
    sign = replace(sign, quality=quality, provenance=provenance)
    return Captured(sign=sign, takes=tuple(takes), combined=combined, verdicts=verdicts)


def _accepted(provenance: Provenance, standing: Standing, against: Sequence[Verdict]) -> Provenance:
    """The provenance of a sign that was taken though something speaks against it."""
    reasons = "; ".join(objection.message for objection in against)
    though = f"Accepted by a person beyond a gate: {reasons}." if reasons else ""
    notes = " ".join(filter(None, (though, provenance.notes)))
    return changed(provenance, standing=standing, notes=notes)


def _played(robot: Robot, whole: Sign) -> tuple[Sign, Playback]:
    """The sign in fewer knots, gently moved, and what the planner makes of it."""
    for share in (1.0, 0.5, 0.25, 0.0):
        gentle = smoothest_motion(robot.humanoid, whole.times, whole.joints, whole.knots, share=share)
        knots = reduce_to_knots(whole.times, gentle, share * TOLERANCE)
        sign = replace(whole, times=whole.times[knots], knots=gentle[knots])
        try:
            return sign, play(robot, sign, whole.times, whole.knots)
        except LutError as error:
            # A hand that all but touches has no room for a tube, nor for a spline between far knots.
            if error.code != "self_collision" or share == 0.0:
                raise
    raise AssertionError("the last share returns or raises")


def _provenance(robot: Robot, origin: Origin, takes: Sequence[SignTake], combined: Combined) -> Provenance:
    take = takes[combined.leader]
    gaps = [gap for index in combined.used for gap in takes[index].gaps]
    filled = "; ".join(f"{gap.part.replace('_', ' ')} {gap.start:.2f} to {gap.end:.2f} s" for gap in gaps)
    away = float(np.nanmax(take.motion.seen_place_error))
    held = [side for side in take.span.held if take.span.handedness not in (side, "both")]
    notes = (
        combined.reason if len(takes) > 1 else "",
        f"Lost and filled in: {filled}." if filled else "",
        _said_shapes(take.motion.handshapes),
        f"The {held[0]} hand is held up, does nothing and is left out: --hands both." if held else "",
        f"A hand is seen up to {100.0 * away:.0f} cm off its place." if away > _SAID_OUT_OF_REACH else "",
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
        description_hash=robot.humanoid.description_hash,
        notes=" ".join(filter(None, notes)),
    )


def _said_shapes(handshapes: Mapping[Side, Sequence[HeldShape]]) -> str:
    """Which shapes the hands hold, and how sure that is, in a sentence."""
    hands = [
        f"{side} {', then '.join(f'{shape} ({100.0 * chance:.0f} % sure)' for shape, chance in held)}"
        for side, held in handshapes.items()
        if held
    ]
    return f"Handshapes: {'; '.join(hands)}." if hands else ""


def _quality(
    robot: Robot, takes: Sequence[SignTake], sign: Sign, playback: Playback, away: Array
) -> dict[str, float]:
    def of_hands(field: str, figure: Callable[[Array], float]) -> float:
        """A figure of the hands that take part, shape (T, hands), mean of the takes."""
        found = [getattr(take.motion, field) for take in takes]
        return float(np.mean([figure(array[:, np.isfinite(array).any(axis=0)]) for array in found]))

    def usual(errors: str) -> float:
        """The worse hand's error that 95 of 100 frames keep below."""
        return of_hands(errors, lambda hands: np.nanpercentile(hands, _SHARE, axis=0).max())

    def share(field: str, worse: Callable[[Array], float]) -> float:
        """Share of the stroke's frames, of the worse hand."""
        return of_hands(field, lambda hands: worse(np.nanmean(hands, axis=0)))

    fingers = np.array([joint not in robot.humanoid.body_joints for joint in sign.joints])
    figures = {
        "place_error_p95_mm": 1000.0 * usual("place_error"),
        "seen_place_error_p95_mm": 1000.0 * usual("seen_place_error"),
        **_contact_figure(takes),
        "major_place_wrong": share("wrong_place", np.nanmax),
        "same_zone_percent": 100.0 * share("same_zone", np.nanmin),
        "same_zone_of_middle_percent": 100.0 * share("same_zone_of_middle", np.nanmin),
        "palm_error_p95_deg": np.degrees(usual("palm_error")),
        "finger_error_p95_deg": np.degrees(usual("finger_error")),
        "flexion_error_p95_deg": np.degrees(usual("flexion_error")),
        "smoothing_mm": 1000.0 * max(take.smoothing for take in takes),
        "lost_percent": 100.0 * max(take.lost for take in takes),
        "knots_error_deg": np.degrees(away[~fingers].max(initial=0.0)),
        "finger_knots_error_deg": np.degrees(away[fingers].max(initial=0.0)),
        "played_error_deg": np.degrees(playback.path_error[~fingers].max(initial=0.0)),
        "finger_played_error_deg": np.degrees(playback.path_error[fingers].max(initial=0.0)),
        "stretch_times": playback.stretch,
        "stroke_s": float(np.mean([take.span.duration for take in takes])),
        "movement_s": float(np.mean([take.span.returns - take.span.leaves for take in takes])),
        "clearance_mm": 1000.0 * playback.clearance,
        "limit_margin_deg": limit_margin_deg(robot.humanoid, sign.joints, sign.knots),
    }
    # Adding zero takes the sign from -0.0.
    return {name: round(float(value), _DECIMALS.get(name, 1)) + 0.0 for name, value in figures.items()}


def _contact_figure(takes: Sequence[SignTake]) -> dict[str, float]:
    """The error of the place as seen while a hand is on the body; nothing of a sign that touches nothing."""
    off = [take.motion.seen_place_error[take.motion.contact > _TOUCHING] for take in takes]
    touching = [errors for errors in off if errors.size]
    if not touching:
        return {}
    return {"contact_error_p95_mm": 1000.0 * float(np.mean([np.percentile(e, _SHARE) for e in touching]))}


def _worst_moments(take: SignTake, slowest: float) -> dict[str, float]:
    """When in a take's recording figures are worst [s].

    Args:
        take: The take.
        slowest: Share of the stroke after which TEO is slowest [1].
    """
    motion = take.motion
    place = np.nan_to_num(motion.seen_place_error)
    frames = {
        "palm_error_p95_deg": np.nan_to_num(motion.palm_error),
        "seen_place_error_p95_mm": place,
        "contact_error_p95_mm": np.where(motion.contact > _TOUCHING, place, 0.0),
        "major_place_wrong": np.where(motion.wrong_place > 0.0, place, 0.0),
    }
    found = {
        name: take.span.start + float(motion.times[errors.max(axis=1).argmax()])
        for name, errors in frames.items()
        if errors.any()
    }
    if take.gaps:
        longest = max(take.gaps, key=lambda gap: gap.end - gap.start)
        found["lost_percent"] = (longest.start + longest.end) / 2.0
    return found | {"stretch_times": take.span.start + slowest * take.span.duration}


# The planner passes knots exactly: every so often [s] it is looked at, and within so much it is at one [rad].
# A joint is no faster than 1 rad/s.
_KNOT_LOOK, _ON_KNOT = 0.002, 0.001
# Instants between two knots at which the played path is looked at: less than half a degree apart.
_BETWEEN = 24
# [s] Five looks at the limits between two points that the drives are sent.
_STEP = 0.004
# [rad], [rad/s]
_LIMIT_ROUNDING = 1e-6


@dataclass(frozen=True, kw_only=True)
class Playback:
    """What the planner makes of a sign, from rest to rest.

    Attributes:
        stretch: Duration of the sign over the recorded one [1].
        path_error: How far the played path is from the motion that was captured, worst frame, of each of the
            sign's joints [rad]. Shape (m,).
        clearance: Smallest distance between parts of the robot [m].
        slowest: Time of the sign at which the plan takes longest for what was recorded [s].
    """

    stretch: float
    path_error: Array
    clearance: float
    slowest: float


def play(robot: Robot, sign: Sign, times: Array, positions: Array) -> Playback:
    """Plan a sign alone and look at every point of the plan.

    Args:
        robot: The robot.
        sign: The sign.
        times: Times of the motion that the sign's knots were chosen from [s]. Shape (n,).
        positions: That motion, for the sign's joints [rad]. Shape (n, m).

    Raises:
        LutError: The planner refuses the sign (with its code), or a point of the plan breaks a limit
            ("outside_limits") or touches ("self_collision").
    """
    try:
        plan = Planner(
            MappingProxyType({sign.gloss: sign}),
            style=SigningStyle(least_size=1.0),  # as large as the entry, to be compared with it
            robot=robot,
            least_standing="sketched",
        ).plan([Token(gloss=sign.gloss, kind=TokenKind[sign.kind.upper()])])
    except PlanError as error:
        raise LutError(error.code, f"{sign.gloss}: it cannot be signed: {error}") from error
    _check_limits(robot, sign.gloss, plan)
    columns = [plan.names.index(joint) for joint in sign.joints]
    waypoints = _waypoint_times(sign, plan, columns)
    paces = np.diff(waypoints) / np.diff(sign.times)
    slowest = int(paces.argmax()) if paces.size else 0  # a posture that is held has one knot
    return Playback(
        stretch=plan.timings[0].stretch,
        path_error=_path_error(robot, sign, plan, waypoints, times, positions),
        clearance=_clearance(robot, sign.gloss, plan),
        slowest=float(sign.times[slowest : slowest + 2].mean()),
    )


def _check_limits(robot: Robot, gloss: str, plan: Plan) -> None:
    """Look at positions and their differences, whatever the planner knows of its pieces."""
    limits = robot.humanoid.limits(plan.names)
    positions = sample_at(plan.motions, np.arange(0.0, plan.duration, _STEP)).positions
    beyond = np.maximum(limits.lower - positions, positions - limits.upper).max(axis=0)
    speed = np.abs(np.diff(positions, axis=0)).max(axis=0) / _STEP
    for what, excess in (("position", beyond), ("velocity", speed - limits.velocity)):
        worst = int(np.argmax(excess))
        if excess[worst] > _LIMIT_ROUNDING:
            raise LutError(
                "outside_limits",
                f"{gloss}: expected {plan.names[worst]} within its {what} limit, got {excess[worst]:.4f} "
                "beyond it: please report this",
            )


def _clearance(robot: Robot, gloss: str, plan: Plan) -> float:
    least, when, parts = np.inf, 0.0, ""
    times = np.arange(0.0, plan.duration, DEFAULT_PERIOD)
    for time, pose in zip(times, sample_at(plan.motions, times).positions, strict=True):
        found = robot.clearance(robot.configuration(dict(zip(plan.names, pose.tolist(), strict=True))))
        if found.distance < least:
            least, when = float(found.distance), float(time)
            parts = f"{found.first} and {found.second}"
    if least < 0.0:
        raise LutError(
            "self_collision",
            f"{gloss}: expected parts of it that keep apart, got {parts} {-1000.0 * least:.0f} mm into "
            f"each other at {when:.2f} s",
        )
    return least


def _path_error(
    robot: Robot, sign: Sign, plan: Plan, waypoints: list[float], times: Array, positions: Array
) -> Array:
    """Distance of every captured frame to the path played between the knots around it [rad]. Shape (m,)."""
    columns = [plan.names.index(joint) for joint in sign.joints]
    worst = np.zeros(len(sign.joints))
    for knot, (begin, end) in enumerate(pairwise(waypoints)):
        between = (times >= sign.times[knot] - 1e-9) & (times <= sign.times[knot + 1] + 1e-9)
        played = sample_at(plan.motions, np.linspace(begin, end, _BETWEEN)).positions[:, columns]
        away = np.abs(positions[between][:, None] - played)
        # What is near is told by arms rather than by fingers, which may be farther off.
        nearest = (away / tube_radii(robot.humanoid, sign.joints)).max(axis=2).argmin(axis=1)
        worst = np.maximum(worst, away[np.arange(len(away)), nearest].max(axis=0, initial=0.0))
    return worst


def _waypoint_times(sign: Sign, plan: Plan, columns: list[int]) -> list[float]:
    """When the plan passes each knot [s], in order."""
    timing = plan.timings[0]
    looks = 2 + int(timing.duration / _KNOT_LOOK)
    times = timing.start + np.linspace(0.0, timing.duration, looks)
    passed = sample_at(tuple(plan.motions[column] for column in columns), times).positions
    index, found = 0, []
    for knot in sign.knots:
        on = np.abs(passed[index:] - knot).max(axis=1) <= _ON_KNOT
        index += int(np.argmax(on)) if on.any() else 0
        found.append(float(times[index]))
    return found
