"""The depths of a hand's 21 keypoints, from what is measured of them and the hand's own shape.

Every keypoint lies on its viewing ray; its depth minimises the sum of
- its misfit to the measured surface (robust: fingers hide each other, pixels beside a finger see the chest),
- the misfit of each bone to its length, which grows with the person,
- the misfit of each bone's step in depth to the shape that the detector imagines (MediaPipe's world
  landmarks), scaled to the hand,
- the misfit of the whole to where the wrist is by the arm, which counts where nothing is measured.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.depth_lookup import Surfaces
from teo_skeleton_retriever.hand_21 import HAND_21
from teo_skeleton_retriever.skin import HAND_DEPTHS

N = len(HAND_21)
PARENTS = np.array([-1, *(0 if i % 4 == 1 else i - 1 for i in range(1, N))])
"""The keypoint at the other end of each one's bone; -1 for the wrist."""
BONES = np.array(
    [
        0.0,
        *(0.040, 0.042, 0.032, 0.026),  # thumb
        *(0.091, 0.041, 0.025, 0.020),
        *(0.088, 0.045, 0.028, 0.021),
        *(0.082, 0.042, 0.027, 0.021),
        *(0.078, 0.033, 0.020, 0.018),
    ]
)
"""[m] Length of the bone that ends at each keypoint, of an average adult, tips at the pads' centres.
Source: phalanges after Buryanov and Kotiuk, "Proportions of Hand Segments" (2010), the tips less 4 mm."""

_BONE_SIGMA = 0.006  # [m] people's proportions differ, and a pixel is 2 to 3 mm
_SHAPE_SIGMA = 0.012  # [m] the detector's imagination of a bone's step in depth
_FLAT_SIGMA = 0.03  # [m] without it: a hand is about across the view
_DATA_SIGMA = 0.006  # [m] how far the skin of a finger differs from a tube
_OUTLIER = 0.02  # [m] beyond it a measured surface is another's: two fingers' thickness
_NARROWING = (0.12, 0.06, 0.03, 0.02, 0.02)
"""[m] The same, from step to step of the solution: from half a hand, so that a shape imagined wrongly is put
right by what is measured before that is judged (graduated non-convexity, Blake and Zisserman 1987)."""
_ANCHOR_SIGMA = 0.03  # [m]


class HandFit(NamedTuple):
    """The depths of a hand."""

    depths: FloatArray
    """[m]. Shape (21,)"""
    sigma: FloatArray
    """standard deviations [m]. Shape (21,)"""
    measured: BoolArray
    """keypoints whose own surface was measured; the others follow from the shape. Shape (21,)"""


def fit_hand(
    rays: FloatArray,
    surfaces: Surfaces,
    *,
    scale: float,
    world: FloatArray | None,
    expected: float,
    wrist: float,
) -> HandFit | None:
    """Find the depths of a hand.

    Args:
        rays: x/z, y/z; NaN where the detector did not see the keypoint. Shape (21, 2).
        surfaces: measured around each keypoint.
        scale: of the person against an average adult.
        world: what the detector imagines of the shape [m]. Shape (21, 3), or None.
        expected: depth of the hand by the images before [m]; NaN if there were none.
        wrist: depth of the wrist's joint by the arm [m]; NaN if not known.

    Returns:
        None if too little is seen to tell anything.
    """
    seen: BoolArray = np.asarray(np.isfinite(rays).all(axis=1))
    if seen.sum() < N // 2:
        return None
    radius = HAND_DEPTHS * scale
    steps, step_sigma = _steps(rays, world, scale)
    offsets = _accumulate(steps)
    centre = _centre(surfaces, radius, offsets, expected if np.isfinite(expected) else wrist)
    if not np.isfinite(centre):
        return None
    depths = centre + offsets
    anchor = wrist if np.isfinite(wrist) else centre
    data = Surfaces(*(array[seen] for array in surfaces))
    normal = np.zeros((N, N))
    weights = np.zeros(N)
    for outlier in _NARROWING:
        chosen = data.closest((depths - radius)[seen])
        target = np.full(N, np.nan)
        sigma = np.full(N, np.inf)
        target[seen] = chosen.depth + radius[seen]
        sigma[seen] = np.hypot(chosen.sigma, _DATA_SIGMA)
        residual = np.nan_to_num(target - depths)
        weights = np.where(np.isfinite(target), 1.0 / sigma**2 / (1.0 + (residual / outlier) ** 2) ** 2, 0.0)
        normal, right = _normal_equations(depths, rays, steps, step_sigma, scale, seen)
        normal[np.diag_indices(N)] += weights
        right += weights * residual
        normal[0, 0] += 1.0 / _ANCHOR_SIGMA**2
        right[0] += (anchor - depths[0]) / _ANCHOR_SIGMA**2
        depths = depths + np.linalg.solve(normal, right)
    spread = np.sqrt(np.diag(np.linalg.inv(normal)))
    believed = weights * _DATA_SIGMA**2 > 0.1
    return HandFit(depths, spread, believed)


