# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bags of the take, written by a library that the code under test does not write with."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import camera_take as take
from openpose_writer import frame_path, write_frame
from rclpy.serialization import serialize_message
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Ros2Writer
from rosbags.typesys import Stores, get_typestore

COLOR, DEPTH = "/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw"
INFO = "/camera/color/camera_info"
IMAGE, COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
Stored = tuple[str, str, int, Any]  # topic, type, time [ns], message


def messages(images: int, *, compressed: bool = False) -> Iterator[Stored]:
    for i in range(images):
        stamp = take.START + i * take.PERIOD
        yield INFO, CAMERA_INFO, stamp, take.camera_info(stamp)
        if compressed:
            yield f"{COLOR}/compressed", COMPRESSED, stamp, take.compressed_color(stamp)
            yield f"{DEPTH}/compressedDepth", COMPRESSED, stamp, take.compressed_depth(stamp)
        else:
            yield COLOR, IMAGE, stamp, take.color_message(stamp)
            yield DEPTH, IMAGE, stamp, take.depth_message(stamp)


def write_ros2(path: Path, stored: Sequence[Stored], storage: StoragePlugin = StoragePlugin.MCAP) -> Path:
    store = get_typestore(Stores.ROS2_JAZZY)
    with Ros2Writer(path, version=9, storage_plugin=storage) as writer:
        connections: dict[str, Any] = {}
        for topic, kind, time, message in stored:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=store)
            writer.write(connections[topic], time, bytes(serialize_message(message)))
    return path


def write_ros1(path: Path, stored: Sequence[Stored], *, packed: bool = False) -> Path:
    ros1, ros2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_JAZZY)
    writer = Ros1Writer(path)
    if packed:
        writer.set_compression(Ros1Writer.CompressionFormat.BZ2)
    with writer:
        connections: dict[str, Any] = {}
        for topic, kind, time, message in stored:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=ros1)
            writer.write(connections[topic], time, bytes(ros2.cdr_to_ros1(serialize_message(message), kind)))
    return path


def write_keypoints(folder: Path, images: int) -> Path:
    """What OpenPose would have seen in each image."""
    folder.mkdir()
    for i in range(images):
        write_frame(frame_path(folder, f"{i:012d}"), (take.person(),))
    return folder


def cut(path: Path, share: float) -> Path:
    """The front of a file, as a full disk leaves it."""
    data = path.read_bytes()
    shorter = path.with_name(f"cut{path.suffix}")
    shorter.write_bytes(data[: round(len(data) * share)])
    return shorter
