# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from std_msgs.msg import Header
from teo_sign_msgs.msg import Skeleton3D
from visualization_msgs.msg import Marker

from teo_skeleton_retriever.layouts.skeleton_3d import SKELETON_PARTS, BodyFrame, Keypoints3D, Skeleton
from teo_skeleton_retriever.output.messages import marker_array, skeleton_array


def keypoints(n: int, seed: int) -> Keypoints3D:
    random = np.random.default_rng(seed)
    status = random.integers(0, 4, n)
    lost = status == 0
    points, sigma, pixels = random.normal(size=(n, 3)), random.random((n, 3)), random.random((n, 2)) * 640
    points[lost], sigma[lost], pixels[lost] = np.nan, np.nan, np.nan
    confidence = np.where(lost, 0.0, random.random(n))
    return Keypoints3D(points=points, confidence=confidence, status=status, sigma=sigma, pixels=pixels)


def skeleton(seed: int = 0, frame: BodyFrame | None = None) -> Skeleton:
    parts = {
        part: keypoints(len(layout), seed + i) for i, (part, layout) in enumerate(SKELETON_PARTS.items())
    }
    return Skeleton(track_id=seed, is_signer=seed == 0, body_frame=frame, **parts)


@settings(deadline=None, max_examples=30)
@given(
    st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda q: np.linalg.norm(q) > 0.1),
    st.booleans(),
)
def test_a_message_says_what_the_skeleton_says(quaternion, hips):
    rotation = Rotation.from_quat(quaternion).as_matrix()
    before = skeleton(2, BodyFrame(np.array([0.1, -0.2, 1.5]), rotation, "hips" if hips else "shoulders"))
    message = skeleton_array([before], Header(frame_id="camera"))
    turn = message.skeletons[0].body_frame.orientation
    np.testing.assert_allclose(
        Rotation.from_quat([turn.x, turn.y, turn.z, turn.w]).as_matrix(), rotation, atol=1e-12
    )
    (said,) = message.skeletons
    assert (said.id, said.is_signer) == (2, False)
    assert said.body_frame_origin == (Skeleton3D.BODY_FRAME_HIPS if hips else Skeleton3D.BODY_FRAME_SHOULDERS)
    for part in SKELETON_PARTS:
        known, told = getattr(before, part), getattr(said, part)
        points = [(k.position.x, k.position.y, k.position.z) for k in told]
        np.testing.assert_array_equal(points, known.points)
        np.testing.assert_array_equal([k.status for k in told], known.status)
        np.testing.assert_allclose([k.confidence for k in told], known.confidence, rtol=1e-6)
        np.testing.assert_allclose([k.sigma for k in told], known.sigma, rtol=1e-6)
        np.testing.assert_allclose([k.pixel for k in told], known.pixels, rtol=1e-6)


def test_half_turns_have_a_quaternion_too():
    for axis in np.eye(3):
        rotation = Rotation.from_rotvec(np.pi * axis).as_matrix()
        message = skeleton_array([skeleton(0, BodyFrame(np.zeros(3), rotation, "hips"))], Header())
        turn = message.skeletons[0].body_frame.orientation
        np.testing.assert_allclose(np.abs([turn.x, turn.y, turn.z, turn.w]), [*axis, 0.0], atol=1e-9)


def test_every_keypoint_has_its_name_and_a_lost_part_is_left_out():
    person = skeleton()
    message = skeleton_array([person], Header()).skeletons[0]
    assert [k.name for k in message.right_hand] == list(SKELETON_PARTS["right_hand"].keypoints)
    assert all(len(k.name) <= 32 for part in SKELETON_PARTS for k in getattr(message, part))
    lost = Skeleton(
        track_id=1,
        is_signer=False,
        body_frame=None,
        **{part: Keypoints3D.lost(len(layout)) for part, layout in SKELETON_PARTS.items()},
    )
    message = skeleton_array([lost], Header()).skeletons[0]
    assert not any(len(getattr(message, part)) for part in SKELETON_PARTS)
    assert message.body_frame_origin == Skeleton3D.BODY_FRAME_UNKNOWN
    assert np.isnan(message.body_frame.position.x)


def test_what_is_known_of_a_person_is_bones_joints_and_a_label() -> None:
    parts = {part: Keypoints3D.lost(len(layout)) for part, layout in SKELETON_PARTS.items()}
    points, status = np.full((25, 3), np.nan), np.zeros(25, dtype=np.uint8)
    points[[1, 2, 3]], status[[1, 2, 3]] = np.eye(3), 1
    parts["body"] = replace(parts["body"], points=points, status=status)
    known = Skeleton(track_id=7, is_signer=True, body_frame=None, **parts)
    markers = marker_array([known], Header(frame_id="camera")).markers
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
    assert all(np.isfinite([point.x, point.y, point.z]).all() for point in (*bones.points, *joints.points))
