# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign as the planner plays it, looked at by other means than the planner's own."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType

import numpy as np

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_motion.planner import DEFAULT_PERIOD, Planner
from teo_motion.sentence.plan import Plan, sample_at
from teo_motion.sentence.signing_style import SigningStyle
from teo_sign_capture.retarget.knots import tube_radii
from teo_signs.errors import LutError, PlanError
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

_KINDS = {"lexical": Kind.LEXICAL, "letter": Kind.LETTER, "number": Kind.NUMBER}
# The planner passes knots exactly: every so often [s] it is looked at, and within so much it is at one [rad].
# A joint is no faster than 1 rad/s.
_KNOT_LOOK, _ON_KNOT = 0.002, 0.001
# Instants between two knots at which the played path is looked at: less than half a degree apart.
_BETWEEN = 24
# [s] Five looks at the limits between two points that the drives are sent.
_STEP = 0.004
# [rad], [rad/s]
_LIMIT_ROUNDING = 1e-6


@dataclass(frozen=True, kw_only=True)
class Playback:
    """What the planner makes of a sign, from rest to rest.

    Attributes:
        stretch: Duration of the sign over the recorded one [1].
        path_error: How far the played path is from the motion that was captured, worst frame, of each of the
            sign's joints [rad]. Shape (m,).
        clearance: Smallest distance between parts of the robot [m].
    """

    stretch: float
    path_error: Array
    clearance: float


def play(robot: Robot, sign: Sign, times: Array, positions: Array) -> Playback:
    """Plan a sign alone and look at every point of the plan.

    Args:
        robot: The robot.
        sign: The sign.
        times: Times of the motion that the sign's knots were chosen from [s]. Shape (n,).
        positions: That motion, for the sign's joints [rad]. Shape (n, m).

    Raises:
        LutError: The planner refuses the sign (with its code), or a point of the plan breaks a limit
            ("outside_limits") or touches ("self_collision").
    """
    try:
        plan = Planner(
            MappingProxyType({sign.gloss: sign}),
            style=SigningStyle(least_size=1.0),  # as large as the entry, to be compared with it
            robot=robot,
            least_standing="sketched",
        ).plan([Token(gloss=sign.gloss, kind=_KINDS[sign.kind])])
    except PlanError as error:
        raise LutError(error.code, f"{sign.gloss}: it cannot be signed: {error}") from error
    _check_limits(robot, sign.gloss, plan)
    return Playback(
        stretch=plan.timings[0].stretch,
        path_error=_path_error(robot, sign, plan, times, positions),
        clearance=_clearance(robot, sign.gloss, plan),
    )


def _check_limits(robot: Robot, gloss: str, plan: Plan) -> None:
    """Look at positions and their differences, whatever the planner knows of its pieces."""
    limits = robot.humanoid.limits(plan.names)
    positions = sample_at(plan.motions, np.arange(0.0, plan.duration, _STEP)).positions
    beyond = np.maximum(limits.lower - positions, positions - limits.upper).max(axis=0)
    speed = np.abs(np.diff(positions, axis=0)).max(axis=0) / _STEP
    for what, excess in (("position", beyond), ("velocity", speed - limits.velocity)):
        worst = int(np.argmax(excess))
        if excess[worst] > _LIMIT_ROUNDING:
            raise LutError(
                "outside_limits",
                f"{gloss}: expected {plan.names[worst]} within its {what} limit, got {excess[worst]:.4f} "
                "beyond it: please report this",
            )


def _clearance(robot: Robot, gloss: str, plan: Plan) -> float:
    least, when, parts = np.inf, 0.0, ""
    times = np.arange(0.0, plan.duration, DEFAULT_PERIOD)
    for time, pose in zip(times, sample_at(plan.motions, times).positions, strict=True):
        found = robot.clearance(robot.configuration(dict(zip(plan.names, pose.tolist(), strict=True))))
        if found.distance < least:
            least, when = float(found.distance), float(time)
            parts = f"{found.first} and {found.second}"
    if least < 0.0:
        raise LutError(
            "self_collision",
            f"{gloss}: expected parts of it that keep apart, got {parts} {-1000.0 * least:.0f} mm into "
            f"each other at {when:.2f} s",
        )
    return least


def _path_error(robot: Robot, sign: Sign, plan: Plan, times: Array, positions: Array) -> Array:
    """Distance of every captured frame to the path played between the knots around it [rad]. Shape (m,)."""
    columns = [plan.names.index(joint) for joint in sign.joints]
    waypoints = _waypoint_times(sign, plan, columns)
    worst = np.zeros(len(sign.joints))
    for knot, (begin, end) in enumerate(pairwise(waypoints)):
        between = (times >= sign.times[knot] - 1e-9) & (times <= sign.times[knot + 1] + 1e-9)
        played = sample_at(plan.motions, np.linspace(begin, end, _BETWEEN)).positions[:, columns]
        away = np.abs(positions[between][:, None] - played)
        # What is near is told by arms rather than by fingers, which may be farther off.
        nearest = (away / tube_radii(robot.humanoid, sign.joints)).max(axis=2).argmin(axis=1)
        worst = np.maximum(worst, away[np.arange(len(away)), nearest].max(axis=0, initial=0.0))
    return worst


def _waypoint_times(sign: Sign, plan: Plan, columns: list[int]) -> list[float]:
    """When the plan passes each knot [s], in order."""
    timing = plan.timings[0]
    looks = 2 + int(timing.duration / _KNOT_LOOK)
    times = timing.start + np.linspace(0.0, timing.duration, looks)
    passed = sample_at(tuple(plan.motions[column] for column in columns), times).positions
    index, found = 0, []
    for knot in sign.knots:
        on = np.abs(passed[index:] - knot).max(axis=1) <= _ON_KNOT
        index += int(np.argmax(on)) if on.any() else 0
        found.append(float(times[index]))
    return found
