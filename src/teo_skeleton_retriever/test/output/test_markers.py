# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

from teo_skeleton_retriever.layouts.skeleton_3d import SKELETON_PARTS, Keypoints3D, Skeleton
from teo_skeleton_retriever.output.messages import marker_array


def person(track_id: int, known: list[int], is_signer: bool = False) -> Skeleton:
    parts = {part: Keypoints3D.lost(len(layout)) for part, layout in SKELETON_PARTS.items()}
    points, status = np.full((25, 3), np.nan), np.zeros(25, dtype=np.uint8)
    points[known] = np.column_stack([np.arange(len(known)), np.zeros(len(known)), np.ones(len(known))])
    status[known] = 1
    parts["body"] = Keypoints3D(
        points=points,
        confidence=np.ones(25),
        status=status,
        sigma=np.full((25, 3), 0.01),
        pixels=np.full((25, 2), np.nan),
    )
    return Skeleton(track_id=track_id, is_signer=is_signer, body_frame=None, **parts)


def test_a_person_is_bones_joints_and_a_label():
    markers = marker_array([person(7, [1, 2, 3], is_signer=True)], Header(frame_id="camera")).markers
    bones, joints, label = markers
    assert [marker.type for marker in markers] == [
        Marker.LINE_LIST,
        Marker.SPHERE_LIST,
        Marker.TEXT_VIEW_FACING,
    ]
    assert len(bones.points) == 4  # neck to shoulder to elbow
    assert (len(joints.points), len(joints.colors)) == (3, 3)
    assert label.text == "7 signer"
    assert {marker.header.frame_id for marker in markers} == {"camera"}
    assert all(marker.lifetime.nanosec or marker.lifetime.sec for marker in markers)


def test_only_what_is_known_is_marked_and_no_number_is_nan():
    for marker in marker_array([person(0, [4]), person(1, [])], Header()).markers:
        assert marker.type != Marker.LINE_LIST
        assert all(np.isfinite([point.x, point.y, point.z]).all() for point in marker.points)
