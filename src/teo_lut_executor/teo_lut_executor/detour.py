"""Ways around the robot's own body."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_description import COMMANDED_JOINTS
from teo_lut_executor.composer import ARMS, LIMBS, TokenSpan
from teo_lut_executor.motion_limits import MotionLimits

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Route:
    """Stations with every limb in place.

    Attributes:
        targets: Positions [rad], NaN where a joint is on its way. Shape (n, 28).
        nominal: Least time from each station to the next [s]. Shape (n - 1,).
        strokes: Number of the stroke of each step. Shape (n - 1,).
        spans: Where each token is signed.
    """

    targets: Array
    nominal: Array
    strokes: NDArray[np.intp]
    spans: tuple[TokenSpan, ...]

    def token_at(self, step: int) -> int | None:
        """Index of the token that is signed between a station and the next; None on the way between signs."""
        for index, span in enumerate(self.spans):
            if span.first <= step < span.last:
                return index
        return None

    def name_at(self, station: int) -> str:
        """What the robot does at a station, for people."""
        if station == 0:
            return "the start"
        for span in self.spans:
            if span.first <= station <= span.last:
                return f"the sign {span.token.gloss!r}" if span.token.gloss else "a pause"
        return "rest" if station == len(self.targets) - 1 else "a posture between two signs"


# How far the upper arms are lifted sideways and the forearms forward, half way, to pass the body [rad].
_SIDEWAYS = {"SagittalLeftShoulder": 1.0, "SagittalRightShoulder": -1.0}
_FORWARD = {"FrontalLeftShoulder": -1.0, "FrontalRightShoulder": -1.0}
DETOURS: tuple[dict[str, float], ...] = (
    {name: 0.25 * sign for name, sign in _SIDEWAYS.items()},
    {name: 0.3 * sign for name, sign in _FORWARD.items()},
    {name: 0.5 * sign for name, sign in _SIDEWAYS.items()},
    {name: 0.4 * sign for name, sign in (_SIDEWAYS | _FORWARD).items()},
)
"""Changes of posture to try, the smallest first: both arms wider, both further in front, more of either."""


def with_detour(
    route: Route, step: int, *, posture: Array, change: dict[str, float], limits: MotionLimits
) -> Route:
    """Pass through another posture of the arms half way between two stations.

    Args:
        route: The stations.
        step: The station before the detour.
        posture: Positions half way as they are without it [rad]. Shape (28,).
        change: What is added to it, by joint [rad]; within the limits, as far as they go.
        limits: Limits of the joints.
    """
    wider = posture.copy()
    for name, angle in change.items():
        wider[COMMANDED_JOINTS.index(name)] += angle
    wider = np.clip(wider, limits.lower, limits.upper)
    row = np.full(len(wider), np.nan)
    columns = [column for arm in ARMS for column in LIMBS[arm]]
    row[columns] = wider[columns]
    half = route.nominal[step] / 2.0
    return Route(
        targets=np.insert(route.targets, step + 1, row, axis=0),
        nominal=np.insert(
            np.concatenate((route.nominal[:step], [half], route.nominal[step + 1 :])), step, half
        ),
        strokes=np.insert(route.strokes, step, route.strokes[step]),
        spans=tuple(
            dataclasses.replace(
                span, first=span.first + (span.first > step), last=span.last + (span.last > step)
            )
            for span in route.spans
        ),
    )
