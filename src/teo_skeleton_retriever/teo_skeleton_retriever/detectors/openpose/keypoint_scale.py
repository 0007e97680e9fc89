# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From the units in which OpenPose was asked to write keypoints (`--keypoint_scale`) to pixels of the image.

Source of the figures: OpenPose 1.7, `keypointScaler.cpp`: fractions are of size - 1, one factor for both axes
where an image is fitted into a resolution.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.body_conversion import as_body_25
from teo_skeleton_retriever.layouts.person_2d import Person2D

# Pixels of the image; of the network's input; of the output; [0, 1]; [-1, 1].
SOURCE, NET, OUTPUT, UNIT, SYMMETRIC = range(5)


class KeypointScale:
    """Brings keypoints into pixels.

    Args:
        keypoint_scale: OpenPose's option of that name: 0 to 4.
        resolution: Width, height of the network's input for 1 (`--net_resolution`), of the output for 2
            (`--output_resolution`); the image was fitted into it.

    Raises:
        RetrieverError: No such scale, or a resolution is missing, superfluous or none.
    """

    def __init__(self, keypoint_scale: int, resolution: Sequence[int] | None) -> None:
        if keypoint_scale not in range(5):
            raise RetrieverError("bad_scale", f"expected a keypoint_scale of 0 to 4, got {keypoint_scale!r}")
        fitted = keypoint_scale in (NET, OUTPUT)
        if fitted and (resolution is None or len(resolution) != 2 or min(resolution) < 2):
            raise RetrieverError(
                "bad_resolution",
                f"keypoint_scale {keypoint_scale}: expected the resolution (width, height) [px] that "
                f"keypoints are in, got {resolution!r}",
            )
        if not fitted and resolution is not None:
            raise RetrieverError(
                "bad_resolution", f"keypoint_scale {keypoint_scale}: expected no resolution, got {resolution}"
            )
        self._kind = keypoint_scale
        self._resolution = resolution

    def to_pixels(self, person: Person2D, width: int, height: int) -> Person2D:
        """Give a person in BODY_25 and in pixels of an image of this size; what is unseen becomes zero."""
        scale, offset = self._factors(width, height)
        return replace(
            person,
            body=_scaled(as_body_25(person.body), scale, offset),
            left_hand=_scaled(person.left_hand, scale, offset),
            right_hand=_scaled(person.right_hand, scale, offset),
            face=_scaled(person.face, scale, offset),
        )

    def _factors(self, width: int, height: int) -> tuple[FloatArray, float]:
        last = np.array([width - 1.0, height - 1.0])
        if self._kind == UNIT:
            return last, 0.0
        if self._kind == SYMMETRIC:
            return last / 2.0, 1.0
        if self._resolution is None:
            return np.ones(2), 0.0
        into = np.array(self._resolution, dtype=np.float64) - 1.0
        return np.full(2, 1.0 / min(into / np.maximum(last, 1.0))), 0.0


def _scaled(table: FloatArray, scale: FloatArray, offset: float) -> FloatArray:
    seen = table[:, 2:] > 0.0  # in [-1, 1] OpenPose writes -1, -1, 0 for what it did not see
    return np.where(seen, np.column_stack([(table[:, :2] + offset) * scale, table[:, 2]]), 0.0)
