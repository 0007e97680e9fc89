# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The original as a whole: 2D people and depth in, tracked 3D skeletons out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from teo_skeleton_retriever.arrays import DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.compat.limb_ipopt import IpoptLimbSolver
from teo_skeleton_retriever.compat.original_detection import detect, is_valid
from teo_skeleton_retriever.compat.original_parameters import OriginalParameters
from teo_skeleton_retriever.compat.original_skeleton import OriginalSkeleton
from teo_skeleton_retriever.compat.original_track import LimbSolver, OriginalTrack
from teo_skeleton_retriever.layouts.person_2d import Person2D


class OriginalRetriever:
    """Tracks people by the pixels of their neck and mid-hip, first come first served.

    Left out of the original: names given by a face recogniser, the robot's pose, the database it writes to.
    """

    def __init__(
        self,
        camera: CameraModel,
        parameters: OriginalParameters | None = None,
        solver: LimbSolver | None = None,
    ) -> None:
        """Build a retriever.

        Args:
            camera: Of the depth images, `CameraModel.from_field_of_view` for what the original assumes.
            parameters: The defaults of the original's code if None.
            solver: Of limbs; Ipopt with the original's options if None.
        """
        self._camera = camera
        self._parameters = parameters or OriginalParameters()
        self._solver = solver or IpoptLimbSolver()
        self._tracks: dict[int, OriginalTrack] = {}
        self._last_seen: dict[int, float] = {}
        self._next_id = 0

    def step(self, time: float, people: Sequence[Person2D], depth: DepthArray) -> dict[int, OriginalSkeleton]:
        """Take one image.

        Args:
            time: Of the image [s].
            people: Seen in it.
            depth: [m], NaN where unknown. Shape (height, width).

        Returns:
            All tracked skeletons by id; one that was not seen is as it was.
        """
        self._forget(time)
        if self._parameters.depth_filter is not None:
            depth = self._parameters.depth_filter.apply(depth)
        seen = [detect(person, depth, self._camera, self._parameters) for person in people]
        pending = dict(self._tracks)
        for skeleton in seen:
            if not is_valid(skeleton, self._parameters):
                continue
            track_id = self._match(skeleton.pivots(), pending)
            if track_id is None:
                track_id = self._next_id
                self._next_id += 1
                self._tracks[track_id] = OriginalTrack(self._camera, self._parameters, self._solver)
            else:
                del pending[track_id]
            self._tracks[track_id].step(skeleton)
            self._last_seen[track_id] = time
        return {track_id: track.skeleton.copy() for track_id, track in self._tracks.items()}

    def _forget(self, time: float) -> None:
        for track_id in [
            i for i, seen in self._last_seen.items() if time - seen >= self._parameters.time_to_live
        ]:
            del self._tracks[track_id], self._last_seen[track_id]

    def _match(self, pivots: FloatArray, pending: dict[int, OriginalTrack]) -> int | None:
        best, nearest = None, self._parameters.tracking_threshold
        for track_id, track in pending.items():
            with np.errstate(invalid="ignore"):
                moved = np.linalg.norm(pivots - track.pivots, axis=1)
            distance = float(np.min(np.where(np.isfinite(moved), moved, np.inf)))
            if distance < nearest or (best is None and distance == nearest):
                best, nearest = track_id, distance
        return best
