# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver withstands: 100,000 malformed messages while it steps, and 1,000 stops from anywhere."""

from __future__ import annotations

import struct
import time
from collections import Counter
from collections.abc import Callable

import numpy as np
from rclpy.serialization import serialize_message

from driver_messages import send
from executed_motion import Reached, judged
from nodes.driver_rate import PERIOD, SECOND, home, wave
from report import Figure
from teo_names import COMMANDED_JOINTS, LEG_JOINTS, joint_limits
from teo_sim_driver import JointFollower, Mode, Refusal, Rules, TrajectoryError
from teo_sim_driver.checking.validation import MOST_WAITING, Intake

_POINTS = 20
_STEP = round(PERIOD * SECOND)  # [ns]
_JOINTS = len(COMMANDED_JOINTS)
_ROW = 8 * _JOINTS  # [bytes] of the values of a field

Spoil = Callable[[bytearray, np.random.Generator], bytearray]


def measure(messages: int = 100_000, stops: int = 1_000) -> list[Figure]:
    """Figures of the malformed messages, then of the stops."""
    return [*_malformed(messages), *_stops(stops)]


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


def _malformed(messages: int) -> list[Figure]:
    rng = np.random.default_rng(13)
    limits, rules = joint_limits(COMMANDED_JOINTS), Rules()
    follower = JointFollower(limits=limits, start=home(), period=PERIOD)
    intake: Intake[str] = Intake(limits, LEG_JOINTS)
    kinds = list(_SPOIL)
    codes: Counter[str] = Counter()
    accepted: Counter[str] = Counter()
    faults = sent = waiting = 0
    steps: list[float] = []
    begin = due = time.monotonic()
    while sent < messages or waiting:
        while sent < messages and waiting < MOST_WAITING:
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
            f"{messages} sent, {codes.total()} refused with a reason ({len(codes)} codes), "
            f"{accepted.total()} accepted, {faults} faults",
        ),
        Figure(
            "steps meanwhile",
            f"{len(gaps) / seconds:.2f} Hz, p99 {np.percentile(gaps, 99) * 1e3:.1f} ms, "
            f"longest {gaps.max() * 1e3:.1f} ms; {messages / seconds:.0f} messages a second",
        ),
    ]


def _stops(stops: int) -> list[Figure]:
    dice = np.random.default_rng(17)
    limits = joint_limits(COMMANDED_JOINTS)
    lasted, farthest, reached = [], [], []
    for _ in range(stops):
        follower = JointFollower(limits=limits, start=home(), period=PERIOD)
        follower.step(0)
        trajectory = send(follower, wave(4.0, dice.uniform(0.0, 0.45, len(limits.names))), 0)
        now = round(dice.uniform(0.0, trajectory.duration) / PERIOD) * _STEP
        for time_before in range(0, now, _STEP):
            follower.step(time_before)
        path = [follower.step(now).positions]
        follower.block(Mode.STOPPED, "bench", now)
        while follower.trajectory is not None:
            now += _STEP // 10  # finer than the driver steps, to see more
            path.append(follower.step(now).positions)
        reached.append(judged(np.array([*path, *[path[-1]] * 3]), PERIOD / 10))
        lasted.append((len(path) - 1) * PERIOD / 10)
        farthest.append(float(np.abs(path[-1] - path[0]).max()))
    deceleration, jerk = follower.braking
    top = float(limits.velocity.max())
    longest = top / deceleration + deceleration / jerk
    most = Reached(*np.max(reached, axis=0))
    return [
        Figure(
            f"{stops} stops from anywhere",
            f"positions {most.beyond:.1e} rad beyond the limits, velocity {most.velocity:.4f} of its limit; "
            f"longest {max(lasted) * 1e3:.0f} ms (bound {longest * 1e3:.0f} ms and a sample), "
            f"farthest {max(farthest):.4f} rad (bound {top * longest / 2.0:.4f} rad)",
        )
    ]
