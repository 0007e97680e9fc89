# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Rendered people who sign: what a detector sees of them, beside where they are.

Each goes where a score of the lexicon goes, with other handshapes, so that all shapes are seen at all places
and from all sides.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from teo_common.arrays import Array
from teo_common.atomic_files import write_atomically
from teo_sign_authoring.notation.performance import REST, performance, person_shape
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_capture.recordings.keypoint_search import POINTS, person_points
from teo_sign_capture.recordings.pose_file import pose_file, read_pose_file
from teo_sign_capture.retarget.handshapes import NAMES
from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.lifting.clip import PoseClip
from teo_synthetic_signer.body.body_shapes import BODIES, random_people
from teo_synthetic_signer.body.hand import FINGERS, THUMBS
from teo_synthetic_signer.camera.renderer import LIGHTS
from teo_synthetic_signer.take.take import Take, TakeOptions

# [Hz] Frames that are nearer in time show the same again.
_RATE = 6.0
_WIDTH, _HEIGHT = 640, 480
# [m] As far as phones and webcams stand, and as high.
_DISTANCES, _HEIGHTS = (1.15, 2.1), (1.0, 1.6)
# [rad] Signers turn that far from a camera that is meant to see them.
_SIDE = math.radians(30.0)
# Share of the hands that have a handshape of the inventory; others have fingers by chance.
_NAMED = 0.75
# Handshapes that only letters have.
_OF_LETTERS = ("c", "o", "f", "b", "u", "middle")
# [deg] Knuckle, middle and last joint of a finger by chance; its spread, from the index to the little one.
_BENDS = (
    (2, 4, 3),
    (82, 95, 60),
    (8, 80, 50),
    (75, 8, 5),
    (45, 48, 30),
    (25, 50, 35),
    (56, 48, 24),
    (22, 28, 15),
)
_LEAST_SPREAD, _MOST_SPREAD = (-2.0, -6.0, -12.0, -18.0), (13.0, 6.0, 0.0, -2.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class RenderedPerson:
    """A person over time.

    Attributes:
        clip: What the detector sees.
        truth: Body and hands, in the camera's axes: towards it, left, up [m]. Shape (T, 67, 3).
    """

    clip: PoseClip
    truth: Array


def rendered_person(number: int, scores: Sequence[Score], folder: Path) -> RenderedPerson:
    """One person; who, where and what follows from the number. What is rendered is kept in the folder."""
    seen, true = folder / f"{number}.pose", folder / f"{number}.npy"
    if not true.is_file():
        points, truth = _rendered(np.random.default_rng(number), number, scores)
        folder.mkdir(parents=True, exist_ok=True)
        write_atomically(seen, pose_file(_RATE, points, (_WIDTH, _HEIGHT)))
        with tempfile.NamedTemporaryFile(dir=folder, suffix=".part", delete=False) as file:
            np.save(file, truth)
        Path(file.name).replace(true)
    return RenderedPerson(clip=read_pose_file(seen), truth=np.load(true))


def _rendered(random: np.random.Generator, number: int, scores: Sequence[Score]) -> tuple[Array, Array]:
    """Points as `pose_file` has them, and the truth."""
    body = f"shown_{number}"
    BODIES[body] = random_people(1, number, body)[f"{body}_0"]
    script = yaml.safe_load(performance(scores[int(random.integers(len(scores)))]).text)
    for key in script["keys"]:
        for side in ("right", "left"):
            if isinstance(key.get(side), dict) and "shape" in key[side]:
                key[side]["shape"] = _shape(random)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "script.yaml"
        path.write_text(yaml.safe_dump(script), encoding="utf-8")
        take = Take(
            TakeOptions(
                script=str(path),
                body=body,
                distance=random.uniform(*_DISTANCES),
                camera_height=random.uniform(*_HEIGHTS),
                camera_side=random.uniform(-_SIDE, _SIDE),
                light=str(random.choice(list(LIGHTS))),
                width=_WIDTH,
                height=_HEIGHT,
                rate=_RATE,
                seed=number,
            )
        )
    detector = make_detector("mediapipe")
    points, truth = [], []
    try:
        rest = int(REST * _RATE)  # hands that hang teach nothing
        for index in range(rest, len(take) - rest):
            frame = take.frame(index)
            people = detector.detect(frame.color, frame.stamp)
            points.append(person_points(people[0]) if people else np.zeros((POINTS, 4)))
            truth.append(np.concatenate([frame.truth.body, frame.truth.left_hand, frame.truth.right_hand]))
    finally:
        detector.close()
    # Optical axes are right, down and away.
    return np.array(points), np.array(truth)[..., [2, 0, 1]] * (-1.0, 1.0, -1.0)


def _shape(random: np.random.Generator) -> Any:
    """A handshape as scripts write it."""
    if random.random() < _NAMED:
        names = (*(person_shape(name) for name in NAMES), *_OF_LETTERS)
        return names[random.integers(len(names))]
    bends = [list(map(float, _BENDS[at])) for at in random.integers(len(_BENDS), size=len(FINGERS))]
    spread = random.uniform(_LEAST_SPREAD, _MOST_SPREAD).tolist()
    thumbs = list(THUMBS)
    return dict(zip(FINGERS, bends, strict=True)) | {
        "spread": spread,
        "thumb": thumbs[random.integers(len(thumbs))],
    }
