"""A take as a ROS 2 bag: what the camera sends and where the keypoints truly are."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from rclpy.serialization import serialize_message

from teo_ros2cli.bags.metadata import TopicRecord
from teo_ros2cli.bags.qos_record import QosRecord
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.definitions.schema_text import schema_of
from teo_ros2cli.definitions.type_hash import installed_type_hash
from teo_ros2cli.errors import Ros2CliError
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take import take_messages
from teo_synthetic_signer.take.truth import TruthFrame

START = 1_700_000_000 * 10**9
"""Stamp of the first frame [ns since the epoch]: a fixed one, so that the same take gives the same bag."""

_INFO, _IMAGE, _COMPRESSED = (
    f"sensor_msgs/msg/{name}" for name in ("CameraInfo", "Image", "CompressedImage")
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
        frames: of the take; `SyntheticFrame` each if images are written.
        out: folder to make.
        raw: write images uncompressed: twenty times larger.
        truth_only: write no images, only the truth.
        quality: of JPEG, if not raw.
        about: what the bag's metadata say of it.

    Yields:
        The number of frames written so far.

    Raises:
        SyntheticError: the folder exists or cannot be made.
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
        writer = BagWriter(beside / out.name, preset="zstd_small", custom_data=about or {})
        for topic in topics:
            record = TopicRecord(topic.name, topic.type, installed_type_hash(topic.type), (QosRecord(),))
            writer.add_topic(record, schema_of(topic.type))
        for number, frame in enumerate(frames, start=1):
            time = START + round(frame.stamp * 1e9)
            at = take_messages.header(time)
            for topic in topics:
                writer.write(topic.name, time, time, serialize_message(topic.message(frame, at)))
            yield number
        writer.close()
        (beside / out.name).replace(out)
    except Ros2CliError as error:
        raise SyntheticError(error.code, str(error)) from error
    except OSError as error:
        raise SyntheticError("not_written", f"{out} cannot be written: {error}") from error
    finally:
        shutil.rmtree(beside, ignore_errors=True)
