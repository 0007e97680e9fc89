# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether a robot that is stopped while it signs keeps every limit, as the driver executes it.

`python -m nodes.stops [STOPS [SEED]]` cancels random sentences of the package's
table at random moments, has the driver's core execute what the executor's queue has sent, and judges
velocity, acceleration and jerk by differences of positions a millisecond apart. No DDS: time is simulated.
Beside them stand stops of robots that do not follow, which are stopped from where joint states showed them.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

import numpy as np
from rich.progress import track

from driver_messages import send
from executed_motion import STEP, executed, following
from queue_world import World
from report import Figure
from teo_lut_executor.node.messages import to_stop
from teo_motion.planner import Planner
from teo_motion.trajectory.ruckig_segment import State
from teo_motion.trajectory.stopping import stop
from teo_names import COMMANDED_JOINTS
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut
from teo_signs.tokens import parse_printed
from teo_sim_driver.rules import TrajectoryError

STOPS = 160
_SEED = 11
_SIGNS = 4  # of a sentence
_MOMENTS = (0.15, 9.0)  # [s] after the sentence came: from its opening to its last sign
_OPENING, _PLANNING = 0.4, 0.31  # [s], as on the reference machine
_MOVES = 0.05  # [rad/s]; a robot that is slower is not worth stopping
_LONGEST = 3.0  # [s] that a stop may take
_LATE = (0.005, 0.035)  # [s] that a state is old: a period, transport and a step of the queue
_MILLISECOND = 1_000_000  # [ns]
_ROUNDING = 1.001  # of positions, seen through three differences


def measure(stops: int = STOPS, seed: int = _SEED) -> list[Figure]:
    """Stop so many times, and judge each."""
    table, dice = Lut.open(None), np.random.default_rng(seed)
    glosses = [gloss for gloss in table.glosses() if table[gloss].kind == "lexical" and " " not in gloss]
    most, durations, refusals = [], [], []
    for _ in track(range(stops), "stops"):
        world, duration = _stopped(table, glosses, dice)
        durations.append(duration)
        try:
            most.append(world.planner.limits.reached(executed(world), STEP)[1:])
        except TrajectoryError as refusal:
            refusals.append(refusal.code)
    worst = np.max(most, axis=0)
    return [
        Figure(f"stops of {stops} over a limit", str(int((np.max(most, axis=1) > _ROUNDING).sum()))),
        Figure("stops that the driver refused", f"{len(refusals)} {' '.join(refusals)}".strip()),
        Figure("most velocity, acceleration, jerk over the limit", ", ".join(f"{x:.4f}" for x in worst)),
        Figure(
            "time to a standstill", f"median {np.median(durations):.2f} s, longest {max(durations):.2f} s"
        ),
        *_from_joint_states(stops, table, glosses, dice),
    ]


def _from_joint_states(
    stops: int, table: Lut, glosses: list[str], dice: np.random.Generator
) -> Iterator[Figure]:
    """Stops with a single point, planned from a state that is some hundredths of a second old."""
    planner = Planner(table)
    most: list[tuple[float, ...]] = []
    refusals: list[str] = []
    while len(most) + len(refusals) < stops:
        try:
            plan = planner.plan(parse_printed(" ".join(dice.choice(glosses, _SIGNS))))
        except PlanError:
            continue
        moment, late = dice.uniform(0.3, plan.duration - 0.5), dice.uniform(*_LATE)
        position, velocity, _ = plan.at(moment - late)
        if np.abs(velocity).max() < _MOVES:
            continue
        end, lead = stop(
            State(position=position, velocity=velocity, acceleration=plan.at(moment)[2]), planner.limits
        )
        follower = following(plan, period=0.001)
        now = round(moment * 1e9)
        for time in range(0, now - 4 * _MILLISECOND, 10 * _MILLISECOND):
            follower.step(time)
        path = [follower.step(now - before * _MILLISECOND).positions for before in (3, 2, 1, 0)]
        try:
            send(follower, to_stop(COMMANDED_JOINTS, end, lead), now)
        except TrajectoryError as refusal:
            refusals.append(refusal.code)
            continue
        times = range(now + _MILLISECOND, now + round(lead * 1e9), _MILLISECOND)
        path += [follower.step(time).positions for time in times]
        most.append(planner.limits.reached(np.array(path), STEP)[1:])
    what = "stops from joint states"
    yield Figure(f"{what}, of {stops} over a limit", str(int((np.max(most, axis=1) > _ROUNDING).sum())))
    yield Figure(f"{what}, refused by the driver", f"{len(refusals)} {' '.join(refusals)}".strip())
    shares = ", ".join(f"{x:.4f}" for x in np.max(most, axis=0))
    yield Figure(f"{what}, most velocity, acceleration, jerk over the limit", shares)


def _stopped(table: Lut, glosses: list[str], dice: np.random.Generator) -> tuple[World, float]:
    """A world whose robot was stopped in motion, and how long that took [s]."""
    while True:
        world = World(table)
        world.run(0.2)
        world.opening_time, world.planning_time = _OPENING, _PLANNING
        try:
            ticket = world.sign(" ".join(dice.choice(glosses, _SIGNS)))
            world.run(float(dice.uniform(*_MOMENTS)))
        except PlanError:
            continue  # signs that cannot follow each other
        if np.abs(world.velocities).max() >= _MOVES and not world.finished():
            break
    began = world.now
    world.cancel(ticket)
    world.obstacle = "it is to stand"
    world.run_until(lambda: not world.velocities.any(), _LONGEST)
    duration = world.now - began
    world.run(0.3)
    return world, duration


if __name__ == "__main__":
    for figure in measure(*(int(number) for number in sys.argv[1:3])):
        print(f"{figure.what}: {figure.value}")
