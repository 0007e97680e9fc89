# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Written signs performed, seen by one camera without depth, and captured: clips of which the truth is known.

The synthetic signer performs scores with exact keypoints; these are laid into a picture with a detector's
noise, lifted, cut and brought onto TEO as a clip of a person is. Every score is performed twice: as it is
written, coming to a stop in its first and last posture, and swung through them, as fluent signers do.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import yaml

from accuracy.people import random_people
from report import Figure
from signs.pictured import pictured
from signs.signer_tracks import keys_track
from teo_description.robot import Robot
from teo_sign_authoring.notation.performance import REST, WAY, performance
from teo_sign_authoring.notation.score_file import default_scores_directory, read_scores
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_capture.entries.gates import objections
from teo_sign_capture.entries.sign_entry import Origin, make_sign
from teo_sign_capture.entries.take import capture_take
from teo_sign_capture.recordings.recording import lifted_track
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_signs.errors import LutError
from teo_synthetic_signer.body.body_shapes import BODIES
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.script.script_file import read_script

BODIES |= random_people(3, 19_447, "pupil")
BODIES |= random_people(3, 52_301, "teacher")
BODIES |= random_people(3, 70_117, "guest")
BODIES |= random_people(3, 84_131, "visitor")

_RATE = 25.0  # [Hz]
_QUALITY = (
    ("place_error_p95_mm", "mm"),
    ("contact_error_p95_mm", "mm"),
    ("palm_error_p95_deg", "deg"),
    ("finger_error_p95_deg", "deg"),
    ("same_zone_percent", "% of the stroke"),
    ("same_zone_of_middle_percent", "% of the stroke"),
)


class Draw(NamedTuple):
    """Scores drawn by a seed, those of other draws left out; who performs them, and the camera [m]."""

    seed: int
    signs: int
    bodies: tuple[str, ...]
    distance: float
    without: tuple[Draw, ...] = ()


# Looked at while the capture was built.
KNOWN = Draw(seed=11, signs=30, bodies=("woman_average", "man_average"), distance=2.0)
# Drawn when the capture was finished, and looked at since: other signs, bodies and camera.
KNOWN_SINCE = Draw(
    seed=4711, signs=18, bodies=("woman_small", "man_heavy", "woman_old"), distance=1.6, without=(KNOWN,)
)
# Other signs and people again, looked at since.
KNOWN_LAST = Draw(
    seed=80_221,
    signs=18,
    bodies=("pupil_0", "pupil_1", "pupil_2"),
    distance=1.8,
    without=(KNOWN, KNOWN_SINCE),
)
# On these it was chosen how often depths are found anew (`lifting.lifted_person`).
KNOWN_DEPTHS = Draw(
    seed=33_871,
    signs=18,
    bodies=("teacher_0", "teacher_1", "teacher_2"),
    distance=2.2,
    without=(KNOWN, KNOWN_SINCE, KNOWN_LAST),
)
# Other signs and people again, looked at since; nothing was chosen on them.
KNOWN_GUESTS = Draw(
    seed=61_553,
    signs=18,
    bodies=("guest_0", "guest_1", "guest_2"),
    distance=1.9,
    without=(KNOWN, KNOWN_SINCE, KNOWN_LAST, KNOWN_DEPTHS),
)
# Looked at once, lifted once and twice: other signs and people. Who changes something draws another.
NEW = Draw(
    seed=97_003,
    signs=24,
    bodies=("visitor_0", "visitor_1", "visitor_2"),
    distance=2.1,
    without=(KNOWN, KNOWN_SINCE, KNOWN_LAST, KNOWN_DEPTHS, KNOWN_GUESTS),
)
DRAWS = {
    "known": KNOWN,
    "known since": KNOWN_SINCE,
    "known last": KNOWN_LAST,
    "known, depths chosen on them": KNOWN_DEPTHS,
    "known, nothing chosen on them": KNOWN_GUESTS,
    "new": NEW,
}


class Performed(NamedTuple):
    """A performance: exact keypoints, and when the first posture is reached and the last one left [s]."""

    score: Score
    body: str
    track: SkeletonTrack
    start: float
    end: float


@dataclass(frozen=True, kw_only=True)
class Clip:
    """What became of a performance.

    Attributes:
        gloss: The sign.
        body: Who performed it.
        refused: Codes of what speaks against it; empty if it is taken.
        quality: Figures of the entry; empty where none can be made.
        kept: Share of the sign that was cut out; NaN where nothing was.
        more: What was cut out besides [s].
        seconds: From points to entry [s].
    """

    gloss: str
    body: str
    refused: tuple[str, ...]
    quality: dict[str, float]
    kept: float
    more: float
    seconds: float


