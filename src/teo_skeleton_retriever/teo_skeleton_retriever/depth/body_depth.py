# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depths of a body's 25 joints in one image: skin, what hides it, and the lengths of arms and legs."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray, in_space, median
from teo_skeleton_retriever.depth.arm_depth import Arm, ArmSolution, ArmSolver
from teo_skeleton_retriever.depth.depth_lookup import Surfaces, ViewingRays
from teo_skeleton_retriever.depth.girdle_depth import girdle_depths
from teo_skeleton_retriever.depth.skin import (
    BODY_CAPS,
    BODY_DEPTHS,
    FOREARM_LEAST_SINE,
    FOREARM_RADIUS,
    along_ray,
)
from teo_skeleton_retriever.detectors.mediapipe.calibration import body_sigma, elbow_error
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_layout import ARMS, GIRDLE, ROW
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.tracking.body_size import BodySize
from teo_skeleton_retriever.tracking.keypoint_filter import FilterOutput

_N = len(BODY_25)
_LEGS = [[ROW[f"{side}{joint}"] for joint in ("Hip", "Knee", "Ankle")] for side in ("R", "L")]
_HEAD = np.array([ROW[name] for name in ("Nose", "REye", "LEye")])
# Joints at the ends of limbs, and the limbs' other ends. A wrist lies in the middle: the hand goes on.
_LIMBS = np.array(
    [
        (ROW[f"{side}{joint}"], ROW[f"{side}{other}"])
        for side in ("R", "L")
        for joint, other in (("Shoulder", "Elbow"), ("Elbow", "Shoulder"), ("Knee", "Hip"), ("Ankle", "Knee"))
    ]
)

_SKIN_SIGMA = 0.008  # [m] how far the skin is from a tube around the limb
_ACROSS = np.full(_N, 0.012)  # [m] how far the detector's keypoints are from the joints
_ACROSS[[ROW[f"{side}Elbow"] for side in "LR"]] = 0.02
_ACROSS[[ROW[f"{side}Wrist"] for side in "LR"]] = 0.025
_ACROSS[[ROW[f"{side}Ear"] for side in "LR"]] = 0.035  # seen at the cheek, 2 cm beside and below
_SLOPE = 0.5  # of a body's surface beside a joint that is not where it is seen
_ELBOWS = [rows[1] for rows in ARMS.values()]
_WRISTS = [rows[2] for rows in ARMS.values()]
_HAND_ACROSS = 0.012  # [m] the hand's own keypoints are nearer


class WristView(NamedTuple):
    """A wrist as the hand's own keypoints show it."""

    ray: FloatArray
    """x/z, y/z. Shape (2,)"""
    depth: float
    """[m]"""
    sigma: float
    """its standard deviation [m]"""
    certain: bool
    """whether so much of the hand was measured that nothing hides it"""


class BodyDepths(NamedTuple):
    """The depths of a body."""

    rays: FloatArray
    """x/z, y/z; where an arm's lengths say so, beside what the detector saw. Shape (25, 2)"""
    depths: FloatArray
    """of the joints [m]; NaN if not known. Shape (25,)"""
    across: FloatArray
    """standard deviations across the ray [m]. Shape (25,)"""
    sigma: FloatArray
    """standard deviations of the depths [m]; NaN likewise. Shape (25,)"""
    measured: FloatArray
    """the joints by what is seen at them alone, the lengths left aside [m]; NaN if hidden. Shape (25, 3)"""
    optimised: BoolArray
    """joints whose depth follows from the lengths of an arm. Shape (25,)"""


