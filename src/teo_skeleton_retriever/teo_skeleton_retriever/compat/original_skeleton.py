# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The original's skeleton of one image: parameters, depth filter and 17 keypoints ("SkeletonStd").

Source: robotology/assistive-rehab, library `skeleton` and module `skeletonRetriever` (BSD-3-Clause).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18, Layout
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25


@dataclass(frozen=True, kw_only=True)
class ContourDilation:
    """Minimum filter over depth (morphological erosion): near surfaces grow, holes are filled.

    The defaults are those in the code of the original (its shipped configurations: 8 px twice at 0.6 to 5 m,
    off; 24 px twelve times at 1 to 6 m). It moves depth towards the camera by what the surface falls off in
    `kernel_size * iterations / 2` pixels.

    Attributes:
        kernel_size: Diameter of the elliptical window [px]. An even one reaches further to the left and up.
        iterations: How often the window is applied.
        min_distance: Nearer is taken as noise and does not grow [m].
        max_distance: Farther is taken as background and becomes unknown [m].

    Raises:
        RetrieverError: A value makes no filter.
    """

    kernel_size: int = 4
    iterations: int = 3
    min_distance: float = 1.0
    max_distance: float = 4.0

    def __post_init__(self) -> None:
        if self.kernel_size < 1 or self.iterations < 0:
            raise RetrieverError(
                "bad_kernel",
                f"expected a kernel >= 1 px, iterations >= 0, got {self.kernel_size}, {self.iterations}",
            )
        if not (math.isfinite(self.min_distance) and 0.0 <= self.min_distance < self.max_distance):
            raise RetrieverError(
                "bad_range",
                f"expected 0 <= min_distance < max_distance, got {self.min_distance}, {self.max_distance}",
            )

    def apply(self, depth: DepthArray) -> DepthArray:
        """Filter one image.

        Args:
            depth: [m], NaN or 0 where unknown. Shape (height, width).

        Returns:
            [m], NaN where unknown. Shape (height, width).
        """
        far = np.float32(np.finfo(np.float32).max)
        with np.errstate(invalid="ignore"):
            known = np.where(depth >= np.float32(self.min_distance), depth, far).astype(np.float32)
        if self.iterations and known.size:
            window = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (self.kernel_size, self.kernel_size))
            known = cv2.erode(known, window, iterations=self.iterations).astype(np.float32)
        known[~(known <= np.float32(self.max_distance))] = np.nan
        known[known <= 0.0] = np.nan
        return known


@dataclass(frozen=True, kw_only=True)
class OriginalParameters:
    """Named as in the original's configuration file, `group::name`.

    Attributes:
        keys_recognition_confidence: Keypoints below it are not seen (skeleton::keys-recognition-confidence).
        keys_recognition_percentage: Share of the 17 keypoints that a skeleton must have.
        keys_acceptable_misses: Images for which a keypoint that is not seen is held.
        min_acceptable_path: Length of the longest path through a skeleton [m].
        tracking_threshold: How far a pivot may move between images [px].
        time_to_live: How long a skeleton that is not seen is kept [s].
        depth_filter: By depth::kernel-size, depth::iterations, depth::min-distance and depth::max-distance;
            None for depth::enable off.
        filter_keypoint_order: Past samples of the median of a keypoint.
        filter_limblength_order: Past samples of the median of a limb's length.
        optimize_limblength: Whether limbs are moved so that their lengths hold.
    """

    keys_recognition_confidence: float = 0.3
    keys_recognition_percentage: float = 0.3
    keys_acceptable_misses: int = 5
    min_acceptable_path: float = 0.5
    tracking_threshold: float = 50.0
    time_to_live: float = 1.0
    depth_filter: ContourDilation | None = field(default_factory=ContourDilation)
    filter_keypoint_order: int = 3
    filter_limblength_order: int = 40
    optimize_limblength: bool = True


# The parent of each keypoint, in the order of the data.
PARENTS: dict[str, str | None] = {
    "shoulderCenter": None,
    "head": "shoulderCenter",
    "shoulderLeft": "shoulderCenter",
    "elbowLeft": "shoulderLeft",
    "handLeft": "elbowLeft",
    "shoulderRight": "shoulderCenter",
    "elbowRight": "shoulderRight",
    "handRight": "elbowRight",
    "hipCenter": "shoulderCenter",
    "hipLeft": "hipCenter",
    "kneeLeft": "hipLeft",
    "ankleLeft": "kneeLeft",
    "footLeft": "ankleLeft",
    "hipRight": "hipCenter",
    "kneeRight": "hipRight",
    "ankleRight": "kneeRight",
    "footRight": "ankleRight",
}

