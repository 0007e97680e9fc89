# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Lays the head's gestures over a plan: only the neck joints that turn and pitch it change, and no time does.

A sign that turns a neck joint itself keeps that joint: its turn belongs to the sign, as the palm's direction
does, and a neck of 10 deg forward and back, as TEO's, leaves no room for a sum. The other joint makes the
gesture meanwhile: a head is shaken at a sign that bows.

A head that would touch a hand gives way: it stays as the sign has it during that sign. A robot that lacks a
joint makes no gesture with it.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np

from teo_description.humanoid import Humanoid
from teo_motion.collision.motion_clearance import MotionClearance
from teo_motion.neck_paths import GestureWindow, Leaning, NeckPath, Times, nod_paths, shake_paths
from teo_motion.sentence.plan import HeadGesture, NearestApproach, Plan
from teo_motion.sentence.sentence_form import Gesture, GestureKind
from teo_motion.trajectory.driver_points import Samples, driver_points
from teo_motion.trajectory.joint_motion import JointMotion
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.splice import Splicer
from teo_signs.lexicon import SignedToken
from teo_signs.sign import Sign

_Axis = Literal["yaw", "pitch"]

# A neck joint that a sign turns by less than this is not turned by it [rad]: entries keep six decimals.
_TURNED = 1e-3

# Where the head leans in a question [rad]: forward all of the 10 deg of TEO's neck but one, which is left to
# the control error, for they are few; back only slightly, but to be seen (the table's QUIÉN has 6 deg).
_LEANS = {GestureKind.FORWARD: math.radians(9.0), GestureKind.BACK: math.radians(-8.0)}

_MOVES: Mapping[GestureKind, tuple[_Axis, Callable[[float, GestureWindow], Iterator[NeckPath]]]] = {
    GestureKind.SHAKE: ("yaw", shake_paths),
    GestureKind.NOD: ("pitch", nod_paths),
}


class HeadOverlay:
    """Adds head gestures to plans."""

    def __init__(
        self,
        motion_clearance: MotionClearance | None,
        *,
        limits: MotionLimits,
        least_clearance: float,
        strength: float,
    ) -> None:
        """Prepare.

        Args:
            motion_clearance: Distances between parts of the robot; None looks at none.
            limits: Limits of the commanded joints.
            least_clearance: Distance that parts of the robot keep [m].
            strength: Times the usual angles, 0 to 1; 0 leaves the head alone.
        """
        self._motion_clearance = motion_clearance
        self._limits = limits
        self._least_clearance = least_clearance
        self._strength = strength
        self._necks = _neck_joints(limits)

    def overlaid(self, plan: Plan, signed: Sequence[SignedToken], gestures: Sequence[Gesture]) -> Plan:
        """A plan with head gestures.

        Args:
            plan: The motion without.
            signed: What is signed, one for each of the plan's timings.
            gestures: What the head is to do.
        """
        if not self._strength or not gestures:
            return plan
        kept = _KeptTimes(plan, signed, self._limits.humanoid, self._necks)
        while True:
            found = self._laid_over(plan, gestures, kept)
            if found is plan or found.nearest is None or found.nearest.distance >= self._least_clearance:
                return found
            if not kept.fix(found.nearest.time):
                return plan

    def _laid_over(self, plan: Plan, gestures: Sequence[Gesture], kept: _KeptTimes) -> Plan:
        """The plan with those gestures for which there is time."""
        motions = list(plan.motions)
        shown: list[HeadGesture] = []
        for gesture in gestures:
            first, last = plan.timings[gesture.first], plan.timings[gesture.last]
            during = first.start, last.start + last.duration
            if gesture.kind in _LEANS:
                shown += self._lean(gesture.kind, plan, motions, during, kept)
            else:
                shown += self._move(gesture.kind, motions, during, kept)
        if not shown:
            return plan
        samples = self._sampled(plan, tuple(motions))
        return dataclasses.replace(
            plan,
            motions=tuple(motions),
            samples=samples,
            nearest=self._nearest(plan, samples),
            head=tuple(sorted(shown, key=lambda gesture: gesture.start)),
        )

    def _lean(
        self, kind: GestureKind, plan: Plan, motions: list[JointMotion], during: Times, kept: _KeptTimes
    ) -> list[HeadGesture]:
        """Lean the head in the motions."""
        neck = self._necks.get("pitch")
        if neck is None:
            return []
        column, angle = neck.column, neck.sign * self._strength * _LEANS[kind]
        times = kept.times["pitch"]
        shifts = [0.0] * len(times)
        for index, (begin, end) in enumerate(times):
            if during[0] <= begin and end <= during[1] and (begin, end) not in kept.fixed:
                within = (plan.times >= begin) & (plan.times <= end)
                own = plan.positions[within, column] * math.copysign(1.0, angle)
                # No further than the lean itself, which is as far as the neck should go.
                shifts[index] = math.copysign(max(abs(angle) - max(float(own.max()), 0.0), 0.0), angle)
        leaning = Leaning(neck.splicer, functools.partial(self._least_time, column))
        lean = leaning.leaned(motions[column], angle, during, times, shifts, kept.begin)
        if lean is None:
            return []
        motions[column] = lean.motion
        return [HeadGesture(kind=kind, start=lean.start, end=lean.end)]

    def _move(
        self, kind: GestureKind, motions: list[JointMotion], during: Times, kept: _KeptTimes
    ) -> list[HeadGesture]:
        """Shake or nod the head in the motions, wherever no sign turns the joint."""
        axis, paths = _MOVES[kind]
        neck = self._necks.get(axis)
        if neck is None:
            return []
        column, shown = neck.column, []
        for begin, end in kept.gaps(axis):
            first, last = max(during[0], begin), min(during[1], end)
            if first >= last:
                continue
            window = GestureWindow(
                begin=begin,
                first=first,
                last=last,
                end=end,
                comes_from_sign=begin > during[0],
                goes_on_into_sign=end < during[1],
                motion=motions[column],
                least_time=functools.partial(self._least_time, column),
            )
            for path in paths(neck.sign * self._strength, window):
                spliced = neck.splicer.spliced(motions[column], path.begin, path.points, path.end)
                if spliced is not None:
                    motions[column] = spliced
                    start, stop = path.points[0].time, path.points[-1].time
                    shown.append(HeadGesture(kind=kind, start=start, end=stop))
                    break
        return shown

    def _nearest(self, plan: Plan, samples: Samples) -> NearestApproach | None:
        """The nearest approach with the head's gestures; only the head's pairs are measured again."""
        if self._motion_clearance is None or plan.nearest is None:
            return None
        head = self._motion_clearance.nearest(samples, head_alone=True)
        others = plan.nearest  # all but the head is where it was
        if not {others.first, others.second}.isdisjoint(self._motion_clearance.head_links):
            others = self._motion_clearance.nearest(samples)
        return min(head, others, key=lambda near: near.distance)

    def _least_time(self, column: int, distance: float) -> float:
        return float(self._limits.least_times(np.array([distance]), [column])[0])

    def _sampled(self, plan: Plan, motions: tuple[JointMotion, ...]) -> Samples:
        columns = [neck.column for neck in self._necks.values()]
        necks = driver_points([motions[column] for column in columns], plan.times)
        samples = Samples(*(values.copy() for values in plan.samples))
        for values, changed in zip(samples[1:], necks[1:], strict=True):
            values[:-1, columns] = changed[:-1]  # at the end the plan is at rest to the digit
        # No further than the rounding that a splice allows.
        np.clip(samples.positions, self._limits.lower, self._limits.upper, out=samples.positions)
        return samples.frozen()