class BodyDepth:
    """Finds the depths of one person's body. Not safe to share between threads, as the arm solver."""

    def __init__(self, parameters: RetrieverParameters) -> None:
        self._parameters = parameters
        self._arms = ArmSolver()

    def find(
        self,
        seen: ViewingRays,
        surfaces: Surfaces,
        before: FilterOutput,
        size: BodySize,
        *,
        wrists: Mapping[str, WristView],
    ) -> BodyDepths:
        """Find the depths in one image.

        Args:
            seen: By the detector.
            surfaces: Measured around the joints.
            before: What the images before let expect.
            size: Of the person.
            wrists: The left ("L") and right ("R") wrist by the hand; only those that are known.
        """
        behind, slanted = self._behind_skin(before, size)
        sample = surfaces.closest(before.depth - behind)
        depth, sigma = sample.depth + behind, np.hypot(sample.sigma, np.hypot(_SKIN_SIGMA, slanted))
        rays, across = seen.rays.copy(), _ACROSS.copy()
        along = dict.fromkeys(ARMS, float(across[_ELBOWS[0]]))
        if self._parameters.detector == "mediapipe":
            across = body_sigma(across, seen.confidence)
            for side, (shoulder, elbow, wrist) in ARMS.items():
                forearm = _part_across(seen.rays[[elbow, wrist]], before.depth[wrist], size)
                short, along[side] = elbow_error(float(seen.confidence[elbow]), forearm)
                upper_arm = seen.rays[elbow] - seen.rays[shoulder]
                away = math.hypot(*upper_arm) * float(depth[elbow])
                if short > 0.0 and away > 0.0:
                    rays[elbow] += upper_arm * short / away
            # Beside the joint is another depth than at it.
            beside = across - _ACROSS
            beside[_ELBOWS] = [along[side] - _ACROSS[ARMS[side][1]] for side in ARMS]
            sigma = np.hypot(sigma, _SLOPE * np.maximum(beside, 0.0))
        for side, view in wrists.items():
            row = ARMS[side][2]
            rays[row], across[row] = view.ray, _HAND_ACROSS
            depth[row], sigma[row] = view.depth, view.sigma
        replaced = np.zeros(_N, dtype=bool)
        girdle = girdle_depths(
            surfaces.part(GIRDLE),
            behind[GIRDLE],
            head=median(depth[_HEAD]),
            expected=before.depth[GIRDLE],
            expected_sigma=before.sigma[GIRDLE, 2],
        )
        depth[GIRDLE], replaced[GIRDLE] = girdle.depth, girdle.hidden
        own = np.hypot(girdle.sigma, np.hypot(_SKIN_SIGMA, slanted[GIRDLE]))
        sigma[GIRDLE] = np.where(girdle.hidden, girdle.sigma, own)
        points = in_space(rays, depth)
        _reject_long_legs(depth, points, size)
        points[replaced] = np.nan
        found = BodyDepths(rays, depth, across, sigma, points, replaced)
        if self._parameters.optimise_limbs:
            certain = {side for side, view in wrists.items() if view.certain}
            self._solve_arms(found, along, surfaces.depth + behind[:, None], certain, before, size)
        return found

    def _behind_skin(self, before: FilterOutput, size: BodySize) -> tuple[FloatArray, FloatArray]:
        """Give how far behind the skin the joints are along the optical axis, and how uncertain that is [m].

        Shapes (25,).
        """
        if not self._parameters.skin_offset:
            return np.zeros(_N), np.zeros(_N)
        radius = BODY_DEPTHS * size.scale
        points = before.points
        limb = np.full((_N, 3), np.nan)
        limb[_LIMBS[:, 0]] = points[_LIMBS[:, 1]] - points[_LIMBS[:, 0]]
        behind = along_ray(radius, limb, points, BODY_CAPS)
        in_forearm = along_ray(
            np.full(len(_ELBOWS), FOREARM_RADIUS * size.scale),
            points[_WRISTS] - points[_ELBOWS],
            points[_ELBOWS],
            np.ones(len(_ELBOWS)),
            least_sine=FOREARM_LEAST_SINE,
        )
        behind[_ELBOWS] = np.maximum(behind[_ELBOWS], in_forearm)
        return behind, behind - radius

    def _solve_arms(
        self,
        found: BodyDepths,
        along: Mapping[str, float],
        by_surface: FloatArray,
        certain: Collection[str],
        before: FilterOutput,
        size: BodySize,
    ) -> None:
        """Solve both arms and enter their depths.

        Args:
            found: By what is seen; changed.
            along: Standard deviation of each elbow along the upper arm, in the image [m].
            by_surface: Depths of the joints if each surface is their skin [m]; NaN for none. Shape (25, 3).
            certain: Arms whose hand is surely not hidden.
            before: What the images before let expect.
            size: Of the person.
        """
        lengths, sigmas = zip(*(size.length(limb) for limb in ("upper arm", "forearm")), strict=True)
        readings: list[tuple[str, Arm]] = []
        for side, rows in ARMS.items():
            arm = Arm(
                rays=found.rays[rows],
                across=found.across[rows],
                elbow_along=along[side],
                measured=found.depths[rows],
                sigma=found.sigma[rows],
                certain=np.array([False, False, side in certain]),
                expected=before.depth[rows],
                expected_sigma=before.sigma[rows, 2],
                lengths=np.array(lengths),
                length_sigma=np.array(sigmas),
            )
            readings += [(side, reading) for reading in _readings(arm, by_surface[rows[1]])]
        solved = self._arms.solve([reading for _, reading in readings])
        for side, rows in ARMS.items():
            solution = _likeliest(one for (of, _), one in zip(readings, solved, strict=True) if of == side)
            if solution is None:
                continue
            found.rays[rows] = solution.points[:, :2] / solution.points[:, 2:]
            found.depths[rows] = solution.points[:, 2]
            found.across[rows], found.sigma[rows] = solution.sigma.T
            hidden = np.array(rows)[solution.hidden]
            found.optimised[hidden] = True
            found.measured[hidden] = np.nan


def _readings(arm: Arm, depths: FloatArray) -> Iterator[Arm]:
    """Give an arm by each surface around its elbow, that of `measured` first.

    Which is the elbow's is not told by where it was before alone: once another arm was taken for it, that
    would be expected again.
    """
    yield arm
    for depth in depths[np.isfinite(depths) & (depths != arm.measured[1])]:
        yield arm._replace(measured=np.array([arm.measured[0], depth, arm.measured[2]]))


def _likeliest(solutions: Iterable[ArmSolution | None]) -> ArmSolution | None:
    known = (solution for solution in solutions if solution is not None)
    return min(known, key=lambda solution: solution.cost, default=None)


def _part_across(forearm: FloatArray, depth: float, size: BodySize) -> float:
    """Part of a forearm's length, x/z, y/z of both ends, seen across the view; 1 if its depth is unknown."""
    seen = math.dist(*forearm) * depth / size.length("forearm")[0]
    return seen if math.isfinite(seen) else 1.0


def _reject_long_legs(depth: FloatArray, points: FloatArray, size: BodySize) -> None:
    """Set depths to NaN that make a thigh or shank much longer than estimated."""
    for hip, knee, ankle in _LEGS:
        for near, far, limb in ((hip, knee, "thigh"), (knee, ankle, "shank")):
            if size.too_long(limb, float(np.linalg.norm(points[far] - points[near]))):
                depth[far] = points[far] = np.nan
