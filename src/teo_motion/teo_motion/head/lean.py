# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The head forward or back throughout a question, with what signs do with it on top.

A sign that bows the head itself, as BEBER does, bows it from where the question has it, or from less far
where the neck ends: its own movement stays whole. A question about being ill would else end with the raised
head of ENFERMO and look like another.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from teo_motion.head.neck_paths import EASES, GestureWindow, NeckPath, hold_paths
from teo_motion.trajectory.joint_motion import JointMotion
from teo_motion.trajectory.splice import Splicer, rest_after, shifted

# From and to [s].
Times = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Lean:
    """A joint's motion with a lean.

    Attributes:
        motion: The motion.
        start: When the joint first leans as far as it will [s].
        end: When it last does [s].
    """

    motion: JointMotion
    start: float
    end: float


class Leaning:
    """Leans one joint."""

    def __init__(self, splicer: Splicer, least_time: Callable[[float], float]) -> None:
        """Lean a joint that keeps its limits, and needs a time [s] for a distance [rad] from rest to rest."""
        self._splicer = splicer
        self._least_time = least_time

    def leaned(
        self,
        motion: JointMotion,
        angle: float,
        during: Times,
        kept: Sequence[Times],
        shifts: Sequence[float],
    ) -> Lean | None:
        """The motion with a lean; None if there is no time for any.

        Args:
            motion: Motion of the joint.
            angle: Where to lean while no sign turns the joint [rad].
            during: When to lean [s].
            kept: When the joint is to move as it does, in order.
            shifts: By how much it may be turned then [rad], between 0 and `angle` or 0. Neighbours without
                time for the way from one to the other are turned by the lesser.
        """
        levels = [0.0, *shifts, 0.0]
        gaps = list(pairwise([0.0, *(time for times in kept for time in times), motion.duration]))[::2]
        while True:
            leaned = motion
            for (begin, end), level in zip(kept, levels[1:-1], strict=True):
                if level:
                    leaned = shifted(leaned, begin, end, level)
            seen = [time for times, level in zip(kept, levels[1:-1], strict=True) if level for time in times]
            for index, gap in enumerate(gaps):
                found = self._across(leaned, angle, during, gap, (levels[index], levels[index + 1]))
                if found is None:
                    levels[index] = levels[index + 1] = min(levels[index], levels[index + 1], key=abs)
                    levels[0] = levels[-1] = 0.0
                    break
                leaned, times = found
                seen += times
            else:
                return Lean(motion=leaned, start=min(seen), end=max(seen)) if seen else None

    def _across(
        self, motion: JointMotion, angle: float, during: Times, gap: Times, levels: Times
    ) -> tuple[JointMotion, tuple[float, ...]] | None:
        """The motion across a gap between kept times, and when it is at the angle; None if impossible."""
        begin, end = gap
        if begin >= end:
            return (motion, ()) if levels[0] == levels[1] else None
        window = GestureWindow(
            begin=begin,
            first=max(begin, during[0]),
            last=min(end, during[1]),
            end=end,
            comes_from_sign=False,
            goes_on_into_sign=False,
            motion=motion,
            least_time=self._least_time,
        )
        for path in (*hold_paths(angle, window), *self._straight(motion, angle, gap, levels)):
            spliced = self._splicer.spliced(motion, path.begin, path.points, path.end)
            if spliced is not None:
                return spliced, tuple(point.time for point in path.points)
        if levels[0] != levels[1]:
            return None
        return shifted(motion, begin, end, levels[0]), ()

    def _straight(self, motion: JointMotion, angle: float, gap: Times, levels: Times) -> Iterator[NeckPath]:
        """Paths from one level [rad] to the other: late where the first is 0, early where the second is."""
        begin, end = gap
        if levels[0] == levels[1]:
            return
        for ease in EASES:
            takes = ease * self._least_time(angle)
            if not levels[0]:
                yield NeckPath(max(begin, end - takes), (), end)
            elif not levels[1]:
                yield NeckPath(begin, (), min(end, rest_after(motion, begin + takes)))
        yield NeckPath(begin, (), end)
