# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Ways from keypoints and depth to joints, with the same in and out: ours and what it is held against."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from accuracy.takes import TakeFrame
from teo_skeleton_retriever.arrays import DepthArray, FloatArray
from teo_skeleton_retriever.compat.original_retriever import OriginalRetriever
from teo_skeleton_retriever.compat.original_skeleton import FROM_BODY_25, SKELETON_STD, OriginalParameters
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25
from teo_skeleton_retriever.retriever import DetectionFrame, Retriever, RetrieverParameters, Skeleton

Detections = Callable[[TakeFrame], tuple[Person2D, ...]]
_KEYPOINTS = 25 + 2 * 21 + 70  # of body, left hand, right hand and face


class Estimate(NamedTuple):
    """What a method says of one image: body, left hand, right hand, face; NaN where it says nothing."""

    points: FloatArray
    """[m]. Shape (137, 3)"""
    sigma: FloatArray
    """[m]. Shape (137, 3)"""


def detected(frame: TakeFrame) -> tuple[Person2D, ...]:
    """What the detector saw."""
    return frame.people


def perfect(frame: TakeFrame) -> tuple[Person2D, ...]:
    """What a perfect detector would see: the truth, projected.

    Of hands only those that the real one found, and their shape as it imagines it.
    """

    def seen(points: FloatArray) -> FloatArray:
        return np.nan_to_num(np.column_stack([frame.camera.project(points), np.ones(len(points))]))

    truth = frame.truth
    body, left, right, face = map(seen, (truth.body, truth.left_hand, truth.right_hand, truth.face))
    real = frame.people[0] if frame.people else Person2D()
    return (
        Person2D(
            body=body,
            left_hand=left if len(real.left_hand) else real.left_hand,
            right_hand=right if len(real.right_hand) else real.right_hand,
            face=face,
            left_hand_world=real.left_hand_world,
            right_hand_world=real.right_hand_world,
        ),
    )


def ours(
    frames: Sequence[TakeFrame], see: Detections, worsen: Callable[[DepthArray], DepthArray] | None = None
) -> list[Estimate]:
    """The retriever as it is set by default, but that somebody is a person from the first image on.

    Args:
        frames: The take.
        see: What the detector sees of each.
        worsen: What becomes of the depth.
    """
    detector = "other" if see is perfect else "mediapipe"
    retriever = Retriever(RetrieverParameters(newcomer_images=1, detector=detector))
    estimates = []
    for frame in frames:
        depth = frame.depth() if worsen is None else worsen(frame.depth())
        found = retriever.process(DetectionFrame(frame.stamp, see(frame), depth, frame.camera))
        # The signer, or the first person while nobody is known to be one.
        signers = [skeleton for skeleton in found if skeleton.is_signer] or list(found)
        estimates.append(_estimate_of(signers[0]) if signers else _nothing())
    return estimates


def _estimate_of(skeleton: Skeleton) -> Estimate:
    parts = (skeleton.body, skeleton.left_hand, skeleton.right_hand, skeleton.face)
    return Estimate(
        np.concatenate([part.points for part in parts]), np.concatenate([part.sigma for part in parts])
    )


def one_pixel(frames: Sequence[TakeFrame], see: Detections) -> list[Estimate]:
    """The usual way: the depth of the one pixel at each keypoint, taken as it is."""
    estimates = []
    for frame in frames:
        estimate = _nothing()
        for person in see(frame)[:1]:
            depth = frame.depth()
            found = [as_body_25(person.body)]
            for part, count in ((person.left_hand, 21), (person.right_hand, 21), (person.face, 70)):
                found.append(part if len(part) else np.zeros((count, 3)))
            keypoints = np.concatenate(found)
            columns, rows = np.rint(keypoints[:, :2]).astype(int).T
            seen = (keypoints[:, 2] >= 0.3) & frame.camera.contains(keypoints[:, :2])
            depths = np.full(len(keypoints), np.nan)
            depths[seen] = depth[rows[seen], columns[seen]]
            estimate.points[:] = frame.camera.unproject(keypoints[:, :2], depths)
        estimates.append(estimate)
    return estimates


def original(frames: Sequence[TakeFrame], see: Detections) -> list[Estimate]:
    """The processing of skeletonRetriever with the defaults of its code; it knows neither hands nor faces."""
    retriever = OriginalRetriever(frames[0].camera, OriginalParameters())
    estimates = []
    for frame in frames:
        found = retriever.step(frame.stamp, see(frame), frame.depth())
        estimate = _nothing()
        if found:
            skeleton = found[max(found)]
            for name, tag in FROM_BODY_25.items():
                row = SKELETON_STD.index[tag]
                if skeleton.updated[row]:
                    estimate.points[BODY_25.index[name]] = skeleton.points[row]
        estimates.append(estimate)
    return estimates


def _nothing() -> Estimate:
    """What is said where nobody is found."""
    return Estimate(np.full((_KEYPOINTS, 3), np.nan), np.full((_KEYPOINTS, 3), np.nan))
