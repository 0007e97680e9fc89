"""The body of a person over time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arm_solver import Arm, ArmSolver
from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.body_25 import BODY_25
from teo_skeleton_retriever.body_size import BodySize
from teo_skeleton_retriever.depth_lookup import DepthLookup
from teo_skeleton_retriever.detected import Detected
from teo_skeleton_retriever.filtered import keypoints_of, points_of
from teo_skeleton_retriever.frame import Frame
from teo_skeleton_retriever.keypoint_filter import FilterOutput, KeypointFilter
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.skeleton_3d import Keypoints3D
from teo_skeleton_retriever.skin import BODY_DEPTHS, along_ray

_N = len(BODY_25)
_ROW = BODY_25.index
ARMS: dict[str, list[int]] = {
    side: [_ROW[f"{side}{joint}"] for joint in ("Shoulder", "Elbow", "Wrist")] for side in ("R", "L")
}
"""Rows of shoulder, elbow and wrist on the right and on the left."""
_LEGS = [[_ROW[f"{side}{joint}"] for joint in ("Hip", "Knee", "Ankle")] for side in ("R", "L")]
_TRUNK = np.array(
    [_ROW[name] for name in ("Nose", "Neck", "RShoulder", "LShoulder", "MidHip", "RHip", "LHip")]
)
_AXES = np.array(
    [
        (_ROW[f"{side}{joint}"], _ROW[f"{side}{before}"])
        for side in ("R", "L")
        for joint, before in (("Elbow", "Shoulder"), ("Wrist", "Elbow"), ("Knee", "Hip"), ("Ankle", "Knee"))
    ]
)
"""Joints that lie on a limb, and where that limb begins."""

_ACCELERATION = np.full(_N, 5.0)  # [m/s^2] of a trunk that leans and a head that nods
_ACCELERATION[[_ROW[f"{side}Elbow"] for side in "RL"]] = 12.0
_ACCELERATION[[_ROW[f"{side}Wrist"] for side in "RL"]] = 25.0  # a stroke of 0.3 m in 0.2 s
_ACROSS = 0.005  # [m] how the detector's keypoints jump from image to image,
_PIXEL = 0.5  # [px] and no less than this
_DEPTH = 0.008  # [m] how far the skin is from a tube around the limb
_BIAS = (0.015, 0.015)  # [m] across the ray and along it
_HIDDEN = 0.06  # [m] a trunk does not come nearer by this from image to image: something hides it
_LENGTH_SIGMA = (0.02, 0.06)  # [m] of a limb whose length was measured, and of one that was not


class BodyStep(NamedTuple):
    """What one image says of a body."""

    keypoints: Keypoints3D
    wrists: dict[str, float]
    """depth of the right and the left wrist where it follows from the arm [m]"""


class BodyEstimator:
    """Follows one body."""

    def __init__(self, parameters: RetrieverParameters) -> None:
        self._parameters = parameters
        self._filter = KeypointFilter(
            _N,
            acceleration=_ACCELERATION,
            hold_time=parameters.hold_time,
            smoothing=parameters.smoothing,
        )
        self._lookup = DepthLookup(nearest=parameters.min_depth, farthest=parameters.max_depth)
        self._arms = ArmSolver()
        self._confidence = np.zeros(_N)
        self.size = BodySize()

    def expected(self, time: float) -> FloatArray:
        """Tell where the joints should be [m]; NaN where that is not known. Shape (25, 3)."""
        return points_of(self._filter.predict(time))

    def step(
        self, frame: Frame, seen: Detected, *, distance: float, wrists: Mapping[str, tuple[float, float]]
    ) -> BodyStep:
        """Take one image.

        Args:
            frame: the image.
            seen: by the detector.
            distance: of the person [m].
            wrists: depth of the right and left wrist by the hand's own shape, and its sigma [m]; only
                those that are known.
        """
        before = self._filter.predict(frame.stamp)
        depth, sigma = self._measure(frame, seen, before, distance)
        for side, (value, spread) in wrists.items():
            depth[ARMS[side][2]], sigma[ARMS[side][2]] = value, spread
        self._reject_hidden_trunk(depth, before)
        self._reject_long_legs(depth, seen)
        optimised = np.zeros(_N, dtype=bool)
        solved: dict[str, float] = {}
        if self._parameters.optimise_limbs:
            for side in ARMS:
                solved |= self._solve_arm(side, seen, depth, sigma, before, optimised)
        across = np.hypot(_ACROSS / depth, _PIXEL / frame.camera.fx)
        near = np.nan_to_num(before.depth, nan=distance)
        across = np.where(np.isfinite(across), across, np.hypot(_ACROSS / near, _PIXEL / frame.camera.fx))
        output = self._filter.step(
            frame.stamp,
            np.column_stack([seen.rays, depth]),
            np.column_stack([across, across, sigma]),
        )
        measured = output.fresh & ~optimised
        self.size.step(points_of(output), measured)
        self._confidence = np.where(seen.seen, seen.confidence, self._confidence)
        keypoints = keypoints_of(
            output,
            seen,
            optimised=optimised,
            bias=np.tile(_BIAS, (_N, 1)),
            max_sigma=self._parameters.max_sigma,
            memory=self._confidence,
        )
        return BodyStep(keypoints, solved)

    def _measure(
        self, frame: Frame, seen: Detected, before: FilterOutput, distance: float
    ) -> tuple[FloatArray, FloatArray]:
        """Give the depths of the joints by what is seen at them, and their sigmas [m]. Shapes (25,)."""
        behind = self._behind_skin(before)
        expected = before.depth - behind
        surfaces = self._lookup.surfaces(
            frame.depth,
            seen.pixels,
            focal=frame.camera.fx,
            distance=np.where(np.isfinite(expected), expected, distance),
        )
        sample = surfaces.closest(expected)
        return sample.depth + behind, np.hypot(sample.sigma, _DEPTH)

    def _behind_skin(self, before: FilterOutput) -> FloatArray:
        """How far behind the skin the joints are along the optical axis [m]. Shape (25,)."""
        if not self._parameters.skin_offset:
            return np.zeros(_N)
        radius = BODY_DEPTHS * self.size.scale
        points = points_of(before)
        axis = np.full((_N, 3), np.nan)
        axis[_AXES[:, 0]] = points[_AXES[:, 0]] - points[_AXES[:, 1]]
        return along_ray(radius, axis, points)

    def _reject_hidden_trunk(self, depth: FloatArray, before: FilterOutput) -> None:
        """Forget depths of the trunk that are nearer than it can have come."""
        with np.errstate(invalid="ignore"):
            nearer = before.depth - depth > np.maximum(_HIDDEN, 4.0 * before.sigma[:, 2])
        rows = _TRUNK[nearer[_TRUNK]]
        depth[rows] = np.nan

    def _reject_long_legs(self, depth: FloatArray, seen: Detected) -> None:
        """Forget depths that make a leg longer than belief."""
        points = np.column_stack([seen.rays, np.ones(_N)]) * depth[:, None]
        for hip, knee, ankle in _LEGS:
            for near, far, limb in ((hip, knee, "thigh"), (knee, ankle, "shank")):
                if self.size.too_long(limb, float(np.linalg.norm(points[far] - points[near]))):
                    depth[far] = np.nan

    def _solve_arm(
        self,
        side: str,
        seen: Detected,
        depth: FloatArray,
        sigma: FloatArray,
        before: FilterOutput,
        optimised: BoolArray,
    ) -> dict[str, float]:
        """Put the depths of an arm right in place; give that of the wrist if it follows from the arm."""
        rows = ARMS[side]
        upper, forearm = (self.size.likely_length(limb) for limb in ("upper arm", "forearm"))
        arm = Arm(
            rays=seen.rays[rows],
            measured=depth[rows],
            sigma=sigma[rows],
            expected=before.depth[rows],
            expected_sigma=before.sigma[rows, 2],
            lengths=np.array([upper[0], forearm[0]]),
            length_sigma=np.array([_LENGTH_SIGMA[not known] for _, known in (upper, forearm)]),
        )
        solution = self._arms.solve(arm)
        if solution is None:
            return {}
        hidden = solution.hidden
        moved = hidden | ~np.isfinite(depth[rows])
        depth[rows] = solution.depths
        for row, is_hidden in zip(rows, moved, strict=True):
            if is_hidden:
                optimised[row] = True
                sigma[row] = _HIDDEN_SIGMA
        return {side: float(solution.depths[2])} if hidden[2] else {}


_HIDDEN_SIGMA = 0.04  # [m] of a joint found by the lengths alone, where they are 2 cm uncertain
