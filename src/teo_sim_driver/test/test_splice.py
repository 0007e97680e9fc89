# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Trajectories that take over from a robot in motion, from senders whose clocks are a little off."""

import numpy as np
import pytest

from driver_messages import send, trajectory_message
from teo_names import COMMANDED_JOINTS
from teo_sim_driver.motion.path_time import SECOND

START = 1_700_000_000 * SECOND
ELBOW = COMMANDED_JOINTS.index("FrontalRightElbow")
SPACING = 0.02  # [s] between points, as a planner sends them
END = 3.0  # [s]


def swing(times):
    """Angle, velocity, acceleration of an elbow that goes to -0.65 rad and back. Shape (n,) each."""
    s = np.clip(times / END, 0.0, 1.0)
    bump = np.polynomial.Polynomial([0.0, 1.0, -1.0]) ** 3 * 64.0
    curves = [bump.deriv(order)(s) / END**order for order in range(3)]
    return [-0.65 * curve for curve in curves]


def message(home, begin, lead=0.0, **stamp):
    """The rest of the swing from a moment on, which is so long after the start of the message."""
    times = np.arange(begin, END, SPACING)
    times = np.append(times[times < END - SPACING / 2.0], END)
    angle, speed, acceleration = swing(times)
    rows = np.zeros((3, len(times), len(home)))
    rows[0] = home
    rows[0][:, ELBOW], rows[1][:, ELBOW], rows[2][:, ELBOW] = angle, speed, acceleration
    rows[1:, -1] = 0.0
    return trajectory_message(COMMANDED_JOINTS, times - begin + lead, *rows, **stamp)


@pytest.mark.parametrize("ahead", [0.0, 0.2], ids=["at once", "scheduled"])
@pytest.mark.parametrize("off", [-0.018, 0.004])
@pytest.mark.parametrize("moment", [0.75, 1.3])
def test_a_sender_whose_clock_is_a_little_off_is_taken_over_smoothly(new_follower, home, moment, off, ahead):
    follower = new_follower()
    send(follower, message(home, 0.0), START)
    states, now = [], START
    while now < START + round((moment - ahead) * SECOND):
        now += SECOND // 1000
        states.append(follower.step(now))
    # What the sender believes to be the robot's place at the start is that of a few milliseconds later.
    stamp = {"stamp": START + round(moment * SECOND)} if ahead else {}
    send(follower, message(home, moment + off, **stamp), now)
    while follower.trajectory is not None:
        now += SECOND // 1000
        states.append(follower.step(now))
    angle = np.array([state.positions[ELBOW] for state in states])
    assert angle[-1] == swing(np.array([END]))[0][0]
    _, speed, acceleration = swing(np.linspace(0.0, END, 10001))
    jerk = np.abs(np.gradient(acceleration, END / 10000)).max()
    assert np.abs(np.diff(angle)).max() * 1e3 <= np.abs(speed).max() * 1.01
    assert np.abs(np.diff(angle, 2)).max() * 1e6 <= np.abs(acceleration).max() * 1.2
    assert np.abs(np.diff(angle, 3)[:-10]).max() * 1e9 <= 3.0 * jerk


@pytest.mark.parametrize("begin", [0.2, 0.9, 1.5, 2.1])
def test_two_that_take_over_at_the_same_moment_find_the_same_robot(new_follower, home, begin):
    follower = new_follower()
    send(follower, message(home, 0.0), START)
    now = START
    while now < START + round((begin - 0.03) * SECOND):
        now += SECOND // 1000
        follower.step(now)
    rest = message(home, begin + SPACING, lead=SPACING, stamp=START + round(begin * SECOND))
    for _ in range(3):
        send(follower, rest, now)
        now += SECOND // 1000
        follower.step(now)
    while now < START + round((begin + 0.1) * SECOND):
        now += SECOND // 1000
        state = follower.step(now)
        expected = swing(np.array([(now - START) / SECOND]))
        found = state.positions[ELBOW], state.velocities[ELBOW], state.accelerations[ELBOW]
        np.testing.assert_allclose(found, np.ravel(expected), atol=1e-3)
