# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether a robot that is stopped while it signs keeps every limit, as the driver executes it.

Random sentences of the package's table are cancelled at random moments, and the driver's core executes what
the executor's queue has sent. No DDS: time is simulated. Robots that do not follow are stopped as well, from
where joint states showed them.
"""

from __future__ import annotations

import numpy as np
from rich.progress import track

from driver_messages import send
from executed_motion import Reached, executed, following, judged
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
from teo_sim_driver import TrajectoryError

_SIGNS = 4  # of a sentence
_MOMENTS = (0.15, 9.0)  # [s] after the sentence came: from its opening to its last sign
_OPENING, _PLANNING = 0.4, 0.31  # [s], as on the reference machine
_MOVES = 0.05  # [rad/s]; a robot that is slower is not worth stopping
_LONGEST = 3.0  # [s] that a stop may take
_LATE = (0.005, 0.035)  # [s] that a state is old: a period, transport and a step of the queue
_MILLISECOND = 1_000_000  # [ns]
_ROUNDING = 1e-3  # [1] of the moments of a path that is stopped: whole milliseconds


def measure(stops: int = 160, seed: int = 11) -> list[Figure]:
    """Stop so many times, and judge each."""
    table, dice = Lut.open(None), np.random.default_rng(seed)
    glosses = [gloss for gloss in table.glosses() if table[gloss].kind == "lexical" and " " not in gloss]
    durations = []
    reached: list[Reached] = []
    refusals: list[str] = []
    for _ in track(range(stops), "stops"):
        world, duration = _stopped(table, glosses, dice)
        durations.append(duration)
        try:
            reached.append(judged(executed(world)))
        except TrajectoryError as refusal:
            refusals.append(refusal.code)
    return [
        *_figures("stops", reached, refusals),
        Figure(
            "time to a standstill", f"median {np.median(durations):.2f} s, longest {max(durations):.2f} s"
        ),
        *_from_joint_states(stops, table, glosses, dice),
    ]


def _from_joint_states(stops: int, table: Lut, glosses: list[str], dice: np.random.Generator) -> list[Figure]:
    """Stops with a single point, planned from a state that is some hundredths of a second old."""
    planner = Planner(table)
    reached: list[Reached] = []
    refusals: list[str] = []
    while len(reached) + len(refusals) < stops:
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
        reached.append(judged(np.array(path)))
    return _figures("stops from joint states", reached, refusals)


def _figures(what: str, reached: list[Reached], refusals: list[str]) -> list[Figure]:
    over = sum(bool(each.broken(_ROUNDING)) for each in reached)
    shares = ", ".join(f"{share:.4f}" for share in np.max(reached, axis=0)[1:])
    return [
        Figure(f"{what} of {len(reached) + len(refusals)} over a limit", str(over)),
        Figure(f"{what} that the driver refused", f"{len(refusals)} {' '.join(refusals)}".strip()),
        Figure(f"{what}: most velocity, acceleration, jerk over the limit", shares),
    ]


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
