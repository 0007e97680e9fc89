# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from teo_common.diagnostics import Level, RateReport
from teo_sim_driver.follower_report import RefusalLog, assess
from teo_sim_driver.rules import Refusal, TrajectoryError

GOOD_RATE = RateReport(99.9, 0.011, 0.0005)

LATE = TrajectoryError(Refusal.ENDS_IN_THE_PAST, "the last point was due 3 s ago")


def judge(report, rate=GOOD_RATE, before=None):
    return assess(report, rate, nominal_rate=100.0, before=before)


@pytest.fixture
def report(new_follower):
    return new_follower().report()


def test_a_step_that_was_limited_is_an_error(report):
    limited = replace(report, limited_steps=3, limited_joints=("AxialNeck",))
    health = judge(limited, before=report)
    assert health.level is Level.ERROR
    assert "AxialNeck" in health.message


def test_a_flood_is_counted_and_its_size_is_told():
    log = RefusalLog()
    lines = [log.line(LATE, i * 0.001) for i in range(2001)]
    told = [line for line in lines if line]
    assert len(told) == 3
    assert told[1].endswith("[999 more of this code since the last line]")
