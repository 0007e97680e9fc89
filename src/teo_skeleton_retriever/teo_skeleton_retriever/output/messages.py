# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Skeletons for others: as messages, as markers for RViz and Foxglove, and as JSON; pictures as messages."""

from __future__ import annotations

import math
from array import array
from collections.abc import Sequence
from typing import Any

import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, Pose, Quaternion
from sensor_msgs.msg import Image
from std_msgs.msg import ColorRGBA, Header
from teo_sign_msgs.msg import Keypoint3D, Skeleton3D, SkeletonArray
from visualization_msgs.msg import Marker, MarkerArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.camera.image_decoding import ColorArray
from teo_skeleton_retriever.layouts.layout import Layout
from teo_skeleton_retriever.layouts.skeleton_3d import (
    SKELETON_PARTS,
    BodyFrame,
    Keypoints3D,
    KeypointStatus,
    Skeleton,
)


def skeleton_array(skeletons: Sequence[Skeleton], header: Header) -> SkeletonArray:
    """Everybody seen in one image, as a message with its header: its stamp, the camera's optical frame."""
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


# A marker goes by itself so long after the last image: a person who left, a node that ended.
_LIFETIME = Duration(nanosec=500_000_000)
_BONE = {"body": 0.02, "left_hand": 0.006, "right_hand": 0.006, "face": 0.003}  # [m] width of a line
_JOINT = {"body": 0.035, "left_hand": 0.01, "right_hand": 0.01, "face": 0.005}  # [m] diameter of a ball
_COLORS = {
    KeypointStatus.MEASURED: (0.20, 0.75, 0.30),
    KeypointStatus.OPTIMISED: (0.20, 0.50, 1.00),
    KeypointStatus.HELD: (1.00, 0.65, 0.10),
}
_SIGNER, _OTHER = (1.0, 1.0, 1.0), (0.55, 0.55, 0.55)


def marker_array(skeletons: Sequence[Skeleton], header: Header) -> MarkerArray:
    """Give, for each person and part, a list of bones and one of joints coloured by status; and the id."""
    markers = []
    for skeleton in skeletons:
        number = 0
        for part, layout in SKELETON_PARTS.items():
            keypoints: Keypoints3D = getattr(skeleton, part)
            color = _SIGNER if skeleton.is_signer else _OTHER
            bones = _marker(header, skeleton.track_id, number, Marker.LINE_LIST, _BONE[part], color)
            bones.points = _bones(keypoints, layout)
            joints = _marker(header, skeleton.track_id, number + 1, Marker.SPHERE_LIST, _JOINT[part], color)
            known = np.flatnonzero(keypoints.status)
            joints.points = [_point(keypoints.points[i]) for i in known]
            joints.colors = [_color(_COLORS[KeypointStatus(keypoints.status[i])]) for i in known]
            # RViz complains of an empty list.
            markers += [marker for marker in (bones, joints) if marker.points]
            number += 2
        markers += _label(skeleton, header, number)
    return MarkerArray(markers=markers)


def _label(skeleton: Skeleton, header: Header, number: int) -> list[Marker]:
    known = skeleton.body.points[skeleton.body.status != KeypointStatus.LOST]
    if not len(known):
        return []
    label = _marker(header, skeleton.track_id, number, Marker.TEXT_VIEW_FACING, 0.1, _SIGNER)
    label.text = f"{skeleton.track_id} signer" if skeleton.is_signer else str(skeleton.track_id)
    label.pose.position = _point(known[np.argmin(known[:, 1])] - [0.0, 0.2, 0.0])  # above the head
    return [label]


def _marker(
    header: Header, track_id: int, number: int, kind: int, size: float, color: tuple[float, float, float]
) -> Marker:
    marker = Marker(header=header, ns=f"person {track_id}", id=number, type=kind, lifetime=_LIFETIME)
    marker.scale.x = marker.scale.y = marker.scale.z = size
    marker.pose.orientation.w = 1.0
    marker.color = _color(color)
    return marker


def _bones(keypoints: Keypoints3D, layout: Layout) -> list[Point]:
    pairs = [(layout.index[a], layout.index[b]) for a, b in layout.bones]
    return [_point(keypoints.points[i]) for pair in pairs if keypoints.status[list(pair)].all() for i in pair]


def _point(place: np.ndarray) -> Point:
    x, y, z = place.tolist()
    return Point(x=x, y=y, z=z)


def _color(rgb: tuple[float, float, float]) -> ColorRGBA:
    return ColorRGBA(r=rgb[0], g=rgb[1], b=rgb[2], a=1.0)


_DIGITS = 5  # of metres, hundredths of a millimetre


def as_json(stamp: float, skeletons: Sequence[Skeleton]) -> dict[str, Any]:
    """Give everybody seen in one image, as what `json.dumps` takes.

    What is not known is null; a keypoint that is lost is left out.
    """
    return {"stamp": stamp, "skeletons": [_skeleton(skeleton) for skeleton in skeletons]}


def _skeleton(skeleton: Skeleton) -> dict[str, Any]:
    parts = {part: _part(getattr(skeleton, part), layout) for part, layout in SKELETON_PARTS.items()}
    return {
        "id": skeleton.track_id,
        "is_signer": skeleton.is_signer,
        "body_frame": _frame(skeleton.body_frame),
        **parts,
    }


def _part(keypoints: Keypoints3D, layout: Layout) -> dict[str, Any]:
    return {
        name: {
            "position": _numbers(keypoints.points[i]),
            "sigma": _numbers(keypoints.sigma[i]),
            "pixel": _numbers(keypoints.pixels[i]),
            "confidence": _number(keypoints.confidence[i]),
            "status": KeypointStatus(keypoints.status[i]).name.lower(),
        }
        for i, name in enumerate(layout.keypoints)
        if keypoints.status[i] != KeypointStatus.LOST
    }


def _frame(frame: BodyFrame | None) -> dict[str, Any] | None:
    if frame is None:
        return None
    axes = [_numbers(row) for row in frame.rotation]
    return {"origin": _numbers(frame.origin), "rotation": axes, "anchor": frame.anchor}


def _numbers(values: Any) -> list[float | None]:
    return [_number(value) for value in values]


def _number(value: Any) -> float | None:
    return round(float(value), _DIGITS) if math.isfinite(value) else None
