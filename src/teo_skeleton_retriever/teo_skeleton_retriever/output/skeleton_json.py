# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Skeletons as JSON, with the names and units of the messages."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from teo_skeleton_retriever.layouts.layout import Layout
from teo_skeleton_retriever.layouts.skeleton_3d import (
    SKELETON_PARTS,
    BodyFrame,
    Keypoints3D,
    KeypointStatus,
    Skeleton,
)

_DIGITS = 5  # of metres, hundredths of a millimetre


def as_json(stamp: float, skeletons: Sequence[Skeleton]) -> dict[str, Any]:
    """Give everybody seen in one image, as what `json.dumps` takes.

    What is not known is null; a keypoint that is lost is left out.
    """
    return {"stamp": stamp, "skeletons": [_skeleton(skeleton) for skeleton in skeletons]}


def _skeleton(skeleton: Skeleton) -> dict[str, Any]:
    parts = {part: _part(getattr(skeleton, part), layout) for part, layout in SKELETON_PARTS.items()}
    return {
        "id": skeleton.track_id,
        "is_signer": skeleton.is_signer,
        "body_frame": _frame(skeleton.body_frame),
        **parts,
    }


def _part(keypoints: Keypoints3D, layout: Layout) -> dict[str, Any]:
    return {
        name: {
            "position": _numbers(keypoints.points[i]),
            "sigma": _numbers(keypoints.sigma[i]),
            "pixel": _numbers(keypoints.pixels[i]),
            "confidence": _number(keypoints.confidence[i]),
            "status": KeypointStatus(keypoints.status[i]).name.lower(),
        }
        for i, name in enumerate(layout.keypoints)
        if keypoints.status[i] != KeypointStatus.LOST
    }


def _frame(frame: BodyFrame | None) -> dict[str, Any] | None:
    if frame is None:
        return None
    axes = [_numbers(row) for row in frame.rotation]
    return {"origin": _numbers(frame.origin), "rotation": axes, "anchor": frame.anchor}


def _numbers(values: Any) -> list[float | None]:
    return [_number(value) for value in values]


def _number(value: Any) -> float | None:
    return round(float(value), _DIGITS) if math.isfinite(value) else None
