# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A take: a person, with or without companions, in one room, plays a script before one sensor."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.body.surface import RayCaster
from teo_synthetic_signer.camera.renderer import LIGHTS, Rendered, Renderer
from teo_synthetic_signer.camera.sensors import DepthModel
from teo_synthetic_signer.camera.sensors import sensor as sensor_named
from teo_synthetic_signer.camera.visibility import visible
from teo_synthetic_signer.errors import SyntheticError, named
from teo_synthetic_signer.script.motion import Motion
from teo_synthetic_signer.script.script_file import script_of
from teo_synthetic_signer.take.furniture import furnish


@dataclass(frozen=True, eq=False, kw_only=True)
class Truth:
    """Where the keypoints of the rendered person are, and which of them the camera could see.

    Places are in the camera's optical frame (x right, y down, z forward) [m]; all are known, also of those
    that are hidden or outside the image. A keypoint is visible if it is in the image and nothing lies
    between it and the camera but its own skin.

    Attributes:
        body: Of BODY_25. Shape (25, 3).
        left_hand: Of HAND_21, the person's own left. Shape (21, 3).
        right_hand: Likewise.
        face: Of FACE_70. Shape (70, 3).
        body_visible: Shape (25,).
        left_hand_visible: Shape (21,).
        right_hand_visible: Shape (21,).
        face_visible: Shape (70,).
    """

    body: FloatArray
    left_hand: FloatArray
    right_hand: FloatArray
    face: FloatArray
    body_visible: BoolArray
    left_hand_visible: BoolArray
    right_hand_visible: BoolArray
    face_visible: BoolArray


@dataclass(frozen=True, eq=False, kw_only=True)
class TruthFrame:
    """What is true at one moment, with or without an image of it.

    Attributes:
        stamp: Since the start of the take [s].
        camera: That looks.
        truth: Where the keypoints of the signer are.
        others: And those of each companion.
    """

    stamp: float
    camera: CameraModel
    truth: Truth
    others: tuple[Truth, ...] = ()


@dataclass(frozen=True, eq=False, kw_only=True)
class SyntheticFrame(TruthFrame):
    """One rendered image.

    Attributes:
        color: Red, green, blue. Shape (height, width, 3).
        depth: Along the optical axis, as the sensor model measures it [m]; NaN where it measures nothing.
            Shape (height, width), aligned to the colour image.
    """

    color: NDArray[np.uint8]
    depth: DepthArray


# Between camera and person [m]: nearer the camera is inside the person, farther behind the room.
DISTANCES = (0.2, 6.0)
# Height that a camera looks at unless told otherwise, of the person's: the middle of where one signs.
_CHEST = 0.755
# Standard deviation of the colour image's noise, of its range. Assumption: a sensor in room light.
_COLOR_NOISE = 0.008


@dataclass(frozen=True, kw_only=True)
class Companion:
    """Somebody else in the image.

    Attributes:
        body: One of `BODIES`.
        script: What they do, as the signer's.
        behind: How far behind the signer they stand, negative before [m].
        aside: How far to the signer's left [m].
    """

    body: str
    script: str = "still"
    behind: float = 0.0
    aside: float = 0.9


