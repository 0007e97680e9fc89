from dataclasses import replace

import pytest

from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.health import Level, assess
from teo_sim_driver.rate_meter import RateMeter, RateReport

GOOD_RATE = RateReport(99.9, 0.011, 0.0005)


def judge(report, rate=GOOD_RATE, before=None):
    return assess(report, rate, nominal_rate=100.0, before=before)


@pytest.fixture
def report(new_follower):
    return new_follower().report()


def test_a_driver_that_holds_is_well(report):
    health = judge(report)
    assert (health.level, health.message) == (Level.OK, "holding")
    assert health.values["limited steps"] == "0"


def test_a_new_refusal_is_a_warning_with_its_reason_and_an_old_one_is_not(report):
    refused = replace(
        report,
        refused={"not_finite": 2},
        last_refusal=TrajectoryError(Refusal.NOT_FINITE, "point 3: expected a number"),
    )
    health = judge(refused, before=report)
    assert health.level is Level.WARN
    assert "not_finite" in health.message
    assert health.values["last refusal"] == "point 3: expected a number"
    assert health.values["refused not_finite"] == "2"
    assert judge(refused, before=refused).level is Level.OK


def test_a_slow_driver_is_a_warning(report):
    assert judge(report, RateReport(80.0, 0.05, 0.04)).level is Level.WARN


def test_before_the_first_steps_the_rate_is_no_matter(report):
    assert judge(report, RateMeter().report()).level is Level.OK


def test_a_step_that_was_limited_is_an_error(report):
    limited = replace(report, limited_steps=3, limited_joints=("AxialNeck",))
    health = judge(limited, before=report)
    assert health.level is Level.ERROR
    assert "AxialNeck" in health.message


def test_the_rate_is_counted_between_reports():
    meter = RateMeter()
    for i in range(11):
        meter.step(i * 0.01, i * 0.01 + 0.002)
    assert meter.report() == pytest.approx((100.0, 0.01, 0.002))
    meter.step(0.13, 0.131)
    assert meter.report() == pytest.approx((1.0 / 0.03, 0.03, 0.001))
    assert meter.report() == (0.0, 0.0, 0.0)
