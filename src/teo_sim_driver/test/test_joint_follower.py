# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from driver_messages import send, trajectory_message
from teo_sim_driver.follower_report import Mode
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.rules import DriverError, TrajectoryError

START = 1_700_000_000 * SECOND
PERIOD = 10_000_000
ELBOW = "FrontalRightElbow"


def run(follower, begin, seconds, period=PERIOD):
    """Step to `seconds` after begin [ns]; returns the last time, positions and velocities of every step."""
    states = [follower.step(begin + i * period) for i in range(1, round(seconds * SECOND / period) + 1)]
    end = begin + len(states) * period
    return end, np.array([s.positions for s in states]), np.array([s.velocities for s in states])


def test_a_start_outside_the_limits_is_refused(new_follower, home):
    with pytest.raises(DriverError, match="start_outside_limits"):
        new_follower(start=home + 2.0)


def test_it_follows_and_holds_the_last_point(new_follower, swing, limits, home):
    follower = new_follower()
    send(follower, swing(), START)
    _, positions, velocities = run(follower, START, 5.0)
    elbow = limits.names.index(ELBOW)
    times = np.arange(1, 401) * 0.01
    u = times / 4.0
    truth = -0.5 * (4.0 * u * (1.0 - u)) ** 3
    np.testing.assert_allclose(positions[:400, elbow], truth, atol=1e-6)
    speeds = -0.5 * 3.0 * (4.0 * u * (1.0 - u)) ** 2 * (1.0 - 2.0 * u)
    np.testing.assert_allclose(velocities[:, elbow][:400], speeds, atol=1e-4)
    np.testing.assert_array_equal(positions[400:], np.tile(swing().points[-1].positions, (100, 1)))
    assert not velocities[400:].any()
    others = np.delete(positions, elbow, axis=1)
    np.testing.assert_array_equal(others, np.tile(np.delete(home, elbow), (500, 1)))
    report = follower.report()
    assert (report.mode, report.accepted, report.limited_steps) == (Mode.HOLDING, 1, 0)


def test_a_refused_trajectory_changes_nothing(new_follower, swing, limits, home):
    follower, undisturbed = new_follower(), new_follower()
    for each in (follower, undisturbed):
        send(each, swing(), START)
    now, first, _ = run(follower, START, 1.0)
    bad = trajectory_message(limits.names, [0.01], home[None])  # where the robot is not any more
    with pytest.raises(TrajectoryError):
        send(follower, bad, now)
    _, second, _ = run(follower, now, 4.0)
    _, all_along, _ = run(undisturbed, START, 5.0)
    np.testing.assert_allclose(np.vstack([first, second]), all_along, atol=1e-12)
    report = follower.report()
    assert report.refused == {"start_too_fast": 1}
    assert report.last_refusal.code == "start_too_fast"


@pytest.mark.parametrize(("pace", "moment"), [(1.0, 1.0), (0.4, 2.5)])  # as fast as it gets
def test_a_new_trajectory_takes_over_at_any_pace_without_a_step(
    new_follower, swing, limits, home, pace, moment
):
    follower = new_follower()
    follower.scale(pace, START)
    send(follower, swing(), START)
    now, before, _ = run(follower, START, moment)
    back = trajectory_message(limits.names, [3.0], home[None], np.zeros((1, 28)), np.zeros((1, 28)))
    send(follower, back, now)
    _, after, _ = run(follower, now, 8.0)
    motion = np.vstack([before, after])
    assert np.abs(np.diff(motion, axis=0)).max() < limits.velocity[0] * 0.01
    assert np.abs(np.diff(motion, n=2, axis=0)).max() < 2e-4  # no jump in velocity: below 2 rad/s^2
    np.testing.assert_array_equal(after[-1], home)
    assert follower.report().accepted == 2


@pytest.mark.parametrize("moment", [0.05, 0.5, 1.0, 1.7, 3.9])
def test_stop_ends_at_rest_on_the_path_in_the_time_it_says(new_follower, swing, limits, moment):
    follower = new_follower()
    send(follower, swing(angle=-1.0), START)  # 0.86 rad/s at most
    now, _, v_before = run(follower, START, moment)
    remaining = follower.cancel(now)
    assert 0.0 <= remaining <= 0.8727 / 5.2 + 5.2 / 105.0 + 1e-3
    assert follower.mode is Mode.MOVING or remaining == 0.0
    _, positions, velocities = run(follower, now, 1.0)
    steps = int(np.ceil(remaining / 0.01 - 1e-9))
    assert not velocities[steps:].any()
    assert (positions[steps:] == positions[-1]).all()
    assert follower.mode is Mode.HOLDING
    elbow = limits.names.index(ELBOW)
    u = np.linspace(moment / 4.0, 1.0, 4001)
    path = -((4.0 * u * (1.0 - u)) ** 3)
    assert np.abs(path[:, None] - positions[None, :, elbow]).min(axis=0).max() < 1e-3
    # What stopping adds, and what the path itself asks: 1.5 rad/s^2 at u = 1/2.
    acceleration = np.diff(np.vstack([v_before[-1:], velocities]), axis=0) / 0.01
    assert np.abs(acceleration).max() <= 5.2 + 1.5 + 0.05


