# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Skeletons and pictures as messages."""

from __future__ import annotations

import math
from array import array
from collections.abc import Sequence

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion
from sensor_msgs.msg import Image
from std_msgs.msg import Header
from teo_sign_msgs.msg import Keypoint3D, Skeleton3D, SkeletonArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.camera.raw_image import ColorArray
from teo_skeleton_retriever.layouts.skeleton_3d import SKELETON_PARTS, BodyFrame, Keypoints3D, Skeleton


def skeleton_array(skeletons: Sequence[Skeleton], header: Header) -> SkeletonArray:
    """Everybody seen in one image, as a message.

    Args:
        skeletons: Of the image.
        header: Of the image: its stamp, and the camera's optical frame.
    """
    return SkeletonArray(header=header, skeletons=[_message(skeleton) for skeleton in skeletons])


def image_message(picture: ColorArray, header: Header) -> Image:
    """A picture, RGB of shape (height, width, 3), as a message."""
    height, width = picture.shape[:2]
    return Image(
        header=header,
        height=height,
        width=width,
        encoding="rgb8",
        step=3 * width,
        data=array("B", picture.tobytes()),
    )


def _message(skeleton: Skeleton) -> Skeleton3D:
    message = Skeleton3D(id=skeleton.track_id, is_signer=skeleton.is_signer)
    for part, layout in SKELETON_PARTS.items():
        setattr(message, part, _keypoint_messages(getattr(skeleton, part), layout.keypoints))
    message.body_frame, message.body_frame_origin = _pose(skeleton.body_frame)
    return message


def _keypoint_messages(keypoints: Keypoints3D, names: Sequence[str]) -> list[Keypoint3D]:
    if not keypoints.status.any():
        return []
    # Plain numbers for all at once: item by item NumPy would take longer than the rest.
    points = keypoints.points.tolist()
    confidences, statuses = keypoints.confidence.tolist(), keypoints.status.tolist()
    sigmas, pixels = keypoints.sigma.astype(np.float32), keypoints.pixels.astype(np.float32)
    messages = []
    for name, point, sigma, pixel, confidence, status in zip(
        names, points, sigmas, pixels, confidences, statuses, strict=True
    ):
        message = Keypoint3D(name=name, sigma=sigma, pixel=pixel, confidence=confidence, status=status)
        # The message has made a point already: a second one would take a sixth of the time.
        position = message.position
        position.x, position.y, position.z = point
        messages.append(message)
    return messages


def _pose(frame: BodyFrame | None) -> tuple[Pose, int]:
    if frame is None:
        nan = math.nan
        pose = Pose(position=Point(x=nan, y=nan, z=nan), orientation=Quaternion(x=nan, y=nan, z=nan, w=nan))
        return pose, Skeleton3D.BODY_FRAME_UNKNOWN
    x, y, z = frame.origin.tolist()
    qx, qy, qz, qw = _quaternion(frame.rotation)
    pose = Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw))
    hips = frame.anchor == "hips"
    return pose, Skeleton3D.BODY_FRAME_HIPS if hips else Skeleton3D.BODY_FRAME_SHOULDERS


def _quaternion(rotation: FloatArray) -> tuple[float, float, float, float]:
    """Give x, y, z, w of a rotation; w >= 0. Shepperd's method: divides by the greatest of the four."""
    m = rotation.tolist()
    trace = m[0][0] + m[1][1] + m[2][2]
    squares = np.array([*(1.0 + 2.0 * m[i][i] - trace for i in range(3)), 1.0 + trace])  # 4 q_i^2
    i = int(np.argmax(squares))
    if i == 3:
        q = np.array([m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], squares[3]])
    else:
        j, k = (i + 1) % 3, (i + 2) % 3
        q = np.empty(4)
        q[i], q[j], q[k], q[3] = squares[i], m[j][i] + m[i][j], m[k][i] + m[i][k], m[k][j] - m[j][k]
    q /= np.linalg.norm(q)
    qx, qy, qz, qw = (q if q[3] >= 0.0 else -q).tolist()
    return qx, qy, qz, qw