class _NeckJoint(NamedTuple):
    """A joint that gestures move.

    Attributes:
        name: Its name.
        column: Its row among the commanded joints.
        sign: 1.0 where it counts to the left and forward, else -1.0.
        splicer: Lays motions over its own.
    """

    name: str
    column: int
    sign: float
    splicer: Splicer


def _neck_joints(limits: MotionLimits) -> Mapping[_Axis, _NeckJoint]:
    found: dict[_Axis, _NeckJoint] = {}
    axes: tuple[_Axis, _Axis] = ("yaw", "pitch")
    for axis in axes:
        turning = limits.humanoid.head_axis(axis)
        if turning is not None:
            column = limits.names.index(turning[0])
            found[axis] = _NeckJoint(turning[0], column, turning[1], Splicer(limits.bounds.of([column])))
    return found


class _KeptTimes:
    """Times in which each neck joint keeps the motion of the plan."""

    def __init__(
        self, plan: Plan, signed: Sequence[SignedToken], humanoid: Humanoid, necks: Mapping[_Axis, _NeckJoint]
    ) -> None:
        """Keep each joint during the signs that turn it themselves.

        Attributes:
            times: For each axis, from and to [s], in order.
            fixed: Times in which no joint is changed at all, not even by a lean.
            begin: Until when all joints stand still [s].
        """
        # The plan's points begin and end at rest only where its motion stands still for a period.
        period = float(plan.times[-1] - plan.times[-2])
        self.begin, self._duration = period, plan.duration - period
        self._tokens = [(timing.start, timing.start + timing.duration) for timing in plan.timings]
        self.times: dict[_Axis, list[Times]] = {axis: [] for axis in necks}
        self.fixed: set[Times] = set()
        for item, times in zip(signed, self._tokens, strict=True):
            for axis, neck in necks.items():
                if item.sign is not None and _turns(item.sign, neck.name, humanoid.home[neck.name]):
                    self.times[axis].append(times)

    def fix(self, time: float) -> bool:
        """Keep the head as planned in the token or transition at a time [s]; False if it is kept already."""
        edges = [0.0, *(edge for times in self._tokens for edge in times), self._duration]
        after = min(bisect_right(edges, time), len(edges) - 1)
        times = (edges[after - 1], edges[after])
        if times in self.fixed:
            return False
        self.fixed.add(times)
        for kept in self.times.values():
            if times not in kept:
                kept.append(times)
                kept.sort()
        return True

    def gaps(self, axis: _Axis) -> list[Times]:
        """Times in which a joint is free for gestures, in order."""
        edges = [self.begin, *(edge for times in self.times[axis] for edge in times), self._duration]
        return [(begin, end) for begin, end in zip(edges[::2], edges[1::2], strict=True) if begin < end]


def _turns(sign: Sign, joint: str, home: float) -> bool:
    if joint not in sign.joints:
        return False
    return bool(np.abs(sign.knots[:, sign.joints.index(joint)] - home).max() > _TURNED)
