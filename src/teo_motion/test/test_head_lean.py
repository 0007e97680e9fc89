# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from teo_motion.neck_paths import Leaning
from teo_motion.trajectory.joint_motion import JointMotion, JointMotionBuilder
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.splice import Splicer

LIMITS = MotionLimits.of_robot()
PITCH = LIMITS.names.index("FrontalNeck")
FORWARD = math.radians(9.0)


def least_time(way: float) -> float:
    return float(LIMITS.least_times(np.array([way]), [PITCH])[0])


@pytest.fixture
def leaning() -> Leaning:
    return Leaning(Splicer(LIMITS.bounds.of([PITCH])), least_time)


@pytest.fixture
def motion() -> JointMotion:
    """A head that stands still for 20 s."""
    builder = JointMotionBuilder()
    builder.hold(0.0, 0.0)
    return builder.build(20.0)


def degrees(motion: JointMotion, *times: float) -> list[float]:
    return np.degrees(motion.at(np.array(times))[0]).tolist()


def test_a_head_leans_throughout_and_is_upright_outside(leaning: Leaning, motion: JointMotion) -> None:
    lean = leaning.leaned(motion, FORWARD, (4.0, 12.0), [], [])
    assert lean is not None
    assert (lean.start, lean.end) == pytest.approx((4.0, 12.0))
    assert degrees(lean.motion, 4.0, 8.0, 12.0) == pytest.approx([9.0] * 3, abs=1e-6)
    assert degrees(lean.motion, 0.0, 3.0, 13.0, 20.0) == pytest.approx([0.0] * 4, abs=1e-6)


def test_signs_are_turned_by_what_they_allow(leaning: Leaning, motion: JointMotion) -> None:
    kept, shifts = [(5.0, 6.0), (8.0, 9.0)], [math.radians(4.0), math.radians(1.0)]
    lean = leaning.leaned(motion, FORWARD, (4.0, 12.0), kept, shifts)
    assert lean is not None
    expected = [4.0, 4.0, 9.0, 1.0, 9.0, 9.0]
    assert degrees(lean.motion, 5.5, 6.0, 7.0, 8.5, 10.5, 12.0) == pytest.approx(expected, abs=1e-6)


def test_neighbours_without_time_for_the_way_between_are_turned_by_the_lesser(
    leaning: Leaning, motion: JointMotion
) -> None:
    kept, shifts = [(5.0, 6.0), (6.05, 9.0)], [math.radians(8.0), math.radians(2.0)]
    lean = leaning.leaned(motion, FORWARD, (5.0, 9.0), kept, shifts)
    assert lean is not None
    assert degrees(lean.motion, 5.0, 6.02, 9.0) == pytest.approx([2.0] * 3, abs=1e-6)


def test_a_sign_that_begins_with_the_motion_cannot_be_turned(leaning: Leaning, motion: JointMotion) -> None:
    assert leaning.leaned(motion, FORWARD, (0.0, 20.0), [(0.0, 20.0)], [FORWARD]) is None
    lean = leaning.leaned(motion, FORWARD, (0.0, 9.0), [(0.0, 2.0)], [FORWARD])
    assert lean is not None
    assert degrees(lean.motion, 0.0, 2.0, 5.0) == pytest.approx([0.0, 0.0, 9.0], abs=1e-6)


def test_without_time_there_is_no_lean(leaning: Leaning, motion: JointMotion) -> None:
    assert leaning.leaned(motion, FORWARD, (5.0, 5.2), [(0.0, 5.0), (5.2, 20.0)], [0.0, 0.0]) is None
