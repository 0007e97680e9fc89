# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver withstands: 100,000 malformed messages while it steps, and 1,000 stops from anywhere."""

from __future__ import annotations

import struct
import time
from collections import Counter
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from rclpy.serialization import serialize_message

from driver_messages import send
from nodes.driver_rate import PERIOD, wave
from report import Figure
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS, HOME, LEG_JOINTS, joint_limits
from teo_sim_driver.checking.validation import MOST_WAITING, Intake
from teo_sim_driver.follower_report import Mode
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.motion.trajectory import Trajectory
from teo_sim_driver.rules import Refusal, Rules, TrajectoryError

MESSAGES, STOPS = 100_000, 1_000
_POINTS = 20
_LOOK = PERIOD / 10  # [s]: finer than the driver steps, to see more
_JOINTS = len(COMMANDED_JOINTS)
_ROW = 8 * _JOINTS  # [bytes] of the values of a field

Spoil = Callable[[bytearray, np.random.Generator], bytearray]


def measure() -> list[Figure]:
    """Figures of the malformed messages, then of the stops."""
    return [*_malformed(), *_stops()]


def _good() -> tuple[bytes, int, int]:
    """A good message, where its first point's positions begin, and from there to the next point's [bytes]."""
    message = wave(_POINTS * PERIOD)
    data = serialize_message(message)
    first, second = (data.index(point.positions.tobytes()) for point in message.points[:2])
    return data, first, second - first


_DATA, _FIRST, _STRIDE = _good()
# The last number ends here; what follows is room that the serializer did not need.
_END = _FIRST + _STRIDE * (_POINTS - 1) + 2 * _ROW + 24


def _value(rng: np.random.Generator, field: int) -> int:
    """Place of a random number of a random point; field 0 is positions, 1 is velocities."""
    point = _FIRST + _STRIDE * int(rng.integers(0, _POINTS))
    return point + field * (_ROW + 8) + 8 * int(rng.integers(0, _JOINTS))


def _put(data: bytearray, place: int, kind: str, value: float) -> bytearray:
    struct.pack_into("<" + kind, data, place, value)
    return data


def _length(rng: np.random.Generator) -> int:
    """Place of the number of positions of a random point: before them, and what aligns them."""
    point = _FIRST + _STRIDE * int(rng.integers(0, _POINTS))
    return point - (4 if struct.unpack_from("<I", _DATA, point - 4) == (_JOINTS,) else 8)


def _time(rng: np.random.Generator) -> int:
    """Place of time_from_start of a random point: after two full fields and the lengths of two empty ones."""
    return _FIRST + _STRIDE * int(rng.integers(0, _POINTS)) + 2 * _ROW + 16


# Each makes of a good message one that is not.
_SPOIL: dict[str, Spoil] = {
    "cut off": lambda data, rng: data[: rng.integers(0, _END)],
    "of another encoding": lambda data, rng: _put(data, 1, "B", int(rng.integers(2, 256))),
    "a number that is none": lambda data, rng: _put(
        data, _value(rng, int(rng.integers(0, 2))), "d", rng.choice([np.nan, np.inf, -np.inf])
    ),
    "a position beyond": lambda data, rng: _put(
        data, _value(rng, 0), "d", rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(1.0, 300.0)
    ),
    "a velocity beyond": lambda data, rng: _put(
        data, _value(rng, 1), "d", rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(0.0, 300.0)
    ),
    "a field too long or too short": lambda data, rng: _put(
        data, _length(rng), "I", int(rng.integers(0, _JOINTS))
    ),
    "an enormous field": lambda data, rng: _put(data, _length(rng), "I", int(rng.integers(2**20, 2**32))),
    "a joint's name": lambda data, rng: _put(
        data, data.index(rng.choice(COMMANDED_JOINTS).encode()), "B", int(rng.integers(128, 256))
    ),
    "a time": lambda data, rng: _put(data, _time(rng) + 4, "I", int(rng.integers(SECOND, 2**32))),
}


