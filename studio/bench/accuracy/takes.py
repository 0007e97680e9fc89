# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Rendered takes with their truth and what the detector sees in them, kept on disk between runs."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from kept import kept_folder
from teo_common.atomic_files import write_atomically
from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_synthetic_signer import Companion, Truth, render_take

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
    companions: tuple[Companion, ...] = ()

    def name(self) -> str:
        """Give a name that no other settings have."""
        digest = hashlib.sha256(repr(sorted(asdict(self).items())).encode()).hexdigest()[:8]
        return f"{self.script}-{self.body}-{self.distance:.1f}m-{self.sensor}-{digest}"


@dataclass(frozen=True, eq=False, kw_only=True)
class TakeFrame:
    """One image of a take, compressed."""

    stamp: float
    jpeg: bytes
    png: bytes
    camera: CameraModel
    truth: Truth
    people: tuple[Person2D, ...]
    others: tuple[Truth, ...] = ()
    """of the companions"""

    def color(self) -> NDArray[np.uint8]:
        """Give the image. RGB, shape (height, width, 3)."""
        image = cv2.imdecode(np.frombuffer(self.jpeg, np.uint8), cv2.IMREAD_COLOR)
        assert image is not None  # it was encoded here
        return np.asarray(image[..., ::-1], dtype=np.uint8)

    def depth(self) -> DepthArray:
        """Give the depth [m], NaN where unknown. Shape (height, width)."""
        steps = cv2.imdecode(np.frombuffer(self.png, np.uint8), cv2.IMREAD_UNCHANGED)
        assert steps is not None
        depth: DepthArray = np.where(steps > 0, steps * np.float32(_STEP), np.nan).astype(np.float32)
        return depth


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
        companions=settings.companions,
    )
    detector = make_detector("mediapipe")
    try:
        for frame in frames:
            with np.errstate(invalid="ignore"):
                steps = np.nan_to_num(np.rint(frame.depth / _STEP), nan=0.0)
            steps = np.where(steps < 65536, steps, 0).astype(np.uint16)
            yield TakeFrame(
                stamp=frame.stamp,
                jpeg=cv2.imencode(".jpg", frame.color[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, 92])[
                    1
                ].tobytes(),
                png=cv2.imencode(".png", steps, [cv2.IMWRITE_PNG_COMPRESSION, 1])[1].tobytes(),
                camera=frame.camera,
                truth=frame.truth,
                others=frame.others,
                people=detector.detect(frame.color, frame.stamp),
            )
    finally:
        detector.close()
