# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs captured from films: the same takes in colour alone and with depth, and the letters' clips as if new.

The synthetic signer performs scores before a D435. Its colour images, as a film, go the way of a phone's;
the whole recording goes the way of a depth camera's. Both are compared with the true keypoints. Besides,
written signs performed without a camera (`signs/score_clips.py`), those looked at while capture was built and
others.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterable, Sequence
from importlib import resources
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]  # ships no types

from report import Figure
from signs import score_clips
from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letter_clips import load_letter_clips
from teo_sign_authoring.notation.performance import performance
from teo_sign_authoring.notation.score_file import default_scores_directory, read_score
from teo_sign_capture.entries.bag_capture import CaptureJob, Saved, Settings, capture_bags
from teo_sign_capture.recordings.recording import open_recording, track_of
from teo_sign_capture.tracks.skeleton_track import WRIST, SkeletonTrack
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.errors import LutError
from teo_signs.sign_schema import Standing
from teo_synthetic_signer import Take, TakeOptions
from teo_synthetic_signer.take.take_files import write_film, write_take

GLOSSES = ("BIEN", "CASA", "POCO")
_RATE = 15.0  # [Hz]
# What is beyond a gate is accepted, so that its figures count, and becomes one level less well founded.
_STANDING: Standing = "recorded"
_RAISED = -0.36  # [m] below the shoulders: lower wrists hang


def measure() -> list[Figure]:
    """Film and depth against the truth, and what became of clips of letters and of performed scores."""
    robot = Robot.load()
    with tempfile.TemporaryDirectory() as folder, threadpool_limits(1):
        return [
            *_performed(robot, Path(folder)),
            *_letters(robot, Path(folder)),
            *(f for name, draw in score_clips.DRAWS.items() for f in score_clips.measure(robot, name, draw)),
        ]


def _performed(robot: Robot, folder: Path) -> list[Figure]:
    away: dict[str, list[Array]] = {"colour only": [], "with depth": []}
    saved: list[Saved] = []
    lasted: list[float] = []
    for gloss in GLOSSES:
        script = folder / f"{gloss}.yaml"
        script.write_text(performance(read_score(default_scores_directory() / script.name)).text, "utf-8")
        take = Take(TakeOptions(script=str(script), body="man_average", distance=1.8, rate=_RATE))
        film, bag = folder / f"{gloss}.mp4", folder / gloss
        frames = [take.frame(index) for index in range(len(take))]
        _run(write_film(frames, film))
        _run(write_take(iter(frames), bag))
        settings = Settings(table=folder / "lut", cache=folder / "cache", accept=True, standing=_STANDING)
        begins = time.monotonic()
        saved += _captured(robot, CaptureJob(gloss=gloss, bags=(film,)), settings)
        lasted.append(time.monotonic() - begins)
        truth, _ = track_of(open_recording(bag), cache=folder / "cache", topic="/truth/skeletons")
        seen, _ = track_of(open_recording(bag), cache=folder / "cache")
        lifted = track_of(open_recording(film), cache=folder / "cache")[0]
        away["colour only"].append(_wrists(truth, lifted))
        away["with depth"].append(_wrists(truth, seen))
    return [
        *(
            Figure(
                f"wrists of {len(GLOSSES)} performed signs, {way}: median (9 of 10 below)",
                f"{1000.0 * np.median(errors):.0f} ({1000.0 * np.percentile(errors, 90.0):.0f}) mm",
            )
            for way, errors in ((way, np.concatenate(found)) for way, found in away.items())
        ),
        *_quality("films of performed signs", saved, len(GLOSSES), lasted),
    ]


def _letters(robot: Robot, folder: Path) -> list[Figure]:
    clips = Path(str(resources.files("spoken_to_signed"))) / "assets" / "fingerspelling_lexicon" / "ssp"
    saved: list[Saved] = []
    lasted: list[float] = []
    letters = load_letter_clips(load_language(DEFAULT_LANGUAGE))
    for letter, clip in letters.items():
        settings = Settings(
            table=folder / "letters",
            cache=folder / "cache",
            kind="letter",
            accept=True,
            standing=_STANDING,
        )
        begins = time.monotonic()
        saved += _captured(robot, CaptureJob(gloss=letter, bags=(clips / clip.file,)), settings)
        lasted.append(time.monotonic() - begins)
    return _quality("clips of letters", saved, len(letters), lasted)


def _captured(robot: Robot, job: CaptureJob, settings: Settings) -> list[Saved]:
    try:
        return [capture_bags(robot, job, settings)]
    except LutError:
        return []


def _quality(what: str, saved: Sequence[Saved], count: int, lasted: Sequence[float]) -> list[Figure]:
    past = sum(one.captured.sign.provenance.standing == _STANDING for one in saved)
    figures = [Figure(f"{what}: captured", f"{len(saved)} of {count}, {past} of them past all gates")]
    for name, unit in (
        ("place_error_p95_mm", "mm"),
        ("palm_error_p95_deg", "deg"),
        ("same_zone_percent", "% of the stroke"),
        ("major_place_wrong", "of the stroke"),
    ):
        values = [one.captured.sign.quality[name] for one in saved]
        figures.append(Figure(f"{what}: {name}, median", f"{np.median(values):.2f} {unit}"))
    seconds = f"median {np.median(lasted):.1f} s, longest {max(lasted):.1f} s"
    return [*figures, Figure(f"{what}: time of a clip", seconds)]


def _wrists(truth: SkeletonTrack, found: SkeletonTrack) -> Array:
    """Distances of raised wrists from where they are, at the nearest image of the truth [m]."""
    rows = np.abs(truth.times[:, None] - found.times).argmin(axis=0)
    errors = []
    for wrist in WRIST.values():
        true = truth.body.positions[rows, wrist]
        away = np.linalg.norm(found.body.positions[:, wrist] - true, axis=1)
        errors.append(away[(true[:, 2] > _RAISED) & np.isfinite(away)])
    return np.concatenate(errors)


def _run(written: Iterable[int]) -> None:
    for _ in written:
        pass


if __name__ == "__main__":
    for figure in measure():
        print(f"{figure.what}: {figure.value}")
