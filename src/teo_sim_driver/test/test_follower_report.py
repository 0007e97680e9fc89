# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from teo_common.diagnostics import Level, RateReport
from teo_sim_driver.follower_report import RefusalLog, assess
from teo_sim_driver.rules import Refusal, TrajectoryError

GOOD_RATE = RateReport(99.9, 0.011, 0.0005)

NAN = TrajectoryError(Refusal.NOT_FINITE, "point 0: expected a finite number")
LATE = TrajectoryError(Refusal.ENDS_IN_THE_PAST, "the last point was due 3 s ago")


def judge(report, rate=GOOD_RATE, before=None):
    return assess(report, rate, nominal_rate=100.0, before=before)


@pytest.fixture
def report(new_follower):
    return new_follower().report()


def test_a_new_refusal_is_a_warning_with_its_reason_and_an_old_one_is_not(report):
    refused = replace(
        report,
        refused={"not_finite": 2},
        refusals=(TrajectoryError(Refusal.NOT_FINITE, "point 3: expected a number"),),
    )
    health = judge(refused, before=report)
    assert health.level is Level.WARN
    assert "not_finite" in health.message
    assert health.values["last refusal"] == "point 3: expected a number"
    assert health.values["refused not_finite"] == "2"
    assert judge(refused, before=refused).level is Level.OK


def test_a_step_that_was_limited_is_an_error(report):
    limited = replace(report, limited_steps=3, limited_joints=("AxialNeck",))
    health = judge(limited, before=report)
    assert health.level is Level.ERROR
    assert "AxialNeck" in health.message


def test_a_flood_is_counted_and_its_size_is_told():
    log = RefusalLog()
    lines = [log.line(NAN, i * 0.001) for i in range(2001)]
    told = [line for line in lines if line]
    assert len(told) == 3
    assert told[1].endswith("[999 more of this code since the last line]")