def _malformed() -> list[Figure]:
    rng = np.random.default_rng(13)
    limits, rules = joint_limits(COMMANDED_JOINTS), Rules()
    home = np.array([HOME[name] for name in COMMANDED_JOINTS])
    follower = JointFollower(limits=limits, start=home, period=PERIOD)
    intake: Intake[str] = Intake(limits, LEG_JOINTS)
    kinds = list(_SPOIL)
    codes: Counter[str] = Counter()
    accepted: Counter[str] = Counter()
    faults = sent = waiting = 0
    steps: list[float] = []
    begin = due = time.monotonic()
    while sent < MESSAGES or waiting:
        while sent < MESSAGES and waiting < MOST_WAITING:
            kind = kinds[sent % len(kinds)]
            intake.put(bytes(_SPOIL[kind](bytearray(_DATA), rng)), rules, kind)
            sent, waiting = sent + 1, waiting + 1
        for checked in intake.take():
            waiting -= 1
            try:
                checked.result.result()
                accepted[checked.sender] += 1
            except TrajectoryError as refusal:
                codes[refusal.code] += 1
            except Exception:
                faults += 1
        now = time.monotonic()
        if now >= due:
            follower.step(round(now * SECOND))
            steps.append(now)
            due += PERIOD
        time.sleep(min(max(due - time.monotonic(), 0.0), 0.0005))
    intake.close()
    seconds = time.monotonic() - begin
    gaps = np.diff(steps)
    assert set(codes) <= {str(code) for code in Refusal}
    return [
        Figure(
            f"malformed messages of {_POINTS} points, {len(kinds)} kinds",
            f"{MESSAGES} sent, {codes.total()} refused with a reason ({len(codes)} codes), "
            f"{accepted.total()} accepted, {faults} faults",
        ),
        Figure(
            "steps meanwhile",
            f"{len(gaps) / seconds:.2f} Hz, p99 {np.percentile(gaps, 99) * 1e3:.1f} ms, "
            f"longest {gaps.max() * 1e3:.1f} ms; {MESSAGES / seconds:.0f} messages a second",
        ),
    ]


def _stops() -> list[Figure]:
    rng = np.random.default_rng(17)
    limits = joint_limits(COMMANDED_JOINTS)
    home = np.array([HOME[name] for name in COMMANDED_JOINTS])
    times, travels, added, beyond, fastest = [], [], [], [], []
    for _ in range(STOPS):
        follower = JointFollower(limits=limits, start=home, period=PERIOD)
        follower.step(0)
        trajectory = send(follower, wave(4.0, rng.uniform(0.0, 0.45, len(home))), 0)
        now = 0
        state = follower.step(0)
        stop_at = rng.uniform(0.0, trajectory.duration)
        while now / SECOND < stop_at:
            now += round(PERIOD * SECOND)
            state = follower.step(now)
        begin, own = state.positions, _acceleration(trajectory, now / SECOND)
        follower.block(Mode.STOPPED, "bench", now)
        elapsed, path = 0, [begin]
        while True:
            elapsed += round(_LOOK * SECOND)
            before, state = state, follower.step(now + elapsed)
            path.append(state.positions)
            if follower.trajectory is None:
                break
            change = np.abs(state.velocities - before.velocities) / _LOOK
            added.append(float(np.max(change - own)))
        reached = MotionLimits.of_robot().reached(np.array([*path, *[state.positions] * 3]), _LOOK)
        beyond.append(reached.beyond)
        fastest.append(reached.velocity)
        times.append(elapsed / SECOND)
        travels.append(float(np.abs(state.positions - begin).max()))
    deceleration, jerk = follower.braking
    top = float(limits.velocity.max())
    longest = top / deceleration + deceleration / jerk
    return [
        Figure(
            f"{STOPS} stops from anywhere",
            f"positions {max(beyond):.1e} rad beyond the limits, velocity {max(fastest):.4f} of its limit; "
            f"longest {max(times) * 1e3:.0f} ms (bound {longest * 1e3:.0f} ms and a sample), "
            f"farthest {max(travels):.4f} rad (bound {top * longest / 2.0:.4f} rad)",
        ),
        Figure(
            "what stopping adds to a joint's acceleration",
            f"at most {max(added):.2f} rad/s^2 (bound {deceleration:g} rad/s^2)",
        ),
    ]


def _acceleration(trajectory: Trajectory, moment: float) -> NDArray[np.float64]:
    """The greatest that the path itself asks of each joint in the next quarter of a second [rad/s^2]."""
    states = [trajectory.sample(moment + ahead) for ahead in np.arange(0.0, 0.25, 0.005)]
    return np.asarray(np.max(np.abs([state.accelerations for state in states]), axis=0))


if __name__ == "__main__":
    for figure in measure():
        print(f"{figure.what}: {figure.value}")
