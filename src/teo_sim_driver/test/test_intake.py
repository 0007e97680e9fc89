# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import threading
import time

import pytest
from rclpy.serialization import serialize_message

from teo_names import LEG_JOINTS
from teo_sim_driver.checking.validation import MOST_WAITING, Intake
from teo_sim_driver.rules import Rules, TrajectoryError


@pytest.fixture
def intake(limits):
    intake = Intake(limits, LEG_JOINTS)
    yield intake
    intake.close()


def take_all(intake, count):
    deadline = time.monotonic() + 20.0
    taken = []
    while len(taken) < count:
        assert time.monotonic() < deadline
        taken += intake.take()
        time.sleep(0.001)
    return taken


def test_trajectories_come_out_in_their_order_with_their_sender(intake, swing):
    good, bad = swing(), swing()
    bad.joint_names = []
    for message, sender in ((good, "first"), (bad, "bad"), (good, "last")):
        intake.put(serialize_message(message), Rules(), sender)
    first, refused, last = take_all(intake, 3)
    assert (first.sender, refused.sender, last.sender) == ("first", "bad", "last")
    assert (first.result.result().positions == last.result.result().positions).all()
    with pytest.raises(TrajectoryError, match="no_joints"):
        refused.result.result()


def test_a_message_longer_than_any_good_one_is_refused_unread(intake):
    with pytest.raises(TrajectoryError) as refusal:
        intake.put(bytes(20_000_000), Rules(), None)
    assert refusal.value.code == "too_large"


def test_the_longest_good_message_is_not_too_large(intake, swing):
    message = swing(duration=2.0)
    intake.put(serialize_message(message), Rules(max_points=len(message.points)), None)
    assert take_all(intake, 1)[0].result.result().positions.shape == (20, 28)


def test_more_than_can_be_checked_are_refused(intake, monkeypatch):
    gate = threading.Event()
    monkeypatch.setattr("teo_sim_driver.checking.validation.check", lambda *_, **__: gate.wait(20.0))
    for _ in range(MOST_WAITING):
        intake.put(b"", Rules(), None)
    with pytest.raises(TrajectoryError) as refusal:
        intake.put(b"", Rules(), None)
    assert refusal.value.code == "too_many_waiting"
    gate.set()
    take_all(intake, MOST_WAITING)
    intake.put(b"", Rules(), None)