SKELETON_STD = Layout(
    "SkeletonStd",
    tuple(PARENTS),
    tuple((parent, child) for child, parent in PARENTS.items() if parent is not None),
)

FROM_BODY_25: dict[str, str] = {"Nose": "head", "Neck": "shoulderCenter", "MidHip": "hipCenter"} | {
    f"{side[0]}{joint}": f"{tag}{side}"
    for side in ("Right", "Left")
    for joint, tag in (
        *(("Shoulder", "shoulder"), ("Elbow", "elbow"), ("Wrist", "hand")),
        *(("Hip", "hip"), ("Knee", "knee"), ("Ankle", "ankle"), ("BigToe", "foot")),
    )
}

# What stands in where the keypoint of `FROM_BODY_25` was not seen.
_FALLBACKS: dict[str, str] = {"footLeft": "LSmallToe", "footRight": "RSmallToe"}

# Where a centre was not seen itself, it is put between these two, without a pixel.
_MIDPOINTS: dict[str, tuple[str, str]] = {
    "shoulderCenter": ("shoulderLeft", "shoulderRight"),
    "hipCenter": ("hipLeft", "hipRight"),
}

# People are told apart by the pixels of these; a skeleton with neither is refused.
_PIVOTS = ("shoulderCenter", "hipCenter")

# Chains whose depths are optimised together.
CHAINS: tuple[tuple[str, ...], ...] = (
    ("shoulderLeft", "elbowLeft", "handLeft"),
    ("shoulderRight", "elbowRight", "handRight"),
    ("hipLeft", "kneeLeft", "ankleLeft", "footLeft"),
    ("hipRight", "kneeRight", "ankleRight", "footRight"),
)
# Limbs whose length is calibrated, each named by its far end.
LIMBS = tuple(tag for chain in CHAINS for tag in chain[1:])


class BodyPlanes(NamedTuple):
    """Normals of the planes; NaN while their keypoints were never seen. Shape (3,) each."""

    sagittal: FloatArray
    """unit, from the right shoulder to the left"""
    transverse: FloatArray
    """unit, from the centre of the hips to that of the shoulders"""
    coronal: FloatArray
    """sagittal x transverse, out of the chest; as long as the sine between the two, as in the original"""


_UNKNOWN_PLANES = BodyPlanes(*(np.full(3, np.nan) for _ in range(3)))


