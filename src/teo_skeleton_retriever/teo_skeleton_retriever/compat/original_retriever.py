# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The original as a whole: 2D people and depth in, tracked 3D skeletons out.

Keypoints are held and filtered, limbs calibrated and optimised by Ipopt with the original's options.
"""

from __future__ import annotations

import importlib
from collections import deque
from collections.abc import Mapping, Sequence
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.compat.original_skeleton import (
    CHAINS,
    LIMBS,
    PARENTS,
    SKELETON_STD,
    OriginalParameters,
    OriginalSkeleton,
    body_planes,
    detect,
    is_valid,
)
from teo_skeleton_retriever.depth.limb_solver import LimbChain, LimbSolution
from teo_skeleton_retriever.layouts.person_2d import Person2D

# Fixed in the original's code. With the tolerance on an objective in m^4 it stops some millimetres before the
# minimum.
ORIGINAL_OPTIONS: dict[str, object] = {
    "tol": 1e-4,
    "acceptable_iter": 0,
    "mu_strategy": "adaptive",
    "hessian_approximation": "limited-memory",
    "max_iter": 100,
    "max_cpu_time": 0.05,  # [s]
}
_ACCEPTED = ("Solve_Succeeded", "Solved_To_Acceptable_Level", "Feasible_Point_Found")


class IpoptLimbSolver:
    """Moves the depths of a limb so that its lengths hold. One solver serves limbs of any length."""

    def __init__(self, options: Mapping[str, object] = ORIGINAL_OPTIONS) -> None:
        """Build a solver with options of Ipopt."""
        self._options = tuple(options.items())

    def solve(self, chain: LimbChain) -> LimbSolution:
        """Solve one limb. Takes about 2 ms."""
        nlp = _problem(len(chain.rays), self._options)
        found = nlp(
            x0=chain.start,
            p=np.concatenate([chain.rays.ravel(), chain.lengths**2]),
            lbx=chain.lower,
            ubx=chain.upper,
        )
        depths = np.array(found["x"], dtype=np.float64).ravel()
        return LimbSolution(depths, nlp.stats()["return_status"] in _ACCEPTED)


@cache
def _problem(joints: int, options: tuple[tuple[str, object], ...]) -> Any:
    """Build the problem of so many keypoints; its parameters are the rays, then the squared lengths."""
    # Here, for its half a second: who does not solve limbs does not wait for it.
    casadi: Any = importlib.import_module("casadi")
    depths = casadi.SX.sym("depths", joints)
    parameters = casadi.SX.sym("parameters", 3 * joints - 1)
    points = [
        depths[i] * casadi.vertcat(parameters[2 * i], parameters[2 * i + 1], 1.0) for i in range(joints)
    ]
    steps = [a - b for a, b in pairwise(points)]
    missed = [casadi.dot(step, step) - parameters[2 * joints + i] for i, step in enumerate(steps)]
    cost = sum(value**2 for value in missed)
    ipopt = {"print_level": 0, "sb": "yes", **dict(options)}
    quiet = {"print_time": False, "calc_f": False, "calc_g": False, "calc_lam_x": False, "calc_lam_p": False}
    return casadi.nlpsol(
        "limb", "ipopt", {"x": depths, "p": parameters, "f": cost}, {**quiet, "ipopt": ipopt}
    )


class OriginalMedian:
    """Median of the last `order + 1` samples, axis by axis; until so many came, the start value.

    With order 3 the first three images after a keypoint appears show its first place: so the original does.
    Source: `MedianFilter` of iCub's control library.
    """

    def __init__(self, order: int) -> None:
        self._samples: deque[FloatArray] = deque(maxlen=order + 1)
        self._output = np.full(3, np.nan)

    def restart(self, start: FloatArray) -> None:
        """Forget all samples and show this value until the filter is full again. Shape (k,)."""
        self._samples.clear()
        self._output = np.array(start, dtype=np.float64)

    def step(self, sample: FloatArray) -> FloatArray:
        """Take a sample and give the output. Shape (k,) each."""
        self._samples.append(np.array(sample, dtype=np.float64))
        if len(self._samples) == self._samples.maxlen:
            self._output = np.median(np.array(self._samples), axis=0)
        return self._output.copy()


# A limb this many times as long as calibrated loses its far end for that image; fixed in the original.
_TOO_LONG = 2.0


class OriginalLimbLength:
    """Median of the first `order + 1` lengths of a limb, kept for good even if these were bad.

    `LimbLength` goes on estimating.
    """

    def __init__(self, order: int) -> None:
        self._order = order
        self._lengths: list[float] = []
        self.value: float | None = None
        """The calibrated length [m]; None until then."""

    def step(self, length: float) -> None:
        """Take a measured length [m]."""
        if self.value is None:
            self._lengths.append(length)
            if len(self._lengths) > self._order:
                self.value = float(np.median(self._lengths))

    def too_long(self, length: float) -> bool:
        """Whether a length [m] is more than `_TOO_LONG` times the calibrated one; False before that."""
        return self.value is not None and length > _TOO_LONG * self.value


_INDEX = SKELETON_STD.index


class OriginalTrack:
    """One person. `skeleton` is what the original publishes."""

    def __init__(self, camera: CameraModel, parameters: OriginalParameters) -> None:
        self.skeleton = OriginalSkeleton()
        self.pivots = self.skeleton.pivots()
        self._camera = camera
        self._parameters = parameters
        self._solver = IpoptLimbSolver()
        self._medians = [OriginalMedian(parameters.filter_keypoint_order) for _ in SKELETON_STD.keypoints]
        self._lengths = {limb: OriginalLimbLength(parameters.filter_limblength_order) for limb in LIMBS}
        self._misses_left = np.zeros(len(SKELETON_STD), dtype=int)

    def length(self, limb: str) -> float | None:
        """Calibrated length of the limb that ends at this keypoint [m]; None until then."""
        return self._lengths[limb].value

    def step(self, seen: OriginalSkeleton) -> None:
        """Take what one image shows of the person."""
        samples, updated = self._hold(seen)
        for i in np.flatnonzero(updated):
            self.skeleton.points[i] = self._medians[i].step(samples[i])
        self.skeleton.updated = updated
        self.skeleton.updated = updated & ~self._calibrate()
        if self._parameters.optimize_limblength:
            for chain in CHAINS:
                self._optimise(chain)
        self._orient()
        self.pivots = seen.pivots()

    def _hold(self, seen: OriginalSkeleton) -> tuple[FloatArray, BoolArray]:
        """Samples for the filters: keypoints of this image, or for a while the last ones."""
        samples, updated = seen.points.copy(), seen.updated.copy()
        for i in range(len(samples)):
            if seen.updated[i]:
                if self._misses_left[i] == 0:
                    self._medians[i].restart(seen.points[i])
                self._misses_left[i] = self._parameters.keys_acceptable_misses
                self.skeleton.pixels[i] = seen.pixels[i]
            elif self._misses_left[i] > 0:
                samples[i], updated[i] = self.skeleton.points[i], True
                self._misses_left[i] -= 1
        return samples, updated

    def _calibrate(self) -> BoolArray:
        """Take the lengths of the limbs; mark keypoints that are too far from their parents. Shape (17,)."""
        too_far = np.zeros(len(SKELETON_STD), dtype=bool)
        for limb, length in self._lengths.items():
            i, parent = _INDEX[limb], _INDEX[str(PARENTS[limb])]
            if self.skeleton.updated[i] and self.skeleton.updated[parent]:
                measured = float(np.linalg.norm(self.skeleton.points[i] - self.skeleton.points[parent]))
                length.step(measured)
                too_far[i] = length.too_long(measured)
        return too_far

    def _optimise(self, tags: tuple[str, ...]) -> None:
        rows = [_INDEX[tag] for tag in tags]
        lengths = [self._lengths[tag].value for tag in tags[1:]]
        anchor = self.skeleton.points[_INDEX[str(PARENTS[tags[0]])], 2]
        known = [length for length in lengths if length is not None]
        if not self.skeleton.updated[rows].all() or len(known) < len(lengths) or not np.isfinite(anchor):
            return
        if min(known) <= 0.0:
            return  # keypoints in one place while it was calibrated: no length to hold
        chain = LimbChain.original(self.skeleton.points[rows], np.array(known), anchor_depth=float(anchor))
        solution = self._solver.solve(chain)
        if solution.converged:
            self.skeleton.pixels[rows] = self._camera.project(self.skeleton.points[rows])
            self.skeleton.points[rows] = chain.points(solution.depths)

    def _orient(self) -> None:
        def updated(tag: str) -> FloatArray:
            i = _INDEX[tag]
            return self.skeleton.points[i] if self.skeleton.updated[i] else np.full(3, np.nan)

        self.skeleton.planes = body_planes(
            left_shoulder=updated("shoulderLeft"),
            right_shoulder=updated("shoulderRight"),
            shoulder_center=updated("shoulderCenter"),
            hip_center=updated("hipCenter"),
            before=self.skeleton.planes,
        )


class OriginalRetriever:
    """Tracks people by the pixels of their neck and mid-hip, first come first served.

    Left out of the original: names given by a face recogniser, the robot's pose, the database it writes to.
    """

    def __init__(self, camera: CameraModel, parameters: OriginalParameters) -> None:
        """Build a retriever.

        Args:
            camera: Of the depth images, `CameraModel.from_field_of_view` for what the original assumes.
            parameters: Of the original.
        """
        self._camera = camera
        self._parameters = parameters
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
                self._tracks[track_id] = OriginalTrack(self._camera, self._parameters)
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
