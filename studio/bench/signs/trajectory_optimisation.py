# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures of a sentence by trajectory optimisation, beside the planner's shortest path over alternatives.

In `bench/`: `python -m signs.trajectory_optimisation [STEP]` takes every STEP-th known sentence (34 without
it). CasADi with Ipopt moves the arm of each sign by an offset of its own, so that the least times of the
slowest joints are together least, while palms stay as near to their entry's as alternatives may; it begins
at the entries, or at what the shortest path has chosen. All are then planned. Needs
`python -m pip install -r requirements/capture.txt` for CasADi.
"""

from __future__ import annotations

import dataclasses
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from report import Figure
from signs.durations import known_sentences
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.posture_choice import choose_postures
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS, LEFT_ARM, RIGHT_ARM
from teo_signs.errors import PlanError
from teo_signs.lexicon import Lexicon, SignedToken
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign

REST = load_humanoid().ready

STEP = 34
_ARMS = {"left_palm": LEFT_ARM, "right_palm": RIGHT_ARM}
# What alternatives may differ by from their entries (LUT.md): [rad], [m] of words and of letters.
_TURN, _SHIFT, _SHIFT_OF_LETTERS = np.radians(15.0), 0.02, 0.08


def measure(step: int = STEP) -> list[Figure]:
    """Seconds of the sentences, and seconds to choose, of each way."""
    robot, table, limits = Robot.load(), Lut.open(default_lut_directory()), MotionLimits.of_robot()
    rows: list[dict[str, tuple[float, float]]] = []
    for tokens in known_sentences(step):
        found = Lexicon(table).resolve(tokens)
        entries = [item if item.sign is None else _with_knots(item, item.sign.knots) for item in found]
        chosen = choose_postures(found, start=REST, end=REST, limits=limits)
        ways: dict[str, Callable[[], Sequence[SignedToken]]] = {
            "baseline: entries as they are": partial(list, entries),
            "shortest path over alternatives": partial(
                choose_postures, found, start=REST, end=REST, limits=limits
            ),
            "CasADi, from the entries": partial(optimised, entries, entries, robot, limits),
            "CasADi, from that path": partial(optimised, chosen, entries, robot, limits),
        }
        with suppress(PlanError):  # the number of sentences that are left is printed
            rows.append({what: _timed(choose, robot) for what, choose in ways.items()})
    means = {what: np.mean([row[what] for row in rows], axis=0) for what in rows[0]}
    return [
        Figure(
            f"{len(rows)} known sentences, {what}",
            f"{duration:.2f} s, chosen in {1e3 * seconds:.1f} ms (means)",
        )
        for what, (duration, seconds) in means.items()
    ]


def _timed(choose: Callable[[], Sequence[SignedToken]], robot: Robot) -> tuple[float, float]:
    """Seconds of a sentence as planned, and seconds to choose its postures."""
    began = time.perf_counter()
    signed = choose()
    seconds = time.perf_counter() - began
    return _duration(signed, robot), seconds


def optimised(
    begin: Sequence[SignedToken], entries: Sequence[SignedToken], robot: Robot, limits: MotionLimits
) -> list[SignedToken]:
    """Signs with the offsets of their arms with which the sentence's least times are together least.

    A joint's least time is taken as linear: its distance over its speed, and one ramp up and down.
    """
    problem = ca.Opti()
    offsets: list[ca.MX] = []
    before: tuple[Sign, ca.MX] | None = None
    total = ca.MX(0.0)
    signs = [(item.sign, entry.sign) for item, entry in zip(begin, entries, strict=True)]
    for index, (sign, entry) in enumerate(signs):
        offset = ca.MX.zeros(len(COMMANDED_JOINTS))
        if sign is not None and entry is not None:
            if index and sign is signs[index - 1][0]:  # a doubled letter keeps its posture
                offset = offsets[-1]
            else:
                offset = _offset(problem, sign, entry, robot, limits)
            if before is not None:
                total += _way(problem, before, (sign, offset), limits)
            before = sign, offset
        offsets.append(offset)
    problem.minimize(total)
    problem.solver("ipopt", {"print_time": False, "error_on_fail": False}, {"print_level": 0, "sb": "yes"})
    values = problem.solve_limited()
    moved = []
    for item, offset in zip(begin, offsets, strict=True):
        if item.sign is not None:
            columns = [COMMANDED_JOINTS.index(name) for name in item.sign.joints]
            knots = item.sign.knots + np.asarray(values.value(offset)).ravel()[columns]
            lower, upper = limits.lower[columns], limits.upper[columns]
            item = _with_knots(item, np.clip(knots, lower, upper))  # Ipopt keeps bounds to within 1e-8
        moved.append(item)
    return moved


def _offset(problem: ca.Opti, sign: Sign, entry: Sign, robot: Robot, limits: MotionLimits) -> ca.MX:
    """An offset of the arms that a sign uses, which keeps its palms near to the entry's. Shape (28,)."""
    offset = ca.MX.zeros(len(COMMANDED_JOINTS))
    shift = _SHIFT if sign.kind == "lexical" else _SHIFT_OF_LETTERS
    for palm, arm in _ARMS.items():
        if not set(arm) <= set(sign.joints):
            continue
        moved = problem.variable(len(arm))
        columns = [COMMANDED_JOINTS.index(name) for name in arm]
        offset[columns] = moved
        own = sign.knots[:, [sign.joints.index(name) for name in arm]]
        lowest, highest = limits.lower[columns] - own.min(axis=0), limits.upper[columns] - own.max(axis=0)
        problem.subject_to(problem.bounded(np.minimum(lowest, 0.0), moved, np.maximum(highest, 0.0)))
        for knot in sorted({0, len(own) // 2, len(own) - 1}):
            here, of_entry = ({**dict(zip(s.joints, s.knots[knot], strict=True))} for s in (sign, entry))
            meant = robot.placement(robot.configuration(of_entry), palm)
            now = robot.placement(robot.configuration(here), palm)
            turn, place = _palm(robot, here, palm, arm, own[knot] + moved)
            # Where the beginning is farther off already, no farther than that.
            most = max(shift, 1.001 * float(np.linalg.norm(now[:3, 3] - meant[:3, 3])))
            least = min(1.0 + 2.0 * np.cos(_TURN), np.trace(now[:3, :3].T @ meant[:3, :3]) - 1e-4)
            problem.subject_to(ca.sumsqr(place - meant[:3, 3]) <= most**2)
            problem.subject_to(ca.trace(ca.mtimes(turn.T, meant[:3, :3])) >= least)
    return offset


def _palm(
    robot: Robot, pose: dict[str, float], palm: str, arm: Sequence[str], angles: ca.MX
) -> tuple[ca.MX, ca.MX]:
    """Rotation and place of a palm by the product of exponentials (R. Brockett, 1984)."""
    zero = robot.configuration({**pose, **dict.fromkeys(arm, 0.0)})
    home, jacobian = robot.placement(zero, palm), robot.jacobian(zero, palm, arm)
    turn, place = ca.MX(home[:3, :3]), ca.MX(home[:3, 3])
    for index in reversed(range(len(arm))):
        velocity, axis = jacobian[:3, index], jacobian[3:, index]
        through = ca.MX(home[:3, 3] + np.cross(axis, velocity))  # a point of the axis
        cross = ca.skew(axis)
        one = ca.MX.eye(3) + ca.sin(angles[index]) * cross + (1.0 - ca.cos(angles[index])) * (cross @ cross)
        turn, place = ca.mtimes(one, turn), through + ca.mtimes(one, place - through)
    return turn, place


def _way(
    problem: ca.Opti, before: tuple[Sign, ca.MX], after: tuple[Sign, ca.MX], limits: MotionLimits
) -> ca.MX:
    """Time of the way from one sign to the next [s]."""
    (first, from_offset), (second, to_offset) = before, after
    duration = problem.variable()
    problem.subject_to(duration >= 0.0)
    for name in set(first.joints) & set(second.joints):
        j = COMMANDED_JOINTS.index(name)
        ramp = limits.velocity[j] / limits.acceleration[j] + limits.acceleration[j] / limits.jerk[j]
        way = second.knots[0, second.joints.index(name)] - first.knots[-1, first.joints.index(name)]
        needed = (way + to_offset[j] - from_offset[j]) / limits.velocity[j]
        problem.subject_to(problem.bounded(-(duration - ramp), needed, duration - ramp))
    return duration


def _duration(signed: Sequence[SignedToken], robot: Robot) -> float:
    """Seconds of a sentence as planned with just these postures.

    Raises:
        PlanError: It cannot be planned.
    """
    table = {f"S{index}": item.sign for index, item in enumerate(signed) if item.sign is not None}
    tokens = [
        item.token if item.sign is None else dataclasses.replace(item.token, gloss=f"S{index}", inflection="")
        for index, item in enumerate(signed)
    ]
    return Planner(table, robot=robot, max_duration=1e4).plan(tokens).duration


def _with_knots(item: SignedToken, knots: NDArray[np.float64]) -> SignedToken:
    """The same with other knots, and no choice."""
    assert item.sign is not None
    return dataclasses.replace(item, sign=dataclasses.replace(item.sign, knots=knots, alternatives=()))


def main() -> None:
    """Print the figures."""
    for figure in measure(int(sys.argv[1]) if len(sys.argv) > 1 else STEP):
        print(f"{figure.what}: {figure.value}")


if __name__ == "__main__":
    main()
