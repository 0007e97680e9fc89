# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Hundreds of random trajectories, good and spoilt: no limit is ever broken, and nothing ever crashes.

The examples are the same in every run; the bench `nodes.driver_robustness` tries new ones by the thousand.
"""

import copy
from collections import Counter

import numpy as np
import pytest
from builtin_interfaces.msg import Duration, Time
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import KroghInterpolator
from trajectory_msgs.msg import JointTrajectoryPoint

from driver_messages import send, trajectory_message
from teo_description.humanoid import load_humanoid
from teo_sim_driver.checking.reading import FIELDS
from teo_sim_driver.follower_report import Mode
from teo_sim_driver.motion.path_time import SECOND, Braking
from teo_sim_driver.rules import Refusal, TrajectoryError

START = 1_700_000_000 * SECOND
PERIOD = 0.01  # [s] of the followers
FRACTIONS = np.linspace(0.0, 1.0, 401)
TOO_FAST = {"start_too_fast", "velocity_limit", "speed_between_points", "velocity_between_points"}


@pytest.fixture(scope="module", params=("teo", "gr1t2"))
def humanoid(request):
    """Every test here is about every robot."""
    return load_humanoid(request.param)


def curves(degree, durations, knots):
    """Positions and velocities along every segment, by scipy: independent of the driver's own way.

    Knots: (3, n, joints). Shapes (n - 1, 401, joints).
    """
    given = knots[: (degree + 1) // 2]  # by order of derivative
    found = []
    for i, duration in enumerate(durations):
        ends = np.repeat([0.0, duration], len(given))
        segment = KroghInterpolator(ends, np.concatenate([given[:, i], given[:, i + 1]]))
        found.append(segment.derivatives(FRACTIONS * duration, 2))
    return np.array(found).swapaxes(0, 1)


def random_message(rng, limits, start, tightness, degree=None, points=None, **stamp):
    """From `start`, as fast as the limits allow times `tightness`, with positions inside the limits."""
    degree = degree or int(rng.choice([1, 3, 5]))
    points = points or int(rng.integers(1, 4))
    knots = np.zeros((3, points + 1, len(start)))
    knots[0, 0] = start
    for i in range(points):
        reach = rng.uniform(0.0, 0.25, len(start)) * (rng.random(len(start)) < 0.7)
        knots[0, i + 1] = np.clip(
            knots[0, i] + reach * rng.choice([-1, 1], len(start)), limits.lower, limits.upper
        )
    durations = rng.uniform(0.1, 0.5, points)
    knots[1, 1:-1] = rng.normal(scale=0.5, size=(points - 1, len(start)))
    knots[2, 1:] = rng.normal(scale=2.0, size=(points, len(start)))
    for _ in range(8):
        positions, velocities = curves(degree, durations, knots)
        outside = ((positions < limits.lower) | (positions > limits.upper)).any(axis=(0, 1))
        if not outside.any():
            break
        knots[1:, :, outside] *= 0.3
    else:
        knots[1:, :, outside] = 0.0
        positions, velocities = curves(degree, durations, knots)
    slower = max((np.abs(velocities) / limits.velocity).max() / tightness, 1e-3)
    knots[1] /= slower
    knots[2] /= slower**2
    message = trajectory_message(
        limits.names,
        np.cumsum(durations * slower),
        knots[0, 1:],
        knots[1, 1:] if degree > 1 else None,
        knots[2, 1:] if degree > 3 else None,
        **stamp,
    )
    return message, knots[0, -1]


class Watch:
    """Steps a follower at irregular times and asserts that no limit is broken."""

    def __init__(self, follower, limits):
        self.follower, self.limits, self.now = follower, limits, START
        self.state = follower.step(START)

    def step(self, gap):
        before, self.now = self.state, self.now + gap
        self.state = self.follower.step(self.now)
        positions, velocities = self.state.positions, self.state.velocities
        limits = self.limits
        assert (positions >= limits.lower - 1.5e-5).all()
        assert (positions <= limits.upper + 1.5e-5).all()
        top = limits.velocity * 1.001
        assert (np.abs(velocities) <= top + 1e-9).all()
        duration = gap / SECOND if 0 <= gap <= SECOND // 2 else 0.01
        assert (np.abs(positions - before.positions) <= top * min(duration, PERIOD) + 1e-8).all()

    def run(self, rng, seconds):
        end = self.now + seconds * SECOND
        while self.now < end:
            longest = 80_000_000 if rng.random() < 0.05 else 10_000_000
            self.step(int(rng.integers(2_000_000, longest)))

    def come_to_rest(self, rng, seconds):
        """Run until it holds, which what late steps have lost makes later by less than they are late."""
        self.run(rng, seconds)
        end = self.now + (seconds + 0.2) * SECOND
        while self.follower.mode is not Mode.HOLDING:
            assert self.now < end
            self.run(rng, 0.01)


@pytest.mark.slow
@settings(max_examples=80)
@given(seed=st.integers(0, 2**32), tightness=st.floats(0.6, 1.0))
def test_what_is_within_the_limits_is_accepted_and_executed_within_them(
    new_follower, limits, home, seed, tightness
):
    rng = np.random.default_rng(seed)
    watch = Watch(new_follower(), limits)
    message, goal = random_message(rng, limits, home, tightness)
    trajectory = send(watch.follower, message, watch.now)
    watch.come_to_rest(rng, trajectory.duration + 0.05)
    np.testing.assert_array_equal(watch.state.positions, goal)
    assert not watch.state.velocities.any()
    assert watch.follower.report().limited_steps == 0


@settings(max_examples=60)
@given(seed=st.integers(0, 2**32), tightness=st.floats(1.002, 3.0))
def test_a_trajectory_over_the_speed_limit_is_refused_for_its_speed(
    new_follower, limits, home, seed, tightness
):
    rng = np.random.default_rng(seed)
    message, _ = random_message(rng, limits, home, tightness)
    with pytest.raises(TrajectoryError) as refusal:
        send(new_follower(), message, START)
    assert refusal.value.code in TOO_FAST


@settings(max_examples=30)
@given(seed=st.integers(0, 2**32))
def test_stopping_at_any_time_breaks_no_limit_and_ends_at_rest(new_follower, limits, home, seed):
    rng = np.random.default_rng(seed)
    watch = Watch(new_follower(), limits)
    watch.follower.braking = Braking(rng.uniform(0.2, 20.0), rng.uniform(20.0, 500.0))
    message, _ = random_message(rng, limits, home, 1.0)
    trajectory = send(watch.follower, message, watch.now)
    watch.run(rng, rng.uniform(0.0, trajectory.duration))
    remaining = watch.follower.cancel(watch.now)
    # From the speed v with the deceleration d and the jerk j: v / d + d / j where d is reached, 2 sqrt(v / j)
    # where not.
    d, j = watch.follower.braking
    top = limits.velocity.max()
    assert remaining <= (top / d + d / j if top * j > d * d else 2.0 * np.sqrt(top / j)) + 1e-9
    before = watch.state.positions
    watch.come_to_rest(rng, remaining + 0.05)
    assert (np.abs(watch.state.positions - before) <= limits.velocity * 1.001 * remaining + 1e-6).all()
    assert watch.follower.mode is Mode.HOLDING
    assert not watch.state.velocities.any()
    assert watch.follower.report().limited_steps == 0


@settings(max_examples=15)
@given(seed=st.integers(0, 2**32))
def test_whatever_comes_in_whatever_order_breaks_no_limit(new_follower, limits, seed):
    rng = np.random.default_rng(seed)
    watch = Watch(new_follower(), limits)
    accepted = 0
    for _ in range(12):
        match rng.integers(0, 6):
            case 0:
                watch.follower.cancel(watch.now)
            case 1:  # the clock is set
                watch.step(int(rng.integers(-(10**12), 10**12)))
            case _:
                stamp = 0 if rng.random() < 0.6 else watch.now + int(rng.integers(-(10**9), 10**9))
                message, _ = random_message(
                    rng, limits, watch.state.positions, rng.uniform(0.3, 1.1), stamp=stamp
                )
                try:
                    send(watch.follower, message, watch.now)
                    accepted += 1
                except TrajectoryError as refusal:
                    assert refusal.code in set(Refusal) - {Refusal.INTERNAL}
        watch.run(rng, rng.uniform(0.0, 0.8))
    assert watch.follower.report().limited_steps == 0
    assert watch.follower.report().accepted == accepted


ODD_NUMBERS = [np.nan, np.inf, -np.inf, 1e308, -1e308, 1e-308, -0.0, 7.0, -7.0, 0.9, 1e5]
ODD_SECONDS = [-(2**31), -1, 0, 1, 2**31 - 1]
ODD_NANOSECONDS = [0, 1, 999_999_999, 10**9, 2**32 - 1]
ODD_NAMES = ["", "AxialNeck", "FrontalLeftKnee", "LeftThumbFingerDistal", "ñ\x00", "x" * 100_000, "axialneck"]
SPOILT = ("number", "row", "field", "time", "stamp", "name", "names", "points", "place")


def spoil(rng, message, what):
    """Make one thing of a message odd."""

    def one_of(things):
        return things[rng.integers(len(things))]

    points, names, field = message.points, message.joint_names, one_of(FIELDS)
    point = one_of(points) if points else JointTrajectoryPoint()
    row = list(getattr(point, field))
    seconds, nanoseconds = one_of(ODD_SECONDS), one_of(ODD_NANOSECONDS)
    match what:
        case "number" if row:
            row[rng.integers(len(row))] = one_of(ODD_NUMBERS)
            setattr(point, field, row)
        case "row":
            setattr(point, field, one_of([[], row[:-1], [*row, 0.0], row * 50, [0.0] * 28]))
        case "field":
            for each in points:
                setattr(each, field, [])
        case "time":
            point.time_from_start = Duration(sec=seconds, nanosec=nanoseconds)
        case "stamp":
            message.header.stamp = Time(sec=seconds, nanosec=nanoseconds)
        case "name" if names:
            names[rng.integers(len(names))] = one_of(ODD_NAMES)
        case "names":
            message.joint_names = one_of([[], names[:-1], [*names, *names], names[::-1], ["AxialNeck"]])
        case "points":
            message.points = one_of([[], points[::-1], points[:1], points[1:], points + points, points[:-1]])
        case "place":
            for each in points:
                each.positions = [position + rng.normal(scale=0.3) for position in each.positions]


@pytest.mark.slow
def test_thousands_of_spoilt_messages_never_crash_and_always_get_a_reason(new_follower, limits, swing):
    good = swing(duration=0.6, angle=-0.05)
    codes: Counter[str] = Counter()

    @settings(max_examples=150)
    @given(seed=st.integers(0, 2**32), spoilt=st.lists(st.sampled_from(SPOILT), min_size=1, max_size=4))
    def check(seed, spoilt):
        rng = np.random.default_rng(seed)
        message = copy.deepcopy(good)
        for what in spoilt:
            spoil(rng, message, what)
        watch = Watch(new_follower(), limits)
        try:
            send(watch.follower, message, watch.now)
            codes["accepted"] += 1
        except TrajectoryError as refusal:
            codes[refusal.code] += 1
            assert refusal.sentence
        watch.run(rng, 0.1)
        assert watch.follower.report().limited_steps == 0

    check()
    assert set(codes) <= {str(code) for code in Refusal} | {"accepted"}
    assert str(Refusal.INTERNAL) not in codes
    assert len(codes) > 15  # the messages are spoilt in many ways
