# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A take as a ROS 2 bag: what the camera sends and where the keypoints truly are."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer, WriterError

from teo_skeleton_retriever.output.skeleton_bag import message_types
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take import take_messages
from teo_synthetic_signer.take.truth import TruthFrame

# Stamp of the first frame [ns since the epoch]: a fixed one, so that the same take gives the same bag.
START = 1_700_000_000 * 10**9

_INFO, _IMAGE, _COMPRESSED = (
    f"sensor_msgs/msg/{name}" for name in ("CameraInfo", "Image", "CompressedImage")
)


_INFINITE = QosTime(9223372036, 854775807)  # RMW_DURATION_INFINITE [s, ns]
# Of a default publisher, as rosbag2 records it.
_DEFAULT_QOS = Qos(
    history=QosHistory.KEEP_LAST,
    depth=10,
    reliability=QosReliability.RELIABLE,
    durability=QosDurability.VOLATILE,
    deadline=_INFINITE,
    lifespan=_INFINITE,
    liveliness=QosLiveliness.AUTOMATIC,
    liveliness_lease_duration=_INFINITE,
    avoid_ros_namespace_conventions=False,
)


class _Topic(NamedTuple):
    name: str
    type: str
    message: Any  # from a frame and a header to a message


_CAMERA_INFO = _Topic(
    "/camera/color/camera_info", _INFO, lambda frame, at: take_messages.camera_info(frame.camera, at)
)
_TRUTH = _Topic("/truth/skeletons", "teo_sign_msgs/msg/SkeletonArray", take_messages.truth_skeletons)
_RAW = (
    _Topic("/camera/color/image_raw", _IMAGE, take_messages.color_image),
    _Topic("/camera/aligned_depth_to_color/image_raw", _IMAGE, take_messages.depth_image),
)
_SMALL_COLOR = "/camera/color/image_raw/compressed"
_SMALL_DEPTH = "/camera/aligned_depth_to_color/image_raw/compressedDepth"


def write_take(
    frames: Iterable[TruthFrame],
    out: Path,
    *,
    raw: bool = False,
    truth_only: bool = False,
    quality: int = take_messages.JPEG_QUALITY,
    about: dict[str, str] | None = None,
) -> Iterator[int]:
    """Write frames to a bag while they come. The bag appears, whole, after the last.

    Args:
        frames: Of the take; `SyntheticFrame` each if images are written.
        out: Folder to make.
        raw: Write images uncompressed: twenty times larger.
        truth_only: Write no images, only the truth.
        quality: Of JPEG, if not raw.
        about: What the bag's metadata say of it.

    Yields:
        The number of frames written so far.

    Raises:
        SyntheticError: The folder exists or cannot be made.
    """
    if out.exists():
        raise SyntheticError("output_exists", f"expected a folder that does not exist yet, got {out}")
    if not out.parent.is_dir():
        raise SyntheticError("missing_folder", f"expected a folder for {out.name}, got {out.parent}")
    small = (
        _Topic(_SMALL_COLOR, _COMPRESSED, partial(take_messages.compressed_color, quality=quality)),
        _Topic(_SMALL_DEPTH, _COMPRESSED, take_messages.compressed_depth),
    )
    topics = (_TRUTH,) if truth_only else (_CAMERA_INFO, _TRUTH, *(_RAW if raw else small))
    beside = out.parent / f".{out.name}.{os.getpid()}"
    try:
        writer = Writer(beside / out.name, version=Writer.VERSION_LATEST, storage_plugin=StoragePlugin.MCAP)
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        for key, value in (about or {}).items():
            writer.set_custom_data(key, value)
        types = message_types()
        with writer:
            connections = [
                writer.add_connection(
                    topic.name, topic.type, typestore=types, offered_qos_profiles=[_DEFAULT_QOS]
                )
                for topic in topics
            ]
            for number, frame in enumerate(frames, start=1):
                time = START + round(frame.stamp * 1e9)
                at = take_messages.header(time)
                for topic, connection in zip(topics, connections, strict=True):
                    message = topic.message(frame, at)
                    writer.write(connection, time, types.serialize_cdr(message, topic.type))
                yield number
        (beside / out.name).replace(out)
    except (OSError, WriterError) as error:
        raise SyntheticError("not_written", f"{out} cannot be written: {error}") from error
    finally:
        shutil.rmtree(beside, ignore_errors=True)