@dataclass(frozen=True, kw_only=True)
class TakeOptions:
    """What is rendered.

    Attributes:
        script: One of `SCRIPTS`, or the path of a script's file, which ends in .yaml.
        body: One of `BODIES`.
        scene: One of `SCENES`.
        sensor: One of `SENSORS`.
        distance: From the camera to the person, along the floor [m].
        camera_height: Above the floor [m].
        camera_pitch: Of the camera downwards [rad]; None looks at the chest.
        camera_roll: Of the camera about its view, clockwise as it looks [rad].
        camera_side: Of the camera about the person, to the person's left [rad].
        light: One of `LIGHTS`.
        companions: Who else is there.
        width: Of the images [px].
        height: Likewise.
        rate: Frames per second [Hz].
        seed: Of everything random; the same gives the same frames.
        perfect_depth: The sensor measures exactly, everywhere.
    """

    script: str = "signing"
    body: str = "woman_average"
    scene: str = "office"
    sensor: str = "d435"
    distance: float = 1.5
    camera_height: float = 1.3
    camera_pitch: float | None = None
    camera_roll: float = 0.0
    camera_side: float = 0.0
    light: str = "room"
    companions: tuple[Companion, ...] = ()
    width: int = 640
    height: int = 480
    rate: float = 30.0
    seed: int = 0
    perfect_depth: bool = False

    def __post_init__(self) -> None:
        if not DISTANCES[0] <= self.distance <= DISTANCES[1]:
            raise SyntheticError(
                "bad_distance", f"expected {DISTANCES[0]} to {DISTANCES[1]} m, got {self.distance}"
            )
        if not 0.0 < self.rate <= 120.0:
            raise SyntheticError("bad_rate", f"expected a rate above 0, to 120 Hz, got {self.rate}")
        if not 0.1 <= self.camera_height <= 2.7:
            raise SyntheticError(
                "bad_camera_height", f"expected 0.1 to 2.7 m, in the room, got {self.camera_height}"
            )
        if self.camera_pitch is not None and not abs(self.camera_pitch) < math.pi / 2.0:
            raise SyntheticError("bad_camera_pitch", f"expected less than pi/2 rad, got {self.camera_pitch}")
        for name in ("roll", "side"):
            angle = getattr(self, f"camera_{name}")
            if not abs(angle) <= math.pi:
                raise SyntheticError(f"bad_camera_{name}", f"expected -pi to pi rad, got {angle}")


class _Actor:
    """One person of a take, and what they do."""

    def __init__(self, body: str, script: str, offset: tuple[float, float]) -> None:
        keys, self.about = script_of(script)
        self.signer = Signer(body)
        self.motion = Motion(self.signer.poser, keys)
        self._offset = np.array([*offset, 0.0])

    def at(self, stamp: float) -> tuple[FloatArray, tuple[FloatArray, ...]]:
        """Give vertices and keypoints in the room [m]; who has played their script stays as they end."""
        pose = self.motion.pose(min(stamp, self.motion.duration))
        transforms = self.signer.poser.transforms(pose)
        points = self.signer.keypoints(pose, transforms)
        vertices = self.signer.vertices(pose, transforms)
        return vertices + self._offset, tuple(part + self._offset for part in points)