def body_planes(
    *,
    left_shoulder: FloatArray,
    right_shoulder: FloatArray,
    shoulder_center: FloatArray,
    hip_center: FloatArray,
    before: BodyPlanes = _UNKNOWN_PLANES,
) -> BodyPlanes:
    """Find the planes of a body.

    Args:
        left_shoulder: [m]; not finite if not seen. Shape (3,), as the others.
        right_shoulder: Likewise.
        shoulder_center: Likewise.
        hip_center: Likewise.
        before: What a normal stays at while its keypoints are not seen, or are in one place.
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


_N = len(SKELETON_STD)
_PARENT = [None if parent is None else SKELETON_STD.index[parent] for parent in PARENTS.values()]
_NEIGHBOURS = [[k for k in range(_N) if _PARENT[k] == i or _PARENT[i] == k] for i in range(_N)]


@dataclass(eq=False)
class OriginalSkeleton:
    """The 17 keypoints, in the order of `SKELETON_STD`. A stale keypoint keeps its last place.

    Attributes:
        points: [m], NaN if never seen. Shape (17, 3).
        pixels: [px], NaN if never seen or made from two others. Shape (17, 2).
        updated: Whether each is of this image (or held). Shape (17,).
        planes: Of the body.
    """

    points: FloatArray = field(default_factory=lambda: np.full((_N, 3), np.nan))
    pixels: FloatArray = field(default_factory=lambda: np.full((_N, 2), np.nan))
    updated: BoolArray = field(default_factory=lambda: np.zeros(_N, dtype=bool))
    planes: BodyPlanes = _UNKNOWN_PLANES

    def copy(self) -> OriginalSkeleton:
        """Give a skeleton that does not change with this one."""
        return OriginalSkeleton(self.points.copy(), self.pixels.copy(), self.updated.copy(), self.planes)

    def pivots(self) -> FloatArray:
        """Pixels of `_PIVOTS`, by which people are told apart; infinite if not updated. Shape (2, 2)."""
        rows = [SKELETON_STD.index[name] for name in _PIVOTS]
        seen = self.updated[rows, None] & np.isfinite(self.pixels[rows])
        pixels: FloatArray = np.where(seen, self.pixels[rows], np.inf)
        return pixels

    def max_path(self) -> float:
        """Length of the longest path through updated keypoints [m]."""
        return max((self._longest_from(i, None) for i in range(_N) if self.updated[i]), default=0.0)

    def _longest_from(self, i: int, came_from: int | None) -> float:
        longest = 0.0
        for k in _NEIGHBOURS[i]:
            if k != came_from and self.updated[k]:
                bone = float(np.linalg.norm(self.points[k] - self.points[i]))
                longest = max(longest, bone + self._longest_from(k, i))
        return longest


def detect(
    person: Person2D, depth: DepthArray, camera: CameraModel, parameters: OriginalParameters
) -> OriginalSkeleton:
    """Look up the depth of each keypoint, at one pixel, and put it in space.

    Args:
        person: With a body in BODY_25 or COCO; one without a body gives a skeleton without keypoints.
        depth: Filtered [m], NaN where unknown. Shape (height, width).
        camera: `CameraModel.from_field_of_view` for what the original assumes.
        parameters: Of the original.

    Raises:
        RetrieverError: The body is in a layout that the original does not know.
    """
    skeleton = OriginalSkeleton()
    if not len(person.body):
        return skeleton
    body = _body_25(person.body)
    pixels, points = _in_space(body, depth, camera, parameters.keys_recognition_confidence)
    sources = {tag: [name] for name, tag in FROM_BODY_25.items()}
    for tag, name in _FALLBACKS.items():
        sources[tag].append(name)
    for tag, names in sources.items():
        for name in names:
            row = BODY_25.index[name]
            if np.isfinite(points[row]).all():
                _put(skeleton, tag, points[row], pixels[row])
                break
    for tag, (left, right) in _MIDPOINTS.items():
        pair = [SKELETON_STD.index[left], SKELETON_STD.index[right]]
        if not skeleton.updated[SKELETON_STD.index[tag]] and skeleton.updated[pair].all():
            _put(skeleton, tag, skeleton.points[pair].mean(axis=0), np.full(2, np.nan))
    return skeleton


def is_valid(skeleton: OriginalSkeleton, parameters: OriginalParameters) -> bool:
    """Tell whether the original takes this for a person."""
    return bool(
        np.isfinite(skeleton.pivots()).any()
        and skeleton.updated.mean() >= parameters.keys_recognition_percentage
        and skeleton.max_path() >= parameters.min_acceptable_path
    )


def _body_25(body: FloatArray) -> FloatArray:
    if len(body) == len(BODY_25):
        return body
    if len(body) == len(COCO_18):
        converted = as_body_25(body)
        # The original knows no mid-hip in COCO: the centre comes from the hips in space, without a pixel.
        converted[BODY_25.index["MidHip"]] = 0.0
        return converted
    raise RetrieverError("wrong_layout", f"expected a body in BODY_25 or COCO, got {len(body)} keypoints")


def _in_space(
    body: FloatArray, depth: DepthArray, camera: CameraModel, confidence: float
) -> tuple[FloatArray, FloatArray]:
    """Give whole pixels and points, NaN where a keypoint is not seen. Shapes (25, 2), (25, 3)."""
    height, width = depth.shape
    pixels = np.trunc(body[:, :2])
    columns, rows = pixels.T
    inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
    seen = inside & (body[:, 2] >= confidence)
    depths = np.full(len(body), np.nan)
    depths[seen] = depth[rows[seen].astype(int), columns[seen].astype(int)]
    return pixels, camera.unproject(pixels, depths)


def _put(skeleton: OriginalSkeleton, tag: str, point: FloatArray, pixel: FloatArray) -> None:
    row = SKELETON_STD.index[tag]
    skeleton.points[row], skeleton.pixels[row], skeleton.updated[row] = point, pixel, True
