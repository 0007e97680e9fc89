# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The original skeletonRetriever behind the interface of `Retriever`, with its own names of parameters."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.compat.original_retriever import OriginalRetriever
from teo_skeleton_retriever.compat.original_skeleton import (
    FROM_BODY_25,
    SKELETON_STD,
    ContourDilation,
    OriginalParameters,
    OriginalSkeleton,
)
from teo_skeleton_retriever.detectors.detector import DetectionFrame
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25, FACE_70, HAND_21
from teo_skeleton_retriever.layouts.skeleton_3d import Keypoints3D, KeypointStatus, Skeleton, frame_of_body
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.tracking.person_tracker import SignerChoice

_ROWS = np.array([BODY_25.index[name] for name in FROM_BODY_25])
_SOURCES = np.array([SKELETON_STD.index[tag] for tag in FROM_BODY_25.values()])


class CompatRetriever:
    """The original's processing with the defaults of its code, the signer chosen by our rule.

    As the original it takes the camera for one with its field of view, centred and without distortion, gives
    17 keypoints of the body (those of BODY_25 that it knows), and neither hands, face, confidence nor sigma.
    """

    def __init__(self, parameters: RetrieverParameters, original: OriginalParameters | None = None) -> None:
        """Build a retriever that has seen nobody yet; `parameters` matter for the signer's choice alone."""
        self._original = original or OriginalParameters()
        self._signer = SignerChoice(parameters.signer_rule, parameters.signer_patience)
        self._camera: CameraModel | None = None
        self._retriever: OriginalRetriever | None = None

    def process(self, frame: DetectionFrame) -> tuple[Skeleton, ...]:
        """Take one image. Another camera begins anew, as a restart of the original did."""
        if self._retriever is None or not _same(self._camera, frame.camera):
            self._camera = frame.camera
            seen = CameraModel.from_field_of_view(
                width=frame.camera.width,
                height=frame.camera.height,
                horizontal=2.0 * math.atan2(frame.camera.width, 2.0 * frame.camera.fx),
            )
            self._retriever = OriginalRetriever(seen, self._original)
        found = self._retriever.step(frame.stamp, frame.people, frame.depth)
        signer = self._signer.step(frame.stamp, _places(found))
        return tuple(_skeleton(i, i == signer, found[i]) for i in sorted(found))

    @property
    def newcomer_images(self) -> None:
        """The original asks for no number of images."""
        return None

    def lock_signer(self, track_id: int | None) -> None:
        """Follow this person as the signer; None chooses by the rule again."""
        self._signer.lock(track_id)


_GROUPS = {
    "skeleton": (
        "keys_recognition_confidence",
        "keys_recognition_percentage",
        "keys_acceptable_misses",
        "min_acceptable_path",
        "tracking_threshold",
        "time_to_live",
    ),
    "filtering": ("filter_keypoint_order", "filter_limblength_order", "optimize_limblength"),
    "depth": ("kernel_size", "iterations", "min_distance", "max_distance"),
}
# The original's names of the options; those of its camera and ports have no meaning here.
_OPTIONS = {f"{group}::{name.replace('_', '-')}": name for group, names in _GROUPS.items() for name in names}
_ENABLE = "depth::enable"
_DEFAULTS = {**vars(OriginalParameters()), **vars(ContourDilation())}


def original_parameters_from(words: Sequence[str]) -> OriginalParameters:
    """Give the original's parameters.

    Args:
        words: `group::name=value` each; empty ones do not matter. What is not named has the default of the
            original's code.

    Raises:
        RetrieverError: A name is not known, or a value is none.
    """
    chosen: dict[str, Any] = {}
    enabled = True
    for word in filter(None, words):
        name, _, text = (part.strip() for part in word.partition("="))
        if name == _ENABLE:
            enabled = bool(_value(name, text, bool))
        elif name in _OPTIONS:
            chosen[_OPTIONS[name]] = _value(name, text, type(_DEFAULTS[_OPTIONS[name]]))
        else:
            raise RetrieverError(
                "unknown_compat_option",
                f"expected NAME=VALUE with a name of {', '.join((*_OPTIONS, _ENABLE))}; got {word!r:.80}",
            )
    depth = {name: chosen.pop(name) for name in _GROUPS["depth"] if name in chosen}
    return OriginalParameters(depth_filter=ContourDilation(**depth) if enabled else None, **chosen)


def _value(name: str, text: str, kind: type) -> float:
    try:
        value: float = _switch(text) if kind is bool else kind(text)
    except ValueError as error:
        raise RetrieverError("wrong_type", f"{name}: got {text!r:.40}: {error}") from None
    least = 1 if name == "depth::kernel-size" else 0
    if not (math.isfinite(value) and value >= least):
        raise RetrieverError("out_of_range", f"{name}: expected {least} or more, got {text}")
    return value


def _switch(text: str) -> bool:
    if text.lower() not in ("true", "false", "on", "off"):
        raise ValueError("expected true or false")
    return text.lower() in ("true", "on")


def compat_retriever(parameters: RetrieverParameters, options: Sequence[str]) -> CompatRetriever:
    """Make one from options as users type them; see `original_parameters_from`.

    Raises:
        RetrieverError: An option is not known, or a value is none.
    """
    return CompatRetriever(parameters, original_parameters_from(options))


def _same(one: CameraModel | None, other: CameraModel) -> bool:
    return one is not None and (one.width, one.height, one.fx) == (other.width, other.height, other.fx)


def _places(found: Mapping[int, OriginalSkeleton]) -> dict[int, FloatArray]:
    """Mean position of each person's updated keypoints [m], by id; people without any are absent."""
    places = {}
    for track_id, skeleton in found.items():
        known = skeleton.points[skeleton.updated & np.isfinite(skeleton.points).all(axis=1)]
        if len(known):
            places[track_id] = known.mean(axis=0)
    return places


def _skeleton(track_id: int, is_signer: bool, original: OriginalSkeleton) -> Skeleton:
    body = Keypoints3D.lost(len(BODY_25))
    points, pixels, status = body.points.copy(), body.pixels.copy(), body.status.copy()
    points[_ROWS], pixels[_ROWS] = original.points[_SOURCES], original.pixels[_SOURCES]
    known = np.isfinite(points).all(axis=1)
    status[_ROWS] = KeypointStatus.HELD  # "stale" in the original: where it was last
    status[_ROWS[original.updated[_SOURCES]]] = KeypointStatus.MEASURED
    status[~known] = KeypointStatus.LOST
    confidence = np.where(known, np.nan, 0.0)
    return Skeleton(
        track_id=track_id,
        is_signer=is_signer,
        body=replace(body, points=points, confidence=confidence, status=status, pixels=pixels),
        left_hand=Keypoints3D.lost(len(HAND_21)),
        right_hand=Keypoints3D.lost(len(HAND_21)),
        face=Keypoints3D.lost(len(FACE_70)),
        body_frame=frame_of_body(points),
    )
