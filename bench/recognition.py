# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sign of the table a demonstration is: performed scores, of signs and by bodies not tuned on.

The synthetic signer performs scores with exact keypoints (no camera), the stroke is cut out as in a capture,
and is sought among all words and numbers of the table. Signs are drawn by a fixed seed. The unit of bends was
chosen on the first 50 by `woman_average`; the held-out row is other signs by other bodies, once with exact
keypoints and once laid into a picture with a detector's noise and lifted, as films are. Leave-one-out is
of takes: each take of a sign is sought among the takes of all signs by the other bodies, the table put aside.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from report import Figure, percentiles, share
from rich.progress import track as progress
from signs.pictured import pictured
from signs.signer_tracks import keys_track

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_capture.lifting.clip import lift_clip
from teo_sign_capture.notation.performance import performance
from teo_sign_capture.notation.score_file import default_scores_directory, read_scores
from teo_sign_capture.notation.score_schema import Score
from teo_sign_capture.recognition.appearance import recording_appearance, sign_appearance
from teo_sign_capture.recognition.sign_index import Match, SignIndex
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_signs.errors import LutError
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.script.script_file import read_script

_RATE = 15.0  # [Hz] of the frames
_CAMERA = 2.0  # [m] from the person
_SEED = 1
TUNED_ON = 50  # signs, by _TUNED_BY
_TUNED_BY = "woman_average"
_HELD_OUT_BY = ("man_tall", "woman_small")
_HELD_OUT = 15  # signs, each by every one of those bodies
_THOUSAND = 1000


@dataclass(frozen=True, kw_only=True)
class Take:
    """A performed sign: gloss, performer, what is shown, and that lifted from a picture (None: not cut)."""

    gloss: str
    body: str
    shown: Array
    lifted: Array | None


def measure() -> list[Figure]:
    """Right answers, confusion pairs and time."""
    robot = Robot.load()
    signs = {g: s for g, s in Lut.open(default_lut_directory()).items() if s.kind != "letter"}
    drawn = _drawn(signs)
    index = SignIndex.of_signs(robot, signs.values())
    figures = []
    held_out = drawn[TUNED_ON : TUNED_ON + _HELD_OUT]
    unseen = [take for body in _HELD_OUT_BY for take in performed(robot, held_out, body)]
    tuned = performed(robot, drawn[:TUNED_ON], _TUNED_BY)
    for name, takes in (("held out, other signs and bodies", unseen), ("tuned on", tuned)):
        figures += _rights(robot, signs, name, takes, [index.nearest(take.shown) for take in takes])
    lifted = [take for take in unseen if take.lifted is not None]
    found = [index.nearest(take.lifted) for take in lifted if take.lifted is not None]
    figures += _rights(robot, signs, "held out, lifted from a picture", lifted, found)
    figures.append(_leave_one_out(unseen))
    figures.append(_time(robot, list(signs.values()), unseen))
    return figures


def performed(robot: Robot, scores: Sequence[Score], body: str) -> list[Take]:
    """What a body shows of each score; those that it cannot perform, or that are not cut as one, left out."""
    signer, takes = Signer(body), []
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "score.yaml"
        for score in progress(scores, description=f"performing by {body}", transient=True):
            file.write_text(performance(score).text, "utf-8")
            try:
                keys = read_script(file).keys
                track = keys_track(signer, keys, _RATE, source=score.gloss)
                shown = recording_appearance(robot, track)
            except (LutError, SyntheticError) as error:
                print(f"left out: {score.gloss} by {body}: {error}")
                continue
            lifted = _lifted_appearance(robot, track)
            takes.append(Take(gloss=score.gloss, body=body, shown=shown, lifted=lifted))
    return takes


def _lifted_appearance(robot: Robot, track: SkeletonTrack) -> Array | None:
    """What a performance shows once it was in a picture; None where it is not cut as one sign."""
    clip = pictured(track, distance=_CAMERA, rate=_RATE)
    try:
        return recording_appearance(robot, lift_clip(clip))
    except LutError as error:
        print(f"left out: {track.source}, lifted: {error}")
        return None


def _drawn(signs: dict[str, Sign]) -> list[Score]:
    scores = list(read_scores(default_scores_directory()))
    order = np.random.default_rng(_SEED).permutation(len(scores))
    return [scores[index] for index in order if scores[index].gloss in signs]


def _rights(
    robot: Robot,
    signs: dict[str, Sign],
    name: str,
    takes: Sequence[Take],
    found: Sequence[tuple[Match, ...]],
) -> list[Figure]:
    first = five = 0
    confused: list[str] = []
    for take, matches in zip(takes, found, strict=True):
        # Two names of one form are one answer.
        same = {take.gloss} | {
            match.gloss
            for match in matches
            if match.gloss != take.gloss and not nearest_pairs(robot, [signs[take.gloss], signs[match.gloss]])
        }
        first += matches[0].gloss in same
        five += any(match.gloss in same for match in matches)
        if matches[0].gloss not in same:
            confused.append(f"{take.gloss} for {matches[0].gloss}")
    return [
        Figure(f"recognised first of {len(signs)}, {name} ({len(takes)} takes)", share(first, len(takes))),
        Figure(f"among the first five, {name}", share(five, len(takes))),
        Figure(f"confused, {name}", ", ".join(sorted(set(confused))) or "none"),
    ]


def _leave_one_out(takes: Sequence[Take]) -> Figure:
    right = 0
    for take in takes:
        others = [other for other in takes if other.body != take.body]
        index = SignIndex([other.gloss for other in others], np.array([other.shown for other in others]))
        right += index.nearest(take.shown, 1)[0].gloss == take.gloss
    return Figure(f"a take among the other bodies' takes ({len(takes)})", share(right, len(takes)))


def _time(robot: Robot, signs: Sequence[Sign], takes: Sequence[Take]) -> Figure:
    """A table of 1,000: the table's signs, and as many more by a little noise; time of the processor."""
    shown = np.array([sign_appearance(robot, sign) for sign in signs])
    noise = np.random.default_rng(_SEED).normal(0.0, 0.3, (_THOUSAND - len(shown), *shown.shape[1:]))
    every = np.concatenate([shown, shown[np.arange(len(noise)) % len(shown)] + noise])
    index = SignIndex(map(str, range(len(every))), every)
    seconds = []
    for take in takes:
        start = time.process_time()
        index.nearest(take.shown)
        seconds.append(time.process_time() - start)
    return percentiles(f"five nearest of a table of {len(every)}, processor time", seconds)


if __name__ == "__main__":
    for figure in measure():
        print(f"{figure.what}: {figure.value}")