def test_while_stopping_a_trajectory_is_refused_and_afterwards_served(new_follower, swing, limits):
    follower = new_follower()
    send(follower, swing(angle=-1.0), START)
    now, _, _ = run(follower, START, 1.0)
    follower.cancel(now)
    with pytest.raises(TrajectoryError) as refusal:
        send(follower, swing(), now)
    assert refusal.value.code == "stopping"
    assert follower.cancel(now) > 0.0  # a second stop changes nothing
    now, positions, _ = run(follower, now, 1.0)
    here = positions[-1]
    send(follower, trajectory_message(limits.names, [1.0], here[None], np.zeros((1, 28))), now)


@pytest.mark.parametrize("jump", [-3601 * SECOND, 3600 * SECOND], ids=["back", "ahead"])
def test_a_clock_that_is_set_neither_stops_nor_rushes_the_motion(new_follower, swing, jump):
    follower, steady = new_follower(), new_follower()
    send(follower, swing(), START)
    send(steady, swing(), START)
    now, first, _ = run(follower, START, 1.0)
    _, second, _ = run(follower, now + jump, 4.0)
    np.testing.assert_allclose(np.vstack([first, second]), run(steady, START, 5.0)[1], atol=1e-9)
    assert follower.report().clock_jumps == 1


def test_what_a_late_step_has_lost_is_made_good_in_the_next(new_follower, swing):
    follower, steady = new_follower(), new_follower()
    send(follower, swing(), START)
    send(steady, swing(), START)
    now, _, _ = run(follower, START, 0.8)
    now, _, _ = run(follower, now + 15 * PERIOD, 0.4)
    expected, positions, _ = run(steady, START, 1.35)
    assert now == expected
    np.testing.assert_allclose(follower.step(now).positions, positions[-1], atol=1e-9)
    assert follower.report().clock_jumps == 0


@pytest.mark.parametrize("seed", range(5))
def test_no_step_however_late_goes_farther_than_the_limits_of_velocity_allow_in_a_period(
    new_follower, swing, limits, home, seed
):
    dice = np.random.default_rng(seed)
    follower, now = new_follower(), START
    send(follower, swing(angle=-1.0), now)  # 0.86 rad/s at most
    path = [home]
    while follower.mode is not Mode.HOLDING:
        late = dice.uniform(0.0, 0.45) if dice.random() < 0.05 else dice.uniform(0.0, 0.01)
        now += PERIOD // 2 + round(late * SECOND)
        if dice.random() < 0.1:
            follower.resume(now)  # any request between two steps
        path.append(follower.step(now).positions)
    assert (np.abs(np.diff(path, axis=0)) <= limits.velocity * 0.01 * 1.001 + 1e-9).all()
    np.testing.assert_array_equal(path[-1], swing().points[-1].positions)
    assert follower.report().limited_steps == 0


def test_a_fault_above_the_guard_is_limited_counted_and_reported(new_follower, swing, limits):
    follower = new_follower()
    trajectory = send(follower, swing(), START)
    faulty = trajectory.positions.copy()
    elbow = limits.names.index(ELBOW)
    faulty[10:, elbow] = -5.0  # after it was checked: a leap, out of the limits
    faulty[20:, 0] = np.nan
    object.__setattr__(trajectory, "positions", faulty)
    _, positions, velocities = run(follower, START, 5.0)
    assert np.isfinite(positions).all()
    assert np.isfinite(velocities).all()
    assert (np.abs(np.diff(positions, axis=0)) <= limits.velocity * 1.001 * 0.01 + 2e-9).all()
    assert (positions[:, elbow] >= limits.lower[elbow] - 1.5e-5).all()
    report = follower.report()
    assert report.limited_steps > 100
    assert ELBOW in report.limited_joints


@pytest.mark.parametrize(
    ("mode", "code"), [(Mode.STOPPED, "stopped"), (Mode.FAULT, "fault"), (Mode.INACTIVE, "inactive")]
)
def test_when_blocked_it_slows_down_and_takes_nothing_until_released(new_follower, swing, mode, code):
    follower = new_follower()
    send(follower, swing(angle=-1.0), START)
    now, _, _ = run(follower, START, 1.0)
    remaining = follower.block(mode, "for a reason", now)
    assert remaining > 0.0
    assert follower.mode is mode
    with pytest.raises(DriverError, match="moving"):
        follower.release(mode)
    now, positions, velocities = run(follower, now, remaining + 0.02)
    assert not velocities[-1].any()
    with pytest.raises(TrajectoryError) as refusal:
        send(follower, swing(), now)
    assert refusal.value.code == code
    assert "for a reason" in refusal.value.sentence
    assert follower.report().reason == "for a reason"
    follower.release(mode)
    assert follower.mode is Mode.HOLDING
    assert (run(follower, now, 1.0)[1] == positions[-1]).all()


