# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_motion.sentence.rest_posture import REST
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_motion.trajectory.stopping import stop

LIMITS = MotionLimits.of_robot()


def quintic(
    time: float, start: tuple[float, float, float], end: float, looks: int = 200
) -> tuple[np.ndarray, np.ndarray]:
    """Position and velocity of the quintic to a standstill: what a driver makes of one point."""
    p, v, a = start
    s = np.linspace(0.0, 1.0, looks)
    d, w, b = end - p, v * time, a * time**2
    c = (10 * d - 6 * w - 1.5 * b, -15 * d + 8 * w + 1.5 * b, 6 * d - 3 * w - 0.5 * b)
    position = p + w * s + b / 2 * s**2 + c[0] * s**3 + c[1] * s**4 + c[2] * s**5
    velocity = (w + b * s + 3 * c[0] * s**2 + 4 * c[1] * s**3 + 5 * c[2] * s**4) / time
    return position, velocity


def test_what_stands_still_stays() -> None:
    still = np.zeros(28)
    end, time = stop(State(position=REST, velocity=still, acceleration=still), LIMITS)
    np.testing.assert_array_equal(end.position, REST)
    assert 0.1 <= time < 0.2


@settings(max_examples=200)
@given(
    share=st.floats(-1.0, 1.0),
    late=st.floats(-0.02, 0.04),
)
def test_a_robot_a_little_before_or_behind_stops_without_going_faster(share: float, late: float) -> None:
    joint = 13  # the right elbow, in the middle of its range
    velocity = np.zeros(28)
    velocity[joint] = share * LIMITS.velocity[joint]
    position = REST.copy()
    end, time = stop(State(position=position, velocity=velocity, acceleration=np.zeros(28)), LIMITS)
    assert (end.velocity == 0.0).all() and (end.acceleration == 0.0).all()
    # The robot has gone on for so long when the command arrives, or is not yet where it said.
    here = position[joint] + late * velocity[joint]
    _, speeds = quintic(time, (here, velocity[joint], 0.0), end.position[joint])
    assert np.abs(speeds).max() <= LIMITS.velocity[joint] * 1.001


def test_a_stop_stays_within_the_limits() -> None:
    velocity = np.full(28, -0.8)
    position = LIMITS.lower + 0.01
    end, _ = stop(State(position=position, velocity=velocity, acceleration=np.zeros(28)), LIMITS)
    assert (end.position >= LIMITS.lower).all()
