# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is read of bytes is what rclpy, which made them, reads of them; spoilt bytes get a reason."""

from array import array

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rclpy.serialization import serialize_message
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from teo_names import LEG_JOINTS
from teo_sim_driver.checking.reading import FIELDS, CdrTrajectory, frame_id
from teo_sim_driver.checking.validation import check
from teo_sim_driver.rules import Rules, TrajectoryError


def assert_same(message):
    data = serialize_message(message)
    read, points = CdrTrajectory(data), message.points
    stamp = message.header.stamp
    assert (read.names, read.stamp, read.count) == (
        message.joint_names,
        (stamp.sec, stamp.nanosec),
        len(points),
    )
    assert frame_id(data) == message.header.frame_id
    assert read.times.tolist() == [[p.time_from_start.sec, p.time_from_start.nanosec] for p in points]
    assert read.lengths.tolist() == [[len(getattr(point, name)) for name in FIELDS] for point in points]
    width = len(read.names)
    for field, name in enumerate(FIELDS):
        if set(read.lengths[:, field]) <= {0, width}:
            rows = [list(getattr(point, name)) or [0.0] * width for point in points]
            assert read.table(field).tolist() == rows


@settings(max_examples=100)
@given(
    seed=st.integers(0, 2**32),
    joints=st.integers(0, 30),
    runs=st.lists(st.tuples(st.integers(1, 40), st.integers(0, 15)), max_size=5),
)
def test_bytes_and_objects_say_the_same(seed, joints, runs):
    rng = np.random.default_rng(seed)
    names = ["ñ" * int(rng.integers(0, 9)) for _ in range(joints)]  # any alignment
    message = JointTrajectory(joint_names=names)
    message.header.frame_id = "x" * int(rng.integers(0, 9))
    message.header.stamp.sec, message.header.stamp.nanosec = -5, 4_000_000_000
    for count, given_fields in runs:
        for _ in range(count):
            rows = [array("d", rng.normal(size=joints if given_fields >> i & 1 else 0)) for i in range(4)]
            point = JointTrajectoryPoint(
                positions=rows[0], velocities=rows[1], accelerations=rows[2], effort=rows[3]
            )
            point.time_from_start.sec = int(rng.integers(-(2**31), 2**31))
            point.time_from_start.nanosec = int(rng.integers(0, 2**32))
            message.points.append(point)
    assert_same(message)


def test_the_other_byte_order_is_read():
    head = b"\x00\x00\x00\x00" + bytes([0, 0, 0, 7, 0, 0, 0, 9, 0, 0, 0, 0])
    names = bytes([0, 0, 0, 1, 0, 0, 0, 2]) + b"a\0\0\0"
    time = bytes([0, 0, 0, 3, 0, 0, 0, 4])
    point = bytes([0, 0, 0, 1]) + b"\x3f\xf8" + bytes(6) + bytes(12) + time
    trajectory = CdrTrajectory(head + names + bytes([0, 0, 0, 1]) + point)
    assert (trajectory.stamp, trajectory.names, trajectory.count) == ((7, 9), ["a"], 1)
    assert trajectory.table(0).tolist() == [[1.5]]
    assert trajectory.times.tolist() == [[3, 4]]


@pytest.mark.parametrize(
    "data", [b"", b"\x00", b"\x00\x06\x00\x00" + bytes(64), b"\x00\x01\x00\x00", bytes(9)]
)
def test_what_is_no_message_is_refused(data):
    with pytest.raises(TrajectoryError, match="bad_encoding"):
        CdrTrajectory(data)
    assert frame_id(data) == ""


def test_spoilt_bytes_get_a_reason(swing, limits):
    good = bytearray(serialize_message(swing(duration=1.0, angle=-0.1)))
    codes = set()

    @settings(max_examples=200)
    @given(
        cut=st.integers(0, len(good)),
        flips=st.lists(st.tuples(st.integers(0, len(good) - 1), st.integers(0, 255)), max_size=4),
        early=st.booleans(),
    )
    def spoil(cut, flips, early):
        data = bytearray(good)
        for place, value in flips:
            data[place % 1000 if early else place] = value  # the head, of which the most depends
        try:
            check(bytes(data if early else data[:cut]), limits=limits, rules=Rules(), held=LEG_JOINTS)
        except TrajectoryError as refusal:
            codes.add(refusal.code)

    spoil()
    assert {"bad_encoding", "unknown_joint"} <= codes  # random bytes reach what is behind the head too
