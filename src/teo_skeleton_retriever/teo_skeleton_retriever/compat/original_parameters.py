"""The original's parameters with the defaults of its code."""

from __future__ import annotations

from dataclasses import dataclass, field

from teo_skeleton_retriever.compat.contour_dilation import ContourDilation


@dataclass(frozen=True, kw_only=True)
class OriginalParameters:
    """Named as in the original's configuration file, `group::name`.

    Attributes:
        keys_recognition_confidence: keypoints below it are not seen (skeleton::keys-recognition-confidence).
        keys_recognition_percentage: share of the 17 keypoints that a skeleton must have.
        keys_acceptable_misses: images for which a keypoint that is not seen is held.
        min_acceptable_path: length of the longest path through a skeleton [m].
        tracking_threshold: how far a pivot may move between images [px].
        time_to_live: how long a skeleton that is not seen is kept [s].
        depth_filter: depth::kernel-size, iterations, min-distance, max-distance; None for depth::enable off.
        filter_keypoint_order: past samples of the median of a keypoint.
        filter_limblength_order: past samples of the median of a limb's length.
        optimize_limblength: whether limbs are moved so that their lengths hold.
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
