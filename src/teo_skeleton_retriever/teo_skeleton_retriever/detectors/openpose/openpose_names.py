"""The keys of the files that OpenPose's `--write_json` writes, in all its versions.

Versions 0.1 (body), 1.0 (face and hands), 1.1 (candidates), 1.2 (3D), 1.3 (person_id). The oldest releases
called the two-dimensional arrays by the bare name, without `_2d`; so do many tools that imitate them.
"""

from __future__ import annotations

from typing import NamedTuple

VERSION = 1.3
"""The version that is written."""
VERSIONS = (0.1, 1.0, 1.1, 1.2, 1.3)
"""The versions that are read."""


class PartKeys(NamedTuple):
    """Where one part of a person stands in the file."""

    attribute: str
    """of `Person2D`"""
    keys: tuple[str, ...]
    """in the file; the first is the present one"""
    columns: int
    """numbers per keypoint"""


PARTS = (
    PartKeys("body", ("pose_keypoints_2d", "pose_keypoints", "body_parts"), 3),
    PartKeys("face", ("face_keypoints_2d", "face_keypoints"), 3),
    PartKeys("left_hand", ("hand_left_keypoints_2d", "hand_left_keypoints"), 3),
    PartKeys("right_hand", ("hand_right_keypoints_2d", "hand_right_keypoints"), 3),
    PartKeys("body_3d", ("pose_keypoints_3d",), 4),
    PartKeys("face_3d", ("face_keypoints_3d",), 4),
    PartKeys("left_hand_3d", ("hand_left_keypoints_3d",), 4),
    PartKeys("right_hand_3d", ("hand_right_keypoints_3d",), 4),
)
"""In the order in which OpenPose writes them."""