def test_of_several_blocks_each_is_released_by_itself(new_follower, swing):
    follower = new_follower()
    follower.block(Mode.STOPPED, "stopped", START)
    follower.block(Mode.INACTIVE, "deactivated", START)
    assert follower.mode is Mode.INACTIVE
    follower.release(Mode.INACTIVE)
    assert follower.mode is Mode.STOPPED
    follower.release(Mode.STOPPED)
    send(follower, swing(), START)


@pytest.mark.parametrize("again", [0.03, 0.1, 0.5])
def test_a_pause_stays_on_the_path_which_goes_on_to_its_end(new_follower, swing, limits, again):
    follower = new_follower()
    send(follower, swing(angle=-1.0), START)
    now, before, v_before = run(follower, START, 1.0)
    remaining = follower.pause(now)
    assert follower.mode is Mode.PAUSED
    now, during, v_during = run(follower, now, again)  # also while it is still slowing down
    if again > remaining:
        assert not v_during[-1].any()
        assert follower.report().at_rest
    assert follower.resume(now)
    assert not follower.resume(now)
    _, after, v_after = run(follower, now, 5.0)
    np.testing.assert_array_equal(after[-1], swing().points[-1].positions)
    assert follower.mode is Mode.HOLDING
    elbow = limits.names.index(ELBOW)
    motion = np.concatenate([before, during, after])[:, elbow]
    u = np.linspace(0.0, 1.0, 20001)
    path = -((4.0 * u * (1.0 - u)) ** 3)
    assert np.abs(path[:, None] - motion[None, ::20]).min(axis=0).max() < 1e-3
    speed = np.concatenate([v_before, v_during, v_after])[:, elbow]
    # What the change of pace adds, and what the path itself asks of the elbow: 12 rad/s^2 at most.
    own = np.abs(np.gradient(np.gradient(path, u), u)).max() / 4.0**2
    assert np.abs(np.diff(speed)).max() / 0.01 < 5.2 + own + 0.1


@pytest.mark.parametrize("factor", [0.3, 0.9])
def test_at_half_the_speed_a_path_takes_twice_as_long(new_follower, swing, factor):
    follower = new_follower()
    follower.scale(factor, START)
    send(follower, swing(angle=-1.0), START)
    _, slow, velocities = run(follower, START, 4.0 / factor + 0.01)
    whole = new_follower()
    send(whole, swing(angle=-1.0), START)
    _, fast, _ = run(whole, START, 4.0, period=round(PERIOD * factor))
    np.testing.assert_allclose(slow[: len(fast)], fast[: len(slow)], atol=1e-6)
    np.testing.assert_allclose(np.diff(slow, axis=0)[:-1] / 0.01, velocities[1:-1], atol=0.02)


def test_a_factor_that_makes_no_sense_is_refused(new_follower):
    follower = new_follower()
    for factor in (-0.1, 1.1, float("nan"), float("inf")):
        with pytest.raises(DriverError, match="bad_factor"):
            follower.scale(factor, START)


def test_a_factor_of_0_pauses_until_it_grows(new_follower, swing):
    follower = new_follower()
    send(follower, swing(), START)
    now, _, _ = run(follower, START, 1.0)
    follower.scale(0.0, now)
    assert follower.mode is Mode.PAUSED
    now, positions, _ = run(follower, now, 1.0)
    with pytest.raises(TrajectoryError, match="paused"):
        send(follower, swing(), now)
    follower.scale(1.0, now)
    _, after, _ = run(follower, now, 4.0)
    assert (after[0] != positions[-1]).any() or (after[1] != positions[-1]).any()
    np.testing.assert_array_equal(after[-1], swing().points[-1].positions)


def test_stopped_while_paused_it_has_nothing_left_to_resume(new_follower, swing):
    follower = new_follower()
    send(follower, swing(), START)
    now, _, _ = run(follower, START, 1.0)
    follower.pause(now)
    now, positions, _ = run(follower, now, 1.0)
    assert follower.block(Mode.STOPPED, "stopped", now) == 0.0
    follower.release(Mode.STOPPED)
    assert follower.mode is Mode.HOLDING
    assert not follower.resume(now)
    assert (run(follower, now, 1.0)[1] == positions[-1]).all()


def test_where_it_will_be_is_where_it_then_is(new_follower, swing):
    follower = new_follower()
    send(follower, swing(), START)
    now, _, _ = run(follower, START, 1.0)
    follower.pause(now)
    said = [follower.state_at(delay).positions for delay in (0.0, 0.05, 0.1, 1.0)]
    _, positions, _ = run(follower, now, 1.0)
    np.testing.assert_allclose(said[1:], positions[[4, 9, 99]], atol=1e-9)


def test_stop_forgets_a_scheduled_trajectory(new_follower, swing, home):
    follower = new_follower()
    send(follower, swing(stamp=START + SECOND), START)
    follower.cancel(START)
    np.testing.assert_array_equal(run(follower, START, 3.0)[1][-1], home)
