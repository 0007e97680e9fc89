# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The signs of a table that look most like what somebody shows, by dynamic time warping.

Time is warped by the library dtaidistance; most signs are never compared, as a lower bound of their distance
(Keogh and Ratanamahatana, Knowledge and Information Systems 7, 2005: how far the shown leaves the band that a
sign can be warped in) is already above that of the best ones found.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from dtaidistance import dtw_ndim  # type: ignore[import-untyped]  # ships no types
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_capture.recognition.appearance import MOMENTS, sign_appearance
from teo_signs.sign import Sign

# Moments by which one sign may be ahead of another: a quarter of it, as a hold or a beat may be longer.
AHEAD = 8
# How many signs are named if nobody says otherwise.
COUNT = 5


@dataclass(frozen=True, kw_only=True)
class Match:
    """A sign of the table that looks like what was shown.

    Attributes:
        gloss: Its name.
        distance: Root mean square over the warped sign of all that differs, in the units of `appearance`: 2
            to 4 between a person's sign and its own entry.
    """

    gloss: str
    distance: float


class SignIndex:
    """The signs of a table, ready to be compared with."""

    def __init__(self, glosses: Iterable[str], shown: Array) -> None:
        """Keep what signs show.

        Args:
            glosses: Their N names.
            shown: As `sign_appearance` gives it. Shape (N, MOMENTS, d).
        """
        self._glosses = tuple(glosses)
        self._shown = np.ascontiguousarray(shown, dtype=np.float64)
        width = 2 * AHEAD + 1
        self._highest = maximum_filter1d(self._shown, width, axis=1, mode="nearest")
        self._lowest = minimum_filter1d(self._shown, width, axis=1, mode="nearest")

    @classmethod
    def of_signs(cls, robot: Robot, signs: Iterable[Sign]) -> SignIndex:
        """Index signs, of which there is at least one."""
        listed = list(signs)
        return cls([sign.gloss for sign in listed], np.array([sign_appearance(robot, s) for s in listed]))

    def nearest(self, shown: Array, count: int = COUNT) -> tuple[Match, ...]:
        """The signs most like what is shown, the most alike first.

        Args:
            shown: Shape (MOMENTS, d).
            count: How many; fewer if there are fewer.
        """
        shown = np.ascontiguousarray(shown, dtype=np.float64)
        bounds = self.lower_bounds(shown)
        found: list[tuple[float, int]] = []
        for index in np.argsort(bounds, kind="stable").tolist():
            if len(found) == count and bounds[index] >= found[-1][0]:
                break
            found.append((distance_between(shown, self._shown[index]), index))
            found = sorted(found)[:count]
        return tuple(Match(gloss=self._glosses[index], distance=distance) for distance, index in found)

    def lower_bounds(self, shown: Array) -> Array:
        """What no sign is nearer than, however it is warped. Shape (N,)."""
        outside = np.maximum(shown - self._highest, self._lowest - shown)
        np.maximum(outside, 0.0, out=outside)
        bounds: Array = np.sqrt(np.einsum("nmd,nmd->n", outside, outside) / MOMENTS)
        return bounds


def distance_between(shown: Array, sign: Array) -> float:
    """`Match.distance` of two signs, each of shape (MOMENTS, d), contiguous."""
    # The library counts the diagonal as one.
    warped = dtw_ndim.distance_fast(shown, sign, window=AHEAD + 1)
    return float(warped) / float(np.sqrt(MOMENTS))
