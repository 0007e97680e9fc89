# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_description.humanoid import load_humanoid
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_motion.trajectory.stopping import stop

ROBOTS = {name: MotionLimits.of_robot(load_humanoid(name)) for name in ("teo", "gr1t2")}
EACH_ROBOT = pytest.mark.parametrize("limits", ROBOTS.values(), ids=ROBOTS)


def quintic(time: float, start: tuple[float, float, float], end: float, looks: int = 200) -> np.ndarray:
    """Position and three derivatives of the quintic to a standstill: what a driver makes of one point."""
    p, v, a = start
    d, w, b = end - p, v * time, a * time**2
    curve = np.polynomial.Polynomial(
        [p, w, b / 2, 10 * d - 6 * w - 1.5 * b, -15 * d + 8 * w + 1.5 * b, 6 * d - 3 * w - 0.5 * b]
    )
    s = np.linspace(0.0, 1.0, looks)
    return np.array([curve.deriv(order)(s) / time**order for order in range(4)])


def right_elbow(limits: MotionLimits, share: float, push: float = 0.0) -> tuple[int, State]:
    """A joint that is in the middle of its range in the ready posture, at shares of what it may have there.

    A joint of TEO may have any speed; a faster one only that from which it comes to rest within its range,
    half of what the square root of acceleration times way gives, as jerk and late states take their part.
    """
    joint = limits.names.index(limits.humanoid.elbows[0])
    state = State(limits.humanoid.ready, np.zeros(len(limits.names)), np.zeros(len(limits.names)))
    at = state.position[joint]
    room = min(at - limits.lower[joint], limits.upper[joint] - at)
    fastest = min(limits.velocity[joint], 0.5 * np.sqrt(limits.acceleration[joint] * room))
    state.velocity[joint], state.acceleration[joint] = share * fastest, push * limits.acceleration[joint]
    return joint, state


@EACH_ROBOT
def test_what_stands_still_stays(limits: MotionLimits) -> None:
    rest = limits.humanoid.ready
    end, time = stop(State.still(rest), limits)
    np.testing.assert_array_equal(end.position, rest)
    assert 0.1 <= time < 0.2


@EACH_ROBOT
@settings(max_examples=200)
@given(
    share=st.floats(-1.0, 1.0),
    late=st.floats(-0.02, 0.04),
)
def test_a_robot_a_little_before_or_behind_stops_without_going_faster(
    limits: MotionLimits, share: float, late: float
) -> None:
    joint, start = right_elbow(limits, share)
    end, time = stop(start, limits)
    assert (end.velocity == 0.0).all() and (end.acceleration == 0.0).all()
    # The robot has gone on for so long when the command arrives, or is not yet where it said.
    here = start.position[joint] + late * start.velocity[joint]
    speeds = quintic(time, (here, start.velocity[joint], 0.0), end.position[joint])[1]
    assert np.abs(speeds).max() <= limits.velocity[joint] * 1.001


@EACH_ROBOT
@settings(max_examples=200)
@given(share=st.floats(-1.0, 1.0), push=st.floats(-1.0, 1.0), late=st.floats(0.005, 0.035))
def test_a_robot_that_speeds_up_or_slows_down_stops_within_its_acceleration_and_jerk(
    limits: MotionLimits, share: float, push: float, late: float
) -> None:
    joint, start = right_elbow(limits, share, push)
    end, time = stop(start, limits)
    position, velocity, acceleration = (values[joint] for values in start)
    here = position + late * velocity
    _, _, pushed, jerked = quintic(time, (here, velocity, acceleration), end.position[joint])
    assert np.abs(pushed).max() <= limits.acceleration[joint] * 1.001
    assert np.abs(jerked).max() <= limits.jerk[joint] * 1.001


@EACH_ROBOT
def test_a_stop_stays_within_the_limits(limits: MotionLimits) -> None:
    end, _ = stop(State.still(limits.lower + 0.01)._replace(velocity=-0.9 * limits.velocity), limits)
    assert (end.position >= limits.lower).all()
