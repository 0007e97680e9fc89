# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From 2D keypoints and a depth image to the original's skeleton of one image."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.compat.original_parameters import OriginalParameters
from teo_skeleton_retriever.compat.original_skeleton import (
    FALLBACKS,
    FROM_BODY_25,
    MIDPOINTS,
    SKELETON_STD,
    OriginalSkeleton,
)
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18
from teo_skeleton_retriever.layouts.person_2d import Person2D, body_25_from_coco_18


def detect(
    person: Person2D, depth: DepthArray, camera: CameraModel, parameters: OriginalParameters
) -> OriginalSkeleton:
    """Look up the depth of each keypoint, at one pixel, and put it in space.

    Args:
        person: With a body in BODY_25 or COCO; one without a body gives a skeleton without keypoints.
        depth: Filtered [m], NaN where unknown. Shape (height, width).
        camera: `CameraModel.from_field_of_view` for what the original assumes.
        parameters: Of the original.

    Raises:
        RetrieverError: The body is in a layout that the original does not know.
    """
    skeleton = OriginalSkeleton()
    if not len(person.body):
        return skeleton
    body = _body_25(person.body)
    pixels, points = _in_space(body, depth, camera, parameters.keys_recognition_confidence)
    sources = {tag: [name] for name, tag in FROM_BODY_25.items()}
    for tag, name in FALLBACKS.items():
        sources[tag].append(name)
    for tag, names in sources.items():
        for name in names:
            row = BODY_25.index[name]
            if np.isfinite(points[row]).all():
                _put(skeleton, tag, points[row], pixels[row])
                break
    for tag, (left, right) in MIDPOINTS.items():
        pair = [SKELETON_STD.index[left], SKELETON_STD.index[right]]
        if not skeleton.updated[SKELETON_STD.index[tag]] and skeleton.updated[pair].all():
            _put(skeleton, tag, skeleton.points[pair].mean(axis=0), np.full(2, np.nan))
    return skeleton


def is_valid(skeleton: OriginalSkeleton, parameters: OriginalParameters) -> bool:
    """Tell whether the original takes this for a person."""
    return bool(
        np.isfinite(skeleton.pivots()).any()
        and skeleton.updated.mean() >= parameters.keys_recognition_percentage
        and skeleton.max_path() >= parameters.min_acceptable_path
    )


def _body_25(body: FloatArray) -> FloatArray:
    if len(body) == len(BODY_25):
        return body
    if len(body) == len(COCO_18):
        converted = body_25_from_coco_18(body)
        # The original knows no mid-hip in COCO: the centre comes from the hips in space, without a pixel.
        converted[BODY_25.index["MidHip"]] = 0.0
        return converted
    raise RetrieverError("wrong_layout", f"expected a body in BODY_25 or COCO, got {len(body)} keypoints")


def _in_space(
    body: FloatArray, depth: DepthArray, camera: CameraModel, confidence: float
) -> tuple[FloatArray, FloatArray]:
    """Give whole pixels and points, NaN where a keypoint is not seen. Shapes (25, 2), (25, 3)."""
    height, width = depth.shape
    pixels = np.trunc(body[:, :2])
    columns, rows = pixels.T
    inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
    seen = inside & (body[:, 2] >= confidence)
    depths = np.full(len(body), np.nan)
    depths[seen] = depth[rows[seen].astype(int), columns[seen].astype(int)]
    return pixels, camera.unproject(pixels, depths)


def _put(skeleton: OriginalSkeleton, tag: str, point: FloatArray, pixel: FloatArray) -> None:
    row = SKELETON_STD.index[tag]
    skeleton.points[row], skeleton.pixels[row], skeleton.updated[row] = point, pixel, True
