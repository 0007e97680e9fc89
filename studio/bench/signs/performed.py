# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The synthetic signer's performances with exact keypoints, and how one camera without depth sees them.

No image is rendered: a frame takes 8 ms. A camera's picture has the noise of a good detector.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.notation.performance import performance
from teo_sign_authoring.notation.score_file import default_scores_directory, read_scores
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_capture.tracks.skeleton_track import HIP, SHOULDER, Keypoints, SkeletonTrack, in_body_axes
from teo_skeleton_retriever.lifting.clip import Points, PoseClip
from teo_synthetic_signer.body.body_shapes import BODIES, random_people
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.script.keys import Key
from teo_synthetic_signer.script.motion import Motion
from teo_synthetic_signer.script.script_file import read_script
from teo_synthetic_signer.script.scripts import script as script_named

RATE = 25.0  # [Hz] of performances and of their pictures
_PIXELS, _NOISE = 550.0, 1.5  # of a metre; deviation of a point [pixel], as MediaPipe's across the view
_DEPTH_NOISE, _DEPTH_SHARE = 0.006, 0.8  # of guessed depths in a hand: [m], and what is left of the true ones
# Of depths of a body as MediaPipe imagines them, by 42 takes of people who stood turned: what it makes of a
# true metre, and how far off an arm [m] is for a second and a shoulder for a take.
_IMAGINED, _ARM_OFF, _SHOULDER_OFF = 2.6, 0.07, 0.025
# [m] Shoulders are seen so far above their joints, hips below: by MediaPipe in rendered people.
_OFF_JOINTS = 0.015


class Draw(NamedTuple):
    """Scores drawn at random, those of earlier draws left out; who performs them, and the camera.

    Attributes:
        seed: Of the draw.
        signs: How many.
        bodies: Who performs them, in turn.
        distance: Of the camera [m].
        earlier: Seed and signs of the draws before, each without those before it.
    """

    seed: int
    signs: int
    bodies: tuple[str, ...]
    distance: float
    earlier: tuple[tuple[int, int], ...] = ()


# What was looked at while capture was built, and on what the depths of `lifting.clip` were chosen.
EARLIER = ((11, 30), (4711, 18), (80_221, 18), (33_871, 18))
BODIES |= random_people(3, 70_117, "guest")
BODIES |= random_people(3, 84_131, "visitor")
# Looked at several times; nothing was chosen on them.
GUESTS = Draw(61_553, 18, ("guest_0", "guest_1", "guest_2"), 1.9, EARLIER)
# Looked at once. Who changes something draws another.
VISITORS = Draw(97_003, 24, ("visitor_0", "visitor_1", "visitor_2"), 2.1, (*EARLIER, (61_553, 18)))


class Performed(NamedTuple):
    """A performance with its exact keypoints."""

    score: Score
    body: str
    track: SkeletonTrack


def performed(draw: Draw) -> Iterator[Performed]:
    """Performances of a draw that a body can make; what none can is printed and left out."""
    signers = {body: Signer(body) for body in draw.bodies}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "score.yaml"
        for number, score in enumerate(_drawn(draw)):
            body = draw.bodies[number % len(draw.bodies)]
            file.write_text(performance(score).text, "utf-8")
            try:
                track = _keys_track(signers[body], read_script(file).keys, RATE, source=score.gloss)
            except SyntheticError as error:
                print(f"left out: {score.gloss} by {body}: {error}")
                continue
            yield Performed(score, body, track)


def _drawn(draw: Draw) -> list[Score]:
    scores = [score for score in read_scores(default_scores_directory()) if score.kind == "lexical"]
    taken: set[str] = set()
    for seed, signs in (*draw.earlier, (draw.seed, draw.signs)):
        order = np.random.default_rng(seed).permutation(len(scores)).tolist()
        found = [scores[index] for index in order if scores[index].gloss not in taken][:signs]
        taken |= {score.gloss for score in found}
    return found


def script_track(script: str, body: str, rate: float = RATE) -> SkeletonTrack:
    """A script played by a person.

    Args:
        script: One of `SCRIPTS`.
        body: One of `BODIES`.
        rate: Frames per second [Hz].
    """
    return _keys_track(Signer(body), script_named(script), rate, source=f"{script} by {body}")


def _keys_track(signer: Signer, keys: Sequence[Key], rate: float, *, source: str) -> SkeletonTrack:
    motion = Motion(signer.poser, keys)
    times = np.arange(0.0, motion.duration, 1.0 / rate)
    frames = []
    for time in times.tolist():
        pose = motion.pose(time)
        frames.append(signer.keypoints(pose, signer.poser.transforms(pose)))
    body, left_hand, right_hand, face = (_known(np.array(part)) for part in zip(*frames, strict=True))
    return in_body_axes(
        times=times,
        body=body,
        left_hand=left_hand,
        right_hand=right_hand,
        face=face,
        source=source,
        recorded=None,
        up=(0.0, 0.0, 1.0),
    )


def _known(positions: Array) -> Keypoints:
    count = positions.shape[:2]
    return Keypoints(
        positions=positions,
        sigma=np.zeros(count),
        confidence=np.ones(count),
        status=np.ones(count, np.uint8),
    )


def pictured(
    track: SkeletonTrack,
    *,
    distance: float = math.inf,
    depth: bool = True,
    seed: int = 0,
    turn: float = 0.0,
    imagined: bool = False,
) -> PoseClip:
    """A person as one camera without depth sees them.

    Args:
        track: Exact keypoints, `RATE` times a second.
        distance: Of the camera [m]; infinite shows everything at one scale.
        depth: Whether depths within the hands are guessed, as MediaPipe does.
        seed: Of the noise.
        turn: How far the person stands turned to their own right [rad].
        imagined: Whether depths of the body are, as MediaPipe does.
    """
    random = np.random.default_rng(seed)
    cosine, sine = math.cos(turn), math.sin(turn)
    turned = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])

    seen = track.body.positions.copy()
    seen[:, list(SHOULDER.values()), 2] += _OFF_JOINTS
    seen[:, list(HIP.values()), 2] -= _OFF_JOINTS

    def part(standing: Array, *, guessed: bool) -> Points:
        true = standing @ turned
        size = _PIXELS / (1.0 - true[..., 0] / distance)
        places = true * size[..., None] + random.normal(0.0, _NOISE, true.shape)
        along = (true - true[:, :1])[..., 0]
        guess = _DEPTH_SHARE * along + random.normal(0.0, _DEPTH_NOISE, along.shape)
        places[..., 0] = guess if guessed else np.nan
        return Points(places=places, confidence=np.ones(true.shape[:2]))

    body = part(seen, guessed=False)
    if imagined:
        depths, seconds = (track.body.positions @ turned)[..., 0], int(len(track.times) / RATE) + 1
        off = random.normal(0.0, _ARM_OFF, (seconds, depths.shape[1])).repeat(int(RATE), axis=0)[
            : len(depths)
        ]
        off[:, list(SHOULDER.values())] = random.normal(0.0, _SHOULDER_OFF, 2)
        body.places[..., 0] = _IMAGINED * _PIXELS * (depths + off)
    return PoseClip(
        rate=RATE,
        body=body,
        left_hand=part(track.left_hand.positions, guessed=depth),
        right_hand=part(track.right_hand.positions, guessed=depth),
        source=track.source,
    )
