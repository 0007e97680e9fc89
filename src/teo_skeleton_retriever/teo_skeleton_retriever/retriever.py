# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The retriever: 2D keypoints and depth of one image after the other in, tracked 3D people out."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, median
from teo_skeleton_retriever.depth.depth_lookup import DepthLookup, viewing_rays
from teo_skeleton_retriever.detectors.detector import DetectionFrame
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25
from teo_skeleton_retriever.layouts.skeleton_3d import Keypoints3D, KeypointStatus, Skeleton, frame_of_body
from teo_skeleton_retriever.person_estimator import PersonEstimator
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.tracking.person_tracker import PersonTracker, SignerChoice

__all__ = ["DetectionFrame", "KeypointStatus", "Keypoints3D", "Retriever", "RetrieverParameters", "Skeleton"]

_TRUNK = [BODY_25.index[name] for name in ("Neck", "RShoulder", "LShoulder", "MidHip", "RHip", "LHip")]
_USUAL = 1.5  # [m] distance of a signer; only sets how much around a keypoint is looked at
# [m] Around a trunk's keypoint that depth is looked at, and between the depths of different surfaces there.
_RADIUS, _GAP = 0.03, 0.06
_TORN = 0.3  # [m] between the depths of a trunk's keypoints when something hides a part of it
_LEAST_TRUNK = 2  # keypoints of the trunk that say where it is; with fewer everything that is seen is asked


class Retriever:
    """Follows people in space. Knows the time from the stamps of the frames alone.

    Not safe to share between threads.
    """

    def __init__(self, parameters: RetrieverParameters | None = None, *, recorded: bool = False) -> None:
        """Build a retriever that has seen nobody yet; in a recording its first image counts at once."""
        self._parameters = parameters or RetrieverParameters()
        self._lookup = DepthLookup(nearest=self._parameters.min_depth, farthest=self._parameters.max_depth)
        self._signer = SignerChoice(self._parameters.signer_rule, self._parameters.signer_patience)
        self._tracker = PersonTracker(int(self._parameters.newcomer_images), recorded=recorded)
        self._people: dict[int, PersonEstimator] = {}
        self._time: float | None = None

    def process(self, frame: DetectionFrame) -> tuple[Skeleton, ...]:
        """Take one image. A stamp before the last forgets everybody: a bag was set back.

        Returns:
            Everybody who is seen in it, or was within the time that keypoints are held, by ascending id.
        """
        if self._time is not None and frame.stamp < self._time:
            self._people = {}
        self._time = frame.stamp
        positions = [self._positions(frame, person) for person in frame.people]
        ids = self._tracker.step(frame.stamp, positions)
        remembered = self._tracker.people
        self._people = {i: person for i, person in self._people.items() if i in remembered}
        seen = {i: remembered[i].position for i in ids if i is not None}
        signer = self._signer.step(frame.stamp, seen)
        people = {i: person for i, person in zip(ids, frame.people, strict=True) if i is not None}
        hold = self._parameters.hold_time
        held = [i for i in self._people if i not in people and frame.stamp - remembered[i].last_seen <= hold]
        skeletons = [
            self._skeleton(frame, people[i], i, float(seen[i][2]), is_signer=i == signer) for i in people
        ]
        skeletons += [
            self._skeleton(
                frame, Person2D(), i, float(remembered[i].position[2]), is_signer=i == self._signer.signer
            )
            for i in held
        ]
        return tuple(sorted(skeletons, key=lambda skeleton: skeleton.track_id))

    @property
    def newcomer_images(self) -> int:
        """Images in which someone must be seen to become a person."""
        return int(self._parameters.newcomer_images)

    def lock_signer(self, track_id: int | None) -> None:
        """Follow this person as the signer and nobody else; None chooses by the rule again."""
        self._signer.lock(track_id)

    def _positions(self, frame: DetectionFrame, person: Person2D) -> FloatArray:
        """Give about where a person's trunk may be, the likeliest first [m]; NaN if no depth tells.

        Shape (k, 3).
        """
        body = as_body_25(person.body)
        seen = viewing_rays(body, frame.camera, self._parameters.min_confidence)
        for rows in (_TRUNK, list(range(len(body)))):
            surfaces = self._lookup.surfaces(
                frame.depth,
                seen.pixels[rows],
                focal=frame.camera.fx,
                distance=np.full(len(rows), _USUAL),
                radius=_RADIUS,
                gap=_GAP,
            )
            depth = surfaces.nearest().depth
            known = np.isfinite(depth)
            if known.sum() >= (_LEAST_TRUNK if rows is _TRUNK else 1):
                ray = np.append(seen.rays[rows][known].mean(axis=0), 1.0)
                return np.outer(_middles(depth[known]), ray)
        return np.full((1, 3), np.nan)

    def _skeleton(
        self, frame: DetectionFrame, person: Person2D, track_id: int, distance: float, *, is_signer: bool
    ) -> Skeleton:
        estimator = self._people.setdefault(track_id, PersonEstimator(self._parameters))
        parts = estimator.step(frame, person, distance)
        return Skeleton(
            track_id=track_id,
            is_signer=is_signer,
            body_frame=frame_of_body(parts["body"].points),
            **parts,
        )


def _middles(depths: FloatArray) -> list[float]:
    """Candidate depths of a trunk [m]: median of all keypoints, of the farther half and of the nearer half.

    Of a person who walks by behind another, some keypoints have the depth of the one in front.
    """
    middles = [median(depths)]
    between = float(depths.min() + depths.max()) / 2.0
    if depths.max() - depths.min() > _TORN:
        middles += [median(depths[depths > between]), median(depths[depths <= between])]
    return middles
