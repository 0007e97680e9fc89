# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sentence as waypoints with the idle limbs settled, ready to be timed."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_motion.sentence.composition import TokenSpan
from teo_motion.trajectory.ruckig_segment import State


@dataclass(frozen=True, kw_only=True, eq=False)
class Route:
    """Waypoints with every limb in place.

    Attributes:
        targets: Positions [rad], NaN where a joint is on its way. Shape (n, joints).
        nominal: Least time from each waypoint to the next [s]. Shape (n - 1,).
        strokes: Number of the stroke of each step. Shape (n - 1,).
        spans: Where each token is signed.
        start: State of the joints at the first waypoint.
    """

    targets: Array
    nominal: Array
    strokes: NDArray[np.intp]
    spans: tuple[TokenSpan, ...]
    start: State

    def token_at(self, step: int) -> int | None:
        """Index of the token that is signed between a waypoint and the next; None between two signs."""
        for index, span in enumerate(self.spans):
            if span.first <= step < span.last:
                return index
        return None

    def with_waypoint(self, step: int, row: Array) -> Route:
        """Pass through another waypoint half way between two others.

        Args:
            step: The waypoint before it.
            row: Positions to pass through [rad], NaN where a joint goes on freely. Shape (joints,).
        """
        half = self.nominal[step] / 2.0
        return dataclasses.replace(
            self,
            targets=np.insert(self.targets, step + 1, row, axis=0),
            nominal=np.insert(
                np.concatenate((self.nominal[:step], [half], self.nominal[step + 1 :])), step, half
            ),
            strokes=np.insert(self.strokes, step, self.strokes[step]),
            spans=tuple(
                dataclasses.replace(
                    span, first=span.first + (span.first > step), last=span.last + (span.last > step)
                )
                for span in self.spans
            ),
        )

    def name_at(self, waypoint: int) -> str:
        """What the robot does at a waypoint, for people."""
        if waypoint == 0:
            return "the start"
        for span in self.spans:
            if span.first <= waypoint <= span.last:
                return f"the sign {span.token.gloss!r}" if span.token.gloss else "a pause"
        return "rest" if waypoint == len(self.targets) - 1 else "a posture between two signs"
