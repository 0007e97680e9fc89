# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_names import COMMANDED_JOINTS, joint_limits
from teo_sign_capture.entries.sign_entry import Captured, Origin, make_sign
from teo_sign_capture.entries.take import SignTake
from teo_signs.sign_file import read_sign, save_sign
from teo_signs.tokens import parse_printed

ORIGIN = Origin(
    source="made, sha256 0123456789abcdef", standing="described", licence="Apache-2.0", notes="A test."
)


@pytest.fixture(scope="module")
def captured(robot: Robot, take: SignTake) -> Captured:
    return make_sign(robot, "SIGNO", [take], ORIGIN)


def test_an_entry_is_read_back_and_planned_without_a_violation(
    robot: Robot, captured: Captured, tmp_path: Path
) -> None:
    sign = read_sign(save_sign(tmp_path, captured.sign))
    plan = Planner({"SIGNO": sign}, robot=robot).plan(parse_printed("SIGNO SIGNO"))
    limits = joint_limits(COMMANDED_JOINTS)
    times = np.arange(0.0, plan.duration, 0.013)
    positions = np.array([plan.at(float(time))[0] for time in times])
    assert (positions >= limits.lower - 1e-6).all()
    assert (positions <= limits.upper + 1e-6).all()
    speeds = np.abs(np.diff(positions, axis=0)) / np.diff(times)[:, None]
    assert (speeds <= limits.velocity + 1e-6).all()
    for pose in positions[::4]:
        q = robot.configuration(dict(zip(COMMANDED_JOINTS, pose.tolist(), strict=True)))
        assert robot.clearance(q).distance > 0.0


def test_the_entry_lasts_as_long_as_the_stroke_and_keeps_the_motion(
    take: SignTake, captured: Captured, robot: Robot
) -> None:
    sign, motion = captured.sign, take.motion
    assert sign.duration == pytest.approx(take.span.duration, abs=1e-3)
    assert len(sign.times) < len(motion.times)
    for joint, column in zip(sign.joints, sign.knots.T, strict=True):
        error = sign.quality[
            "knots_error_deg" if joint in robot.humanoid.body_joints else "finger_knots_error_deg"
        ]
        wanted = motion.positions[:, motion.joints.index(joint)]
        away = np.abs(np.interp(motion.times, sign.times, column) - wanted).max()
        assert np.degrees(away) <= error + 0.06  # a decimal is stated


def test_the_quality_says_what_the_motion_says(take: SignTake, captured: Captured) -> None:
    quality, motion = captured.sign.quality, take.motion
    palm = np.degrees(np.percentile(motion.palm_error[:, 0], 95.0))
    assert quality["palm_error_p95_deg"] == pytest.approx(palm, abs=0.06)
    place = 1000.0 * np.percentile(motion.place_error[:, 0], 95.0)
    assert quality["place_error_p95_mm"] == pytest.approx(place, abs=0.06)
    assert quality["lost_percent"] == 0.0
    assert quality["clearance_mm"] > 0.0
    # TEO's 50 deg/s: the stretch is no less than the fastest joint asks for over the stroke.
    way = np.abs(np.diff(captured.sign.knots, axis=0)).sum(axis=0).max()
    assert quality["stretch_times"] >= way / np.radians(50.0) / (captured.sign.duration + 0.3)


def test_a_hand_that_is_held_up_and_left_out_is_named(robot: Robot, take: SignTake) -> None:
    held = replace(take, span=replace(take.span, held=("left",)))
    notes = make_sign(robot, "SIGNO", [held], ORIGIN).sign.provenance.notes
    assert "left hand is held up, does nothing and is left out: --hands both" in notes


def test_a_motion_through_the_body_is_refused(robot: Robot, take: SignTake) -> None:
    through = take.motion.positions.copy()
    # A right forearm that lies across the belly [deg].
    through[len(through) // 2, :6] = np.radians([20.0, 0.0, 52.0, -98.0, 0.0, 0.0])
    bad = replace(take, motion=replace(take.motion, positions=through))
    with refused("self_collision", "SIGNO"):
        make_sign(robot, "SIGNO", [bad], ORIGIN)
