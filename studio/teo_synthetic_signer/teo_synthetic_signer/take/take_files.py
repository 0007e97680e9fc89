# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Files of a take: a ROS 2 bag with images and the true keypoints, or a film of the images."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
from builtin_interfaces.msg import Time
from numpy.typing import NDArray
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer, WriterError
from std_msgs.msg import Header
from teo_sign_msgs.msg import SkeletonArray

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.bags.bag_reader import message_types
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.skeleton_3d import Keypoints3D, KeypointStatus, Skeleton, body_frame
from teo_skeleton_retriever.output.messages import skeleton_array
from teo_skeleton_retriever.output.overlay import overlay_video
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take.take import SyntheticFrame, Truth, TruthFrame

# As realsense2_camera names it.
FRAME_ID = "camera_color_optical_frame"
# image_transport has 95; at 90 nobody sees a difference, and a bag is a third smaller.
JPEG_QUALITY = 90
_PNG_EFFORT = 7  # 9 takes eight times as long for 5 % less
_DEPTH_HEADER = np.zeros(12, dtype=np.uint8)  # of compressedDepth; its terms matter to floats alone
_NANOSECONDS = 1_000_000_000


def _header(time: int) -> Header:
    return Header(stamp=Time(sec=time // _NANOSECONDS, nanosec=time % _NANOSECONDS), frame_id=FRAME_ID)


def _camera_info(camera: CameraModel, at: Header) -> Any:
    k = [camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0]
    p = [camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0]
    region = _message("RegionOfInterest", x_offset=0, y_offset=0, height=0, width=0, do_rectify=False)
    return _message(
        "CameraInfo",
        header=at,
        width=camera.width,
        height=camera.height,
        distortion_model="plumb_bob",
        d=np.zeros(5),
        k=np.array(k),
        r=np.eye(3).ravel(),
        p=np.array(p),
        binning_x=0,
        binning_y=0,
        roi=region,
    )


def _color_image(frame: SyntheticFrame, at: Header) -> Any:
    return _image(frame.color, "rgb8", at)


def _depth_image(frame: SyntheticFrame, at: Header) -> Any:
    return _image(_millimetres(frame), "16UC1", at)


def _compressed_color(frame: SyntheticFrame, at: Header, quality: int = JPEG_QUALITY) -> Any:
    """The colour image as image_transport's `compressed` sends it: JPEG, of a quality of 1 to 100."""
    data = _encoded(".jpg", frame.color[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])
    return _message("CompressedImage", header=at, format="rgb8; jpeg compressed bgr8", data=data)


def _compressed_depth(frame: SyntheticFrame, at: Header) -> Any:
    """The depth image as image_transport's `compressedDepth` sends it: PNG behind 12 bytes."""
    png = _encoded(".png", _millimetres(frame), [cv2.IMWRITE_PNG_COMPRESSION, _PNG_EFFORT])
    data = np.concatenate([_DEPTH_HEADER, png])
    return _message("CompressedImage", header=at, format="16UC1; compressedDepth png", data=data)


def _truth_skeletons(frame: TruthFrame, at: Header) -> SkeletonArray:
    """The truth: joint centres, status MEASURED where the camera sees them and HELD where not.

    The signer has the id 0, companions those that follow.
    """
    people = (frame.truth, *frame.others)
    return skeleton_array([_skeleton(truth, i, frame.camera) for i, truth in enumerate(people)], at)


def _skeleton(truth: Truth, track_id: int, camera: CameraModel) -> Skeleton:
    joints = {name: truth.body[i] for name, i in BODY_25.index.items()}
    return Skeleton(
        track_id=track_id,
        is_signer=track_id == 0,
        body=_known(truth.body, truth.body_visible, camera),
        left_hand=_known(truth.left_hand, truth.left_hand_visible, camera),
        right_hand=_known(truth.right_hand, truth.right_hand_visible, camera),
        face=_known(truth.face, truth.face_visible, camera),
        body_frame=body_frame(
            left_shoulder=joints["LShoulder"],
            right_shoulder=joints["RShoulder"],
            left_hip=joints["LHip"],
            right_hip=joints["RHip"],
        ),
    )


def _known(points: FloatArray, visible: BoolArray, camera: CameraModel) -> Keypoints3D:
    return Keypoints3D(
        points=points,
        confidence=np.ones(len(points)),
        status=np.where(visible, KeypointStatus.MEASURED, KeypointStatus.HELD).astype(np.uint8),
        sigma=np.zeros((len(points), 3)),
        pixels=camera.project(points),
    )


def _millimetres(frame: SyntheticFrame) -> NDArray[np.uint16]:
    steps = np.nan_to_num(np.rint(frame.depth * 1000.0), nan=0.0, posinf=0.0)
    return np.where(steps < 65536.0, steps, 0.0).astype(np.uint16)


def _image(pixels: NDArray[Any], encoding: str, at: Header) -> Any:
    height, width = pixels.shape[:2]
    data = np.ascontiguousarray(pixels)
    return _message(
        "Image",
        header=at,
        width=width,
        height=height,
        encoding=encoding,
        is_bigendian=0,
        step=data.strides[0],
        data=data.view(np.uint8).ravel(),
    )


def _message(kind: str, **fields: Any) -> Any:
    return message_types().types[f"sensor_msgs/msg/{kind}"](**fields)


def _encoded(kind: str, pixels: NDArray[Any], options: list[int]) -> NDArray[np.uint8]:
    done, data = cv2.imencode(kind, pixels, options)
    if not done:
        raise SyntheticError("not_encoded", f"OpenCV could not write a {kind} of shape {pixels.shape}")
    return np.asarray(data, dtype=np.uint8).ravel()


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


_CAMERA_INFO = _Topic("/camera/color/camera_info", _INFO, lambda frame, at: _camera_info(frame.camera, at))
_TRUTH = _Topic("/truth/skeletons", "teo_sign_msgs/msg/SkeletonArray", _truth_skeletons)
_RAW = (
    _Topic("/camera/color/image_raw", _IMAGE, _color_image),
    _Topic("/camera/aligned_depth_to_color/image_raw", _IMAGE, _depth_image),
)
_SMALL_COLOR = "/camera/color/image_raw/compressed"
_SMALL_DEPTH = "/camera/aligned_depth_to_color/image_raw/compressedDepth"


def write_take(
    frames: Iterable[TruthFrame],
    out: Path,
    *,
    raw: bool = False,
    truth_only: bool = False,
    quality: int = JPEG_QUALITY,
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
        _Topic(_SMALL_COLOR, _COMPRESSED, partial(_compressed_color, quality=quality)),
        _Topic(_SMALL_DEPTH, _COMPRESSED, _compressed_depth),
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
                at = _header(time)
                for topic, connection in zip(topics, connections, strict=True):
                    message = topic.message(frame, at)
                    writer.write(connection, time, types.serialize_cdr(message, topic.type))
                yield number
        (beside / out.name).replace(out)
    except (OSError, WriterError) as error:
        raise SyntheticError("not_written", f"{out} cannot be written: {error}") from error
    finally:
        shutil.rmtree(beside, ignore_errors=True)


FILM_SUFFIX = ".mp4"


def write_film(frames: Iterable[SyntheticFrame], out: Path) -> Iterator[int]:
    """Write the colour images of frames as a film, such as a phone or a webcam records.

    Args:
        frames: In order of time.
        out: MP4 file to write, replaced if it exists; it appears whole or not at all.

    Yields:
        The number of frames written so far.

    Raises:
        SyntheticError: "not_written" if there is no such folder.
    """
    try:
        with overlay_video(out) as film:
            for number, frame in enumerate(frames, start=1):
                film.add(frame.color, frame.stamp)
                yield number
    except (RetrieverError, OSError) as error:
        raise SyntheticError(
            "not_written", f"{out}: expected a place to write a film to, got: {error}"
        ) from None
