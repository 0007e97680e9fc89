# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs captured from clips of one camera without depth: a signer's letters, and performed written signs.

Written signs are performed with exact keypoints and laid into a picture with a detector's noise
(`signs.performed`). Then they are lifted, cut and brought onto TEO as a clip of a person is.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping
from importlib import resources
from pathlib import Path
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]  # ships no types

from report import Figure
from signs.performed import GUESTS, VISITORS, Draw, performed, pictured
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letter_clips import load_letter_clips
from teo_sign_capture.entries.bag_capture import CaptureJob, Settings, capture_bags
from teo_sign_capture.entries.gates import objections
from teo_sign_capture.entries.sign_entry import Origin, make_sign
from teo_sign_capture.entries.take import capture_take
from teo_sign_capture.recordings.recording import lifted_track
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.errors import LutError

_QUALITY = (
    ("place_error_p95_mm", "mm"),
    ("contact_error_p95_mm", "mm"),
    ("palm_error_p95_deg", "deg"),
    ("finger_error_p95_deg", "deg"),
    ("same_zone_percent", "% of the stroke"),
)


class _Clip(NamedTuple):
    """What became of a clip."""

    gloss: str
    refused: list[str]
    """Codes of what speaks against it."""
    quality: Mapping[str, float]
    """Figures of its entry; empty where none can be made."""
    seconds: float
    """From points to entry [s]."""


def measure(clips: int = 30) -> list[Figure]:
    """What became of clips of letters and of performed signs, at most so many of each."""
    robot = Robot.load()
    with threadpool_limits(1):
        return [
            *_figures("letters of a signer", _letters(robot, clips)),
            *_figures("signs by new people (apart)", _performed(robot, VISITORS, clips)),
            *_figures("signs by other new people", _performed(robot, GUESTS, clips)),
        ]


def _figures(what: str, clips: Iterable[_Clip]) -> list[Figure]:
    found = list(clips)
    refused = [f"{clip.gloss} {' '.join(clip.refused)}" for clip in found if clip.refused]
    seconds = [clip.seconds for clip in found]
    past = f"{len(found) - len(refused)} of {len(found)}; not: {', '.join(refused) or 'none'}"
    figures = [
        Figure(f"{what}: past all gates", past),
        Figure(f"{what}: to an entry", f"median {np.median(seconds):.1f} s, longest {max(seconds):.1f} s"),
    ]
    for name, unit in _QUALITY:
        values = [clip.quality[name] for clip in found if name in clip.quality]
        value = f"median {np.median(values):.0f}, mean {np.mean(values):.0f} {unit}"
        figures.append(Figure(f"{what}: {name}", value))
    return figures


def _performed(robot: Robot, draw: Draw, most: int) -> Iterator[_Clip]:
    for one in performed(draw._replace(signs=min(draw.signs, most))):
        clip = pictured(one.track, distance=draw.distance, seed=draw.seed)
        origin = Origin(source=one.score.gloss, standing="recorded", licence="Apache-2.0")
        begins = time.perf_counter()
        quality: Mapping[str, float] = {}
        try:
            take = capture_take(robot, lifted_track(clip))
            made = make_sign(robot, one.score.gloss, [take], origin, accept=True)
            quality, refused = made.sign.quality, [verdict.code for verdict in objections(made.verdicts)]
        except LutError as error:
            refused = [error.code]
        yield _Clip(one.score.gloss, refused, quality, time.perf_counter() - begins)


def _letters(robot: Robot, most: int) -> Iterator[_Clip]:
    clips = Path(str(resources.files("spoken_to_signed"))) / "assets" / "fingerspelling_lexicon" / "ssp"
    with tempfile.TemporaryDirectory() as folder:
        # What is beyond a gate is accepted as far as it can be, so that its figures count.
        settings = Settings(
            table=Path(folder) / "letters", cache=Path(folder) / "cache", kind="letter", accept=True
        )
        letters = load_letter_clips(load_language(DEFAULT_LANGUAGE))
        for letter, clip in list(letters.items())[:most]:
            begins = time.perf_counter()
            quality: Mapping[str, float] = {}
            try:
                job = CaptureJob(gloss=letter, bags=(clips / clip.file,))
                captured = capture_bags(robot, job, settings).captured
                quality = captured.sign.quality
                refused = [verdict.code for verdict in objections(captured.verdicts)]
            except LutError as error:
                refused = [error.code]
            yield _Clip(letter, refused, quality, time.perf_counter() - begins)
