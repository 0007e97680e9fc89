"""One hand of a person over time."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.depth_lookup import Surfaces
from teo_skeleton_retriever.detected import Detected
from teo_skeleton_retriever.filtered import keypoints_of
from teo_skeleton_retriever.hand_21 import HAND_21
from teo_skeleton_retriever.hand_fit import HandFit, fit_hand
from teo_skeleton_retriever.keypoint_filter import KeypointFilter
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.skeleton_3d import Keypoints3D, KeypointStatus
from teo_skeleton_retriever.skin import HAND_DEPTHS

_N = len(HAND_21)
_ACCELERATION = 25.0  # [m/s^2] of fast signing: a stroke of 0.3 m in 0.2 s
_ACROSS = 0.004  # [m] how the detector's keypoints jump from image to image,
_PIXEL = 0.5  # [px] and no less than this
_BIAS = (0.009, 0.012)  # [m] across the ray and along it
_SUPPORTED = 6  # measured keypoints that make a hand's depth its own


class HandEstimator:
    """Follows one hand; while it is not seen it goes where its wrist goes."""

    def __init__(self, parameters: RetrieverParameters) -> None:
        self._parameters = parameters
        self._filter = KeypointFilter(
            _N,
            acceleration=_ACCELERATION,
            hold_time=parameters.hold_time,
            smoothing=parameters.smoothing,
        )
        self._confidence = np.zeros(_N)
        self._from_wrist = np.full((_N, 3), np.nan)  # as last seen

    def expected_depth(self, time: float) -> float:
        """Tell where the hand should be [m]; NaN if that is not known."""
        return float(_median(self._filter.predict(time).depth))

    def fit(
        self,
        time: float,
        seen: Detected,
        surfaces: Surfaces,
        *,
        world: FloatArray | None,
        scale: float,
        wrist: float,
    ) -> HandFit | None:
        """Find the depths of the hand in this image; None if it is not seen well enough.

        Args:
            time: [s].
            seen: by the detector.
            surfaces: measured at its keypoints.
            world: the shape that the detector imagines [m]. Shape (21, 3), or None.
            scale: of the person against an average adult.
            wrist: depth of the wrist's joint by the arm [m]; NaN if not known.
        """
        if not self._parameters.fit_hands:
            return _unfitted(seen, surfaces, scale)
        return fit_hand(
            seen.rays, surfaces, scale=scale, world=world, expected=self.expected_depth(time), wrist=wrist
        )

    def step(
        self, time: float, seen: Detected, fit: HandFit | None, *, wrist: FloatArray, focal: float
    ) -> Keypoints3D:
        """Take one image.

        Args:
            time: [s].
            seen: by the detector.
            fit: of this image; None if there is none.
            wrist: place of the body's wrist [m]; NaN if not known. Shape (3,).
            focal: length of the camera [px].
        """
        values = np.full((_N, 3), np.nan)
        sigma = np.full((_N, 3), np.nan)
        optimised = np.zeros(_N, dtype=bool)
        if fit is not None:
            values = np.column_stack([seen.rays, fit.depths])
            across = np.hypot(_ACROSS / fit.depths, _PIXEL / focal)
            sigma = np.column_stack([across, across, fit.sigma])
            optimised = ~fit.measured
        output = self._filter.step(time, values, sigma)
        self._confidence = np.where(seen.seen, seen.confidence, self._confidence)
        found = keypoints_of(
            output,
            seen,
            optimised=optimised,
            bias=np.tile(_BIAS, (_N, 1)),
            max_sigma=self._parameters.max_sigma,
            memory=self._confidence,
        )
        return self._attached(found, wrist)

    def _attached(self, found: Keypoints3D, wrist: FloatArray) -> Keypoints3D:
        """Put what is held where it was on the hand, not where it was in space."""
        held = found.status == KeypointStatus.HELD
        if not np.isfinite(wrist).all():
            return found
        moved = np.where(
            held[:, None] & np.isfinite(self._from_wrist), wrist + self._from_wrist, found.points
        )
        self._from_wrist = np.where(held[:, None], self._from_wrist, found.points - wrist)
        return Keypoints3D(moved, found.confidence, found.status, found.sigma, found.pixels)


def supported(fit: HandFit | None) -> bool:
    """Tell whether a hand's depth was measured at the hand itself."""
    return fit is not None and int(fit.measured.sum()) >= _SUPPORTED


def _unfitted(seen: Detected, surfaces: Surfaces, scale: float) -> HandFit:
    nearest = surfaces.nearest()
    depths = nearest.depth + scale * HAND_DEPTHS
    return HandFit(depths, nearest.sigma, seen.seen & np.isfinite(depths))


def _median(values: FloatArray) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else float("nan")
