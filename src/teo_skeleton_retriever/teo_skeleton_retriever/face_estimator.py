"""The face of a person over time."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.depth_lookup import DepthLookup
from teo_skeleton_retriever.detected import Detected
from teo_skeleton_retriever.face_70 import FACE_70
from teo_skeleton_retriever.face_depth import face_depths
from teo_skeleton_retriever.filtered import keypoints_of
from teo_skeleton_retriever.frame import Frame
from teo_skeleton_retriever.keypoint_filter import KeypointFilter
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.skeleton_3d import Keypoints3D

_N = len(FACE_70)
_ACCELERATION = 6.0  # [m/s^2] a head that nods: 5 cm in 0.2 s
_ACROSS = 0.003  # [m] how the detector's keypoints jump from image to image,
_PIXEL = 0.4  # [px] and no less than this
_BIAS = (0.006, 0.008)  # [m] across the ray and along it


class FaceEstimator:
    """Follows one face."""

    def __init__(self, parameters: RetrieverParameters) -> None:
        self._parameters = parameters
        self._filter = KeypointFilter(
            _N,
            acceleration=_ACCELERATION,
            hold_time=parameters.hold_time,
            smoothing=parameters.smoothing,
        )
        self._lookup = DepthLookup(
            radius=0.01, gap=0.05, nearest=parameters.min_depth, farthest=parameters.max_depth
        )
        self._confidence = np.zeros(_N)

    def step(self, frame: Frame, seen: Detected, head: float) -> Keypoints3D:
        """Take one image.

        Args:
            frame: the image.
            seen: by the detector.
            head: depth of the head by the body [m]; NaN if not known.
        """
        depth = self._filter.predict(frame.stamp).depth
        known = depth[np.isfinite(depth)]
        expected = float(np.median(known)) if len(known) else head
        values = np.full((_N, 3), np.nan)
        sigma = np.full((_N, 3), np.nan)
        optimised = np.zeros(_N, dtype=bool)
        if seen.seen.any():
            surfaces = self._lookup.surfaces(
                frame.depth, seen.pixels, focal=frame.camera.fx, distance=np.full(_N, expected)
            )
            found = face_depths(seen.rays, surfaces, expected)
            values = np.column_stack([seen.rays, found.depths])
            across = np.hypot(_ACROSS / found.depths, _PIXEL / frame.camera.fx)
            sigma = np.column_stack([across, across, found.sigma])
            optimised = ~found.measured
        output = self._filter.step(frame.stamp, values, sigma)
        self._confidence = np.where(seen.seen, seen.confidence, self._confidence)
        return keypoints_of(
            output,
            seen,
            optimised=optimised,
            bias=np.tile(_BIAS, (_N, 1)),
            max_sigma=self._parameters.max_sigma,
            memory=self._confidence,
        )
