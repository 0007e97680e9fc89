# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The types of messages that bags hold."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

_SKELETONS = (
    "teo_sign_msgs/msg/Keypoint3D",
    "teo_sign_msgs/msg/Skeleton3D",
    "teo_sign_msgs/msg/SkeletonArray",
)


@cache
def message_types() -> Typestore:
    """Give the types of messages of ROS 2 and that of the skeletons, for bags."""
    folder = Path(get_package_share_directory("teo_sign_msgs")) / "msg"
    store = get_typestore(Stores.ROS2_JAZZY)
    for name in _SKELETONS:
        text = (folder / f"{name.rpartition('/')[2]}.msg").read_text(encoding="utf-8")
        store.register(get_types_from_msg(text, name))
    return store
