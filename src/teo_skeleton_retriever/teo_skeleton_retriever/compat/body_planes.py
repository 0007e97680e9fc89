"""The planes of a body, as the original gives them: unit normals and one that is nearly so."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray


class BodyPlanes(NamedTuple):
    """Normals of the planes; NaN while their keypoints were never seen. Shape (3,) each."""

    sagittal: FloatArray
    """unit, from the right shoulder to the left"""
    transverse: FloatArray
    """unit, from the centre of the hips to that of the shoulders"""
    coronal: FloatArray
    """sagittal x transverse, out of the chest; as long as the sine between the two, as in the original"""


UNKNOWN_PLANES = BodyPlanes(*(np.full(3, np.nan) for _ in range(3)))


def body_planes(
    *,
    left_shoulder: FloatArray,
    right_shoulder: FloatArray,
    shoulder_center: FloatArray,
    hip_center: FloatArray,
    before: BodyPlanes = UNKNOWN_PLANES,
) -> BodyPlanes:
    """Find the planes of a body.

    Args:
        left_shoulder: [m]; not finite if not seen. Shape (3,), as the others.
        right_shoulder: likewise.
        shoulder_center: likewise.
        hip_center: likewise.
        before: what a normal stays at while its keypoints are not seen, or are in one place.
    """
    sagittal = _direction(right_shoulder, left_shoulder)
    transverse = _direction(hip_center, shoulder_center)
    side = before.sagittal if sagittal is None else sagittal
    up = before.transverse if transverse is None else transverse
    front = before.coronal if sagittal is None and transverse is None else np.cross(side, up)
    return BodyPlanes(side, up, front)


def _direction(start: FloatArray, end: FloatArray) -> FloatArray | None:
    step = np.asarray(end, dtype=np.float64) - np.asarray(start, dtype=np.float64)
    length = float(np.linalg.norm(step))
    return step / length if np.isfinite(length) and length > 0.0 else None
