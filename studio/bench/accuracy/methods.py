# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Ways from keypoints and depth to joints, with the same in and out: ours and what it is held against."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from accuracy.takes import TakeFrame
from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.compat.original_retriever import OriginalRetriever
from teo_skeleton_retriever.compat.original_skeleton import FROM_BODY_25, SKELETON_STD, OriginalParameters
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25
from teo_skeleton_retriever.retriever import DetectionFrame, Retriever, RetrieverParameters, Skeleton

BODY_ROW = BODY_25.index
Detections = Callable[[TakeFrame], tuple[Person2D, ...]]


class Estimate(NamedTuple):
    """What a method says of one image; NaN where it says nothing."""

    body: FloatArray
    """[m]. Shape (25, 3)"""
    hands: FloatArray
    """left, then right [m]. Shape (42, 3)"""
    face: FloatArray
    """[m]. Shape (70, 3)"""
    sigma: FloatArray
    """of body and hands [m]; NaN where the method gives none. Shape (67, 3)"""
    status: NDArray[np.uint8]
    """of `KeypointStatus`, of body and hands; lost where the method gives none. Shape (67,)"""


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


def ours(frames: Sequence[TakeFrame], see: Detections) -> list[Estimate]:
    """The retriever as it is set by default, but that somebody is a person from the first image on."""
    detector = "other" if see is perfect else "mediapipe"
    retriever = Retriever(RetrieverParameters(newcomer_images=1, detector=detector))
    estimates = []
    for frame in frames:
        found = retriever.process(DetectionFrame(frame.stamp, see(frame), frame.depth(), frame.camera))
        estimates.append(signer_estimate(found))
    return estimates


def one_pixel(frames: Sequence[TakeFrame], see: Detections) -> list[Estimate]:
    """The usual way: the depth of the one pixel at each keypoint, taken as it is."""
    estimates = []
    for frame in frames:
        people = see(frame)
        if not people:
            estimates.append(nothing())
            continue
        depth = frame.depth()
        person = people[0]
        keypoints = np.concatenate(
            [
                as_body_25(person.body),
                *(
                    part if len(part) else np.zeros((n, 3))
                    for part, n in ((person.left_hand, 21), (person.right_hand, 21), (person.face, 70))
                ),
            ]
        )
        columns, rows = np.rint(keypoints[:, :2]).astype(int).T
        seen = (keypoints[:, 2] >= 0.3) & frame.camera.contains(keypoints[:, :2])
        depths = np.full(len(keypoints), np.nan)
        depths[seen] = depth[rows[seen], columns[seen]]
        points = frame.camera.unproject(keypoints[:, :2], depths)
        estimates.append(Estimate(points[:25], points[25:67], points[67:], *_untold()))
    return estimates


def original(frames: Sequence[TakeFrame], see: Detections) -> list[Estimate]:
    """The processing of skeletonRetriever with the defaults of its code; it knows neither hands nor faces."""
    retriever = OriginalRetriever(frames[0].camera, OriginalParameters())
    estimates = []
    for frame in frames:
        found = retriever.step(frame.stamp, see(frame), frame.depth())
        estimate = nothing()
        if found:
            skeleton = found[max(found)]
            for name, tag in FROM_BODY_25.items():
                row = SKELETON_STD.index[tag]
                if skeleton.updated[row]:
                    estimate.body[BODY_ROW[name]] = skeleton.points[row]
        estimates.append(estimate)
    return estimates


def signer_estimate(found: Sequence[Skeleton]) -> Estimate:
    """What is said of the signer, or of the first person while nobody is known to be one."""
    signers = [skeleton for skeleton in found if skeleton.is_signer] or list(found)
    return estimate_of(signers[0]) if signers else nothing()


def estimate_of(skeleton: Skeleton) -> Estimate:
    """What a skeleton says."""
    body, left, right = skeleton.body, skeleton.left_hand, skeleton.right_hand
    return Estimate(
        body.points,
        np.concatenate([left.points, right.points]),
        skeleton.face.points,
        np.concatenate([body.sigma, left.sigma, right.sigma]),
        np.concatenate([body.status, left.status, right.status]),
    )


def nothing() -> Estimate:
    """What is said where nobody is found."""
    body, hands, face = (np.full((n, 3), np.nan) for n in (25, 42, 70))
    return Estimate(body, hands, face, *_untold())


def _untold() -> tuple[FloatArray, NDArray[np.uint8]]:
    return np.full((67, 3), np.nan), np.zeros(67, dtype=np.uint8)
