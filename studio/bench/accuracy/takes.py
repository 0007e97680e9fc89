# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Rendered takes with their truth and what the detector sees in them, kept on disk between runs."""

from __future__ import annotations

import hashlib
import math
import pickle
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import cv2
import numpy as np

from kept import kept_folder
from teo_common.atomic_files import write_atomically
from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_synthetic_signer import Truth, render_take
from teo_synthetic_signer.body.body_shapes import BODIES, random_people

_STEP = 1e-4  # [m] of stored depth: a twentieth of the camera's own noise, up to 6.5 m


@dataclass(frozen=True, kw_only=True)
class TakeSettings:
    """One short sequence: who signs what, where, before which camera."""

    script: str
    body: str
    scene: str
    distance: float
    camera_height: float
    start: float
    seconds: float = 1.7
    sensor: str = "d435"
    rate: float = 15.0
    seed: int = 0
    camera_roll: float = 0.0
    light: str = "room"

    def name(self) -> str:
        """Give a name that no other settings have."""
        digest = hashlib.sha256(repr(sorted(asdict(self).items())).encode()).hexdigest()[:8]
        return f"{self.script}-{self.body}-{self.distance:.1f}m-{self.sensor}-{digest}"


@dataclass(frozen=True, eq=False, kw_only=True)
class TakeFrame:
    """One image of a take."""

    stamp: float
    png: bytes
    """of its depth"""
    camera: CameraModel
    truth: Truth
    people: tuple[Person2D, ...]

    def depth(self) -> DepthArray:
        """Give the depth [m], NaN where unknown. Shape (height, width)."""
        steps = cv2.imdecode(np.frombuffer(self.png, np.uint8), cv2.IMREAD_UNCHANGED)
        assert steps is not None
        return np.where(steps > 0, steps * np.float32(_STEP), np.nan).astype(np.float32)


def take(settings: TakeSettings, cache: Path) -> list[TakeFrame]:
    """Give a take, from disk if it is there."""
    path = cache / f"{settings.name()}.pickle"
    if not path.exists():
        frames = list(_rendered(settings))
        cache.mkdir(parents=True, exist_ok=True)
        write_atomically(path, pickle.dumps(frames, protocol=5))
    loaded: list[TakeFrame] = pickle.loads(path.read_bytes())
    return loaded


def default_cache() -> Path:
    """Give the folder that takes are kept in unless another is named."""
    rooms = (f"teo_skeleton_retriever.{room}" for room in ("camera", "detectors", "layouts"))
    return kept_folder("retriever_accuracy", "teo_synthetic_signer", *rooms, __name__)


def _rendered(settings: TakeSettings) -> Iterator[TakeFrame]:
    first = round(settings.start * settings.rate)
    frames = render_take(
        frames=range(first, first + round(settings.seconds * settings.rate)),
        script=settings.script,
        body=settings.body,
        scene=settings.scene,
        sensor=settings.sensor,
        distance=settings.distance,
        camera_height=settings.camera_height,
        rate=settings.rate,
        seed=settings.seed,
        camera_roll=settings.camera_roll,
        light=settings.light,
    )
    detector = make_detector("mediapipe")
    try:
        for frame in frames:
            with np.errstate(invalid="ignore"):
                steps = np.nan_to_num(np.rint(frame.depth / _STEP), nan=0.0)
            steps = np.where(steps < 65536, steps, 0).astype(np.uint16)
            yield TakeFrame(
                stamp=frame.stamp,
                png=cv2.imencode(".png", steps, [cv2.IMWRITE_PNG_COMPRESSION, 1])[1].tobytes(),
                camera=frame.camera,
                truth=frame.truth,
                people=detector.detect(frame.color, frame.stamp),
            )
    finally:
        detector.close()


_SCENES = ("office", "studio", "living_room", "near_wall")
# What the body does there is in none of the takes of calibration: script, start of each of its takes [s].
_KNOWN_MOTIONS = {
    "face": (0.4, 2.0, 3.6, 5.1),
    "crossing": (0.3, 1.4, 2.4, 3.4),
    "fast": (0.5, 1.9, 3.3, 4.5),
    "spelling": (0.6, 2.8, 5.0, 7.2),
    "turning": (0.3, 1.3, 2.3, 3.3),
}
KNOWN_TAKES: tuple[TakeSettings, ...] = tuple(
    TakeSettings(
        script=script,
        body=("man_tall", "woman_small", "woman_old")[(i + k) % 3],
        scene=("office", "living_room", "near_wall", "studio")[(i + k) % 4],
        distance=(1.2, 1.4, 1.6, 1.8, 2.0)[(i + k) % 5],
        camera_height=(1.0, 1.3, 1.6)[(i + 2 * k) % 3],  # [m] on a table, at the chest, on a stand
        start=start,
        seed=100 + 10 * i + k,
    )
    for i, (script, starts) in enumerate(_KNOWN_MOTIONS.items())
    for k, start in enumerate(starts)
)


def _held_out(count: int) -> Iterator[TakeSettings]:
    """Cameras at 1 to 2.5 m, rolled by up to 12 degrees, as on a tripod that nobody levelled."""
    random = np.random.default_rng(433_494)
    for i in range(count):
        yield TakeSettings(
            script=("signing", "face", "two_hands", "crossing", "turning", "spelling")[i % 6],
            body=f"held_out_{i}",
            scene=_SCENES[int(random.integers(4))],
            light=("room", "window", "ceiling", "evening")[i % 4],
            distance=round(float(random.uniform(1.0, 2.5)), 2),
            camera_height=round(float(random.uniform(0.9, 1.8)), 2),
            camera_roll=round(math.radians(float(random.uniform(-12.0, 12.0))), 3),
            start=round(float(random.uniform(0.4, 3.0)), 1),
            seconds=1.2,
            rate=10.0,
            seed=400_000 + i,
        )


BODIES |= random_people(12, 1_061_033, "held_out")
HELD_OUT_TAKES = tuple(_held_out(12))
