# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Skeletons as markers for RViz and Foxglove."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from teo_skeleton_retriever.layouts.layout import Layout
from teo_skeleton_retriever.layouts.skeleton_3d import SKELETON_PARTS, Keypoints3D, KeypointStatus, Skeleton

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
    """Give, for each person and part, a list of bones and one of joints coloured by status; and the id.

    Args:
        skeletons: Of one image.
        header: Of the image.
    """
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
