# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From takes to a sign of the table, with what is to be said of it."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_capture.entries.gates import Verdict, accepted_standing, judge, objections
from teo_sign_capture.entries.playback import Playback, play
from teo_sign_capture.entries.take import SignTake
from teo_sign_capture.entries.take_combination import Combined, combine
from teo_sign_capture.retarget.knots import (
    TOLERANCE,
    deviations,
    limit_margin_deg,
    reduce_to_knots,
    smoothest_motion,
)
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_schema import Kind, Provenance, Standing

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
    kind: Kind = "lexical",
    accept: bool = False,
) -> Captured:
    """Make an entry of takes of one sign.

    Args:
        robot: The robot.
        gloss: Name of the sign.
        takes: At least one.
        origin: For the provenance.
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
        language=DEFAULT_LANGUAGE,
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
    verdicts = judge(quality, duration=sign.duration, has_rest=has_rest)
    standing = accepted_standing(sign.gloss, origin.standing, verdicts, accept=accept)
    provenance = _accepted(sign.provenance, standing, objections(verdicts))
    sign = replace(sign, quality=quality, provenance=provenance)
    return Captured(sign=sign, takes=tuple(takes), combined=combined, verdicts=verdicts)


def _accepted(provenance: Provenance, standing: Standing, against: Sequence[Verdict]) -> Provenance:
    """The provenance of a sign that was taken though something speaks against it."""
    reasons = "; ".join(objection.message for objection in against)
    though = f"Accepted by a person beyond a gate: {reasons}." if reasons else ""
    notes = " ".join(filter(None, (though, provenance.notes)))
    return provenance.model_copy(update={"standing": standing, "notes": notes})


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
    away = float(np.nanmax(take.motion.place_error))
    notes = (
        combined.reason if len(takes) > 1 else "",
        f"Lost and filled in: {filled}." if filled else "",
        f"A hand is up to {100.0 * away:.0f} cm from where it belongs." if away > _SAID_OUT_OF_REACH else "",
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


def _quality(
    robot: Robot, takes: Sequence[SignTake], sign: Sign, playback: Playback, away: Array
) -> dict[str, float]:
    def usual(errors: str) -> float:
        """The worse hand's error that 95 of 100 frames keep below, mean of the takes."""
        found = [getattr(take.motion, errors) for take in takes]
        hands = [array[:, np.isfinite(array).any(axis=0)] for array in found]
        return float(np.mean([np.nanpercentile(array, _SHARE, axis=0).max() for array in hands]))

    def on_average(field: str, worse: Callable[[Array], float]) -> float:
        """Share of the stroke's frames, mean of the takes, of the worse hand."""
        found = [getattr(take.motion, field) for take in takes]
        hands = [array[:, np.isfinite(array).any(axis=0)] for array in found]
        return float(np.mean([worse(np.nanmean(array, axis=0)) for array in hands]))

    fingers = np.array([joint not in robot.humanoid.body_joints for joint in sign.joints])
    figures = {
        "place_error_p95_mm": 1000.0 * usual("place_error"),
        **_contact_figure(takes),
        "major_place_wrong": on_average("wrong_place", np.nanmax),
        "same_zone_percent": 100.0 * on_average("same_zone", np.nanmin),
        "same_zone_of_middle_percent": 100.0 * on_average("same_zone_of_middle", np.nanmin),
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
    """The error of the place where a hand is on the body; nothing of a sign that touches nothing."""
    off = [take.motion.place_error[take.motion.contact > _TOUCHING] for take in takes]
    touching = [errors for errors in off if errors.size]
    if not touching:
        return {}
    return {"contact_error_p95_mm": 1000.0 * float(np.mean([np.percentile(e, _SHARE) for e in touching]))}