class Take:
    """A take that frames can be asked of, in any order."""

    def __init__(self, options: TakeOptions) -> None:
        """Prepare body, room and camera.

        Raises:
            SyntheticError: A name that does not exist, or a number out of its range.
        """
        self._options = options
        self.sensor = sensor_named(options.sensor)
        self.camera: CameraModel = self.sensor.camera(options.width, options.height)
        vertices, self._room = furnish(options.scene)
        actor = _Actor(options.body, options.script, (0.0, 0.0))
        self.about, self.motion = actor.about, actor.motion
        self._light = named("light", options.light, LIGHTS)
        self._actors = (
            actor,
            *(_Actor(one.body, one.script, (-one.behind, one.aside)) for one in options.companions),
        )
        self._rotation, self._position = self._camera_pose(actor.signer.height)
        self._surfaces = [one.signer.dress.surface for one in self._actors]
        self._walls = self._seen(vertices)

    @property
    def about_it(self) -> dict[str, str]:
        """What the metadata of a bag say of the take."""
        options = self._options
        script, distance = Path(options.script).name, f"{options.distance:g} m"
        return {
            "synthetic signer": (
                f"{script} by {options.body} in {options.scene} before {options.sensor} at {distance}"
            ),
            "script": self.about,
        }

    def __len__(self) -> int:
        """Tell how many frames the take has."""
        return int(self.motion.duration * self._options.rate) + 1

    @cached_property
    def _renderer(self) -> Renderer:
        return Renderer(self.camera, self._rotation, self._surfaces, self._room, self._walls, self._light)

    @cached_property
    def _obstacles(self) -> RayCaster:
        return RayCaster(self._walls[self._room.triangles])

    def truth(self, index: int) -> TruthFrame:
        """Tell what is true in a frame, without the image: in a third of the time."""
        stamp = index / self._options.rate
        people = [actor.at(stamp) for actor in self._actors]
        casters = [
            RayCaster(self._seen(vertices)[surface.triangles])
            for (vertices, _), surface in zip(people, self._surfaces, strict=True)
        ]
        truth, *others = self._truths([points for _, points in people], casters)
        return TruthFrame(stamp=stamp, camera=self.camera, truth=truth, others=tuple(others))

    def frame(self, index: int) -> SyntheticFrame:
        """Render one frame, the first is 0."""
        options = self._options
        stamp = index / options.rate
        people = [actor.at(stamp) for actor in self._actors]
        rendered = self._renderer.render([self._seen(vertices) for vertices, _ in people])
        random = np.random.default_rng([options.seed, index])
        truth, *others = self._truths([points for _, points in people], rendered.people)
        return SyntheticFrame(
            stamp=stamp,
            color=self._color(rendered, random),
            depth=self._depth(rendered, random),
            camera=self.camera,
            truth=truth,
            others=tuple(others),
        )

    def _color(self, rendered: Rendered, random: np.random.Generator) -> NDArray[np.uint8]:
        color = rendered.color
        if self.sensor.mono:
            color = np.repeat(color.mean(axis=2, keepdims=True), 3, axis=2)
        noise = random.standard_normal(color.shape, dtype=np.float32)
        steps = np.rint((color + _COLOR_NOISE * noise) * 255.0)
        return np.clip(steps, 0, 255).astype(np.uint8)

    def _depth(self, rendered: Rendered, random: np.random.Generator) -> DepthArray:
        if self._options.perfect_depth:
            return np.where(np.isfinite(rendered.distance), rendered.distance, np.float32(np.nan))
        return DepthModel(self.sensor, self.camera, random).measure(rendered.distance, rendered.facing)

    def _truths(self, people: Sequence[tuple[FloatArray, ...]], casters: Sequence[RayCaster]) -> list[Truth]:
        """Bring keypoints in the room to the camera's axes, with which of them it sees, for each person."""
        truths = []
        for i, points in enumerate(people):
            body, left, right, face = (self._seen(part) for part in points)
            around = [self._obstacles, *casters[:i], *casters[i + 1 :]]
            bones = self._surfaces[i].bones
            seen = visible(casters[i], around, bones, self.camera, (body, left, right, face))
            truths.append(
                Truth(
                    body=body,
                    left_hand=left,
                    right_hand=right,
                    face=face,
                    body_visible=seen[0],
                    left_hand_visible=seen[1],
                    right_hand_visible=seen[2],
                    face_visible=seen[3],
                )
            )
        return truths

    def _camera_pose(self, height: float) -> tuple[FloatArray, FloatArray]:
        """Give the rotation from the room's axes to the camera's, and where the camera is."""
        options = self._options
        pitch = options.camera_pitch
        if pitch is None:
            pitch = math.atan2(options.camera_height - _CHEST * height, options.distance)
        ahead = np.array([-math.cos(pitch), 0.0, -math.sin(pitch)])
        right = np.array([0.0, 1.0, 0.0])
        down = np.cross(ahead, right)
        cosine, sine = math.cos(options.camera_roll), math.sin(options.camera_roll)
        right, down = cosine * right + sine * down, cosine * down - sine * right
        cosine, sine = math.cos(options.camera_side), math.sin(options.camera_side)
        about = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        place = about @ (options.distance, 0.0, options.camera_height)
        return np.stack([right, down, ahead]) @ about.T, place

    def _seen(self, points: FloatArray) -> FloatArray:
        return (points - self._position) @ self._rotation.T


def render_take(*, frames: range | None = None, **options: Any) -> Iterator[SyntheticFrame]:
    """Render a take, frame by frame.

    Yields:
        The frames, in order.

    Raises:
        SyntheticError: A name that does not exist, or a number out of its range.
    """
    take = Take(TakeOptions(**options))
    for index in range(len(take)) if frames is None else frames:
        yield take.frame(index)