def measure(robot: Robot, name: str, draw: Draw) -> list[Figure]:
    """Figures of a draw, stopped and swung.

    Args:
        robot: The robot.
        name: What the figures call the draw.
        draw: Which scores, by whom.
    """
    stopped = [captured(robot, one, draw) for one in performed(draw)]
    swung = [captured(robot, one, draw) for one in performed(draw, swung=True)]
    what = f"{name}: {len(stopped)} written signs performed and lifted"
    refused = [f"{clip.gloss} {' '.join(clip.refused)}" for clip in stopped if clip.refused]
    taken = len(stopped) - len(refused)
    figures = [Figure(f"{what}: past all gates", f"{taken} of {len(stopped)}; not: {', '.join(refused)}")]
    for figure, unit in _QUALITY:
        values = [clip.quality[figure] for clip in stopped if figure in clip.quality]
        figures.append(
            Figure(f"{what}: {figure}", f"median {np.median(values):.0f}, mean {np.mean(values):.0f} {unit}")
        )
    for way, clips in (("stopping at both ends", stopped), ("swung through both ends", swung)):
        kept, more = (np.array([getattr(clip, part) for clip in clips]) for part in ("kept", "more"))
        figures.append(
            Figure(
                f"{name}: share of the stroke that is cut out, {way}",
                f"median {np.nanmedian(kept):.0%}, 9 of 10 above {np.nanpercentile(kept, 10):.0%}, least "
                f"{np.nanmin(kept):.0%}; besides, 9 of 10 below {np.nanpercentile(more, 90):.2f} s",
            )
        )
    seconds = [clip.seconds for clip in stopped]
    return [
        *figures,
        Figure(
            f"{what}: points to entry", f"median {np.median(seconds):.1f} s, longest {max(seconds):.1f} s"
        ),
    ]


def performed(draw: Draw, *, swung: bool = False) -> Iterator[Performed]:
    """Performances of a draw that a body can make; swung ones without held postures and arcs."""
    signers = {body: Signer(body) for body in draw.bodies}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "score.yaml"
        for number, score in enumerate(_drawn(draw)):
            script = yaml.safe_load(performance(score).text)
            keys = script["keys"][1:-1]  # without the hands that hang
            if swung:
                if len(keys) == 1 or any("bulge" in key for key in (keys[0], keys[-1])):
                    continue  # a posture that is held, or an arc, which a script lets end only at a stop
                for key in (keys[0], keys[-1]):
                    key.pop("hold", None)
                    key["through"] = True
            body = draw.bodies[number % len(draw.bodies)]
            file.write_text(yaml.safe_dump(script, allow_unicode=True), "utf-8")
            try:
                track = keys_track(signers[body], read_script(file).keys, _RATE, source=score.gloss)
            except SyntheticError as error:
                print(f"left out: {score.gloss} by {body}: {error}")
                continue
            start = REST + WAY
            held = keys[0].get("hold", 0.0)
            moved = sum(key["move"] + key.get("hold", 0.0) for key in keys[1:])
            yield Performed(score, body, track, start, start + held + moved)


def captured(robot: Robot, one: Performed, draw: Draw) -> Clip:
    """Capture one performance as it stands in a picture."""
    clip = pictured(one.track, distance=draw.distance, rate=_RATE, seed=draw.seed)
    origin = Origin(source=one.score.gloss, standing="recorded", licence="Apache-2.0")
    begins, kept, more = time.perf_counter(), np.nan, np.nan
    quality: dict[str, float] = {}
    try:
        take = capture_take(robot, lifted_track(clip))
        common = min(one.end, take.span.end) - max(one.start, take.span.start)
        kept, more = max(common, 0.0) / (one.end - one.start), take.span.duration - common
        made = make_sign(robot, one.score.gloss, [take], origin, accept=True)
        quality, refused = dict(made.sign.quality), [verdict.code for verdict in objections(made.verdicts)]
    except LutError as error:
        refused = [error.code]
    return Clip(
        gloss=one.score.gloss,
        body=one.body,
        refused=tuple(refused),
        quality=quality,
        kept=kept,
        more=more,
        seconds=time.perf_counter() - begins,
    )


def _drawn(draw: Draw) -> Sequence[Score]:
    other = {score.gloss for earlier in draw.without for score in _drawn(earlier)}
    scores = [score for score in read_scores(default_scores_directory()) if score.kind == "lexical"]
    order = np.random.default_rng(draw.seed).permutation(len(scores)).tolist()
    return [scores[index] for index in order if scores[index].gloss not in other][: draw.signs]