def _steps(rays: FloatArray, world: FloatArray | None, scale: float) -> tuple[FloatArray, FloatArray]:
    """Give the step in depth along each bone by the imagined shape, and its sigma [m]. Shapes (21,)."""
    if world is None:
        return np.zeros(N), np.full(N, _FLAT_SIGMA)
    bones = world[1:] - world[PARENTS[1:]]
    lengths = np.linalg.norm(bones, axis=1)
    size = scale * float(BONES[1:].sum()) / max(float(lengths.sum()), 1e-6)
    # The detector sees a crop around the hand as if the camera looked straight at it.
    centre = np.append(np.nanmean(rays, axis=0), 1.0)
    turned = bones @ _towards(centre / np.linalg.norm(centre)).T
    return np.append(0.0, size * turned[:, 2]), np.full(N, _SHAPE_SIGMA)


def _towards(direction: FloatArray) -> FloatArray:
    """Give the shortest rotation that brings the optical axis to a direction (Rodrigues). Shape (3, 3)."""
    x, y, z = direction
    return np.array(
        [
            [1.0 - x * x / (1.0 + z), -x * y / (1.0 + z), x],
            [-x * y / (1.0 + z), 1.0 - y * y / (1.0 + z), y],
            [-x, -y, z],
        ]
    )


def _accumulate(steps: FloatArray) -> FloatArray:
    """Sum steps from the wrist outwards. Shape (21,)."""
    fingers = np.cumsum(steps[1:].reshape(5, 4), axis=1)
    return np.append(0.0, fingers.ravel())


def _centre(surfaces: Surfaces, radius: FloatArray, offsets: FloatArray, expected: float) -> float:
    """Give the depth of the wrist that most measured keypoints agree on [m]; NaN if none is measured."""
    votes = (surfaces.depth + (radius - offsets)[:, None]).ravel()
    votes = votes[np.isfinite(votes)]
    if not len(votes):
        return float(expected)
    agreeing = (np.abs(votes[:, None] - votes[None, :]) < _OUTLIER).sum(axis=1)
    if np.isfinite(expected):
        # Two surfaces that are as large: the one where the hand is thought to be.
        agreeing = agreeing * np.exp(-0.5 * ((votes - expected) / 0.15) ** 2)
    best = votes[np.argmax(agreeing)]
    return float(np.median(votes[np.abs(votes - best) < _OUTLIER]))


def _normal_equations(
    depths: FloatArray,
    rays: FloatArray,
    steps: FloatArray,
    step_sigma: FloatArray,
    scale: float,
    seen: BoolArray,
) -> tuple[FloatArray, FloatArray]:
    """Give matrix and right side of a Gauss-Newton step for bones and shape. Shapes (21, 21), (21,)."""
    child, parent = np.arange(1, N), PARENTS[1:]
    directions = np.column_stack([np.nan_to_num(rays), np.ones(N)])
    bones = directions[child] * depths[child, None] - directions[parent] * depths[parent, None]
    lengths = np.sqrt((bones**2).sum(axis=1)) + 1e-9
    both = seen[child] & seen[parent]
    misfit = lengths - scale * BONES[1:]
    weight = np.where(both, 1.0 / _BONE_SIGMA**2, 0.0)
    by_child = (bones * directions[child]).sum(axis=1) / lengths
    by_parent = -(bones * directions[parent]).sum(axis=1) / lengths
    jump = depths[child] - depths[parent] - steps[1:]
    shape = 1.0 / step_sigma[1:] ** 2
    normal = np.zeros((N, N))
    normal[child, child] += weight * by_child**2 + shape
    np.add.at(normal, (parent, parent), weight * by_parent**2 + shape)
    cross = weight * by_child * by_parent - shape
    normal[child, parent] += cross
    normal[parent, child] += cross
    right = np.zeros(N)
    right[child] -= weight * misfit * by_child + shape * jump
    np.add.at(right, parent, -weight * misfit * by_parent + shape * jump)
    return normal, right
