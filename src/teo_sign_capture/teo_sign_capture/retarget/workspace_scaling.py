"""Where on TEO a place in the air before a person is.

TEO's shoulders are nearly twice as far apart as a person's, its head is small and its arms are longer. What
is read of a place in the air is its height against head and trunk: crown, shoulders and waist keep theirs.
How far before the body it is scales with the length of the arms; sideways it is half-way between both, so
that circles stay nearly round; and arms stretched out, or hanging, stay so.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from teo_sign_capture.signing_space.places import find_place
from teo_sign_capture.tracks.person import Person

Array = NDArray[np.float64]

_WAIST = 0.7
"""Of the way from the shoulders to the hips."""
_BEYOND = 3.0
"""[m] Farther than any arm: what is there goes on as it was."""


class FarMap:
    """The map of one person's space to TEO's, both from between the shoulders.

    Attributes:
        scale: What lengths are multiplied by before the chest: forwards, sideways, up. Shape (3,).
    """

    def __init__(self, person: Person, reach: float, shoulder: float, height: float) -> None:
        """Find it.

        Args:
            person: The person.
            reach: Of TEO's arm, shoulder to palm [m].
            shoulder: Half the distance between TEO's shoulders [m].
            height: Of TEO's shoulders above its hips [m].
        """
        along = reach / person.arm
        crown, own_crown = find_place("head_top").point[2] - height, person.places["head_top"][2]
        across = (along + crown / own_crown) / 2.0
        self._along = along
        self._aside = _monotone(
            [0.0, person.shoulder, person.shoulder + person.arm],
            [0.0, across * person.shoulder, shoulder + reach],
            along,
        )
        self._up = _monotone(
            [-person.arm, -_WAIST * person.trunk, 0.0, own_crown],
            [-reach, -_WAIST * height, 0.0, crown],
            along,
        )
        self.scale: Array = np.array([along, across, height / person.trunk])

    def __call__(self, points: Array) -> Array:
        """Points of TEO's space for points of the person's [m]. Shapes (n, 3)."""
        x, y, z = points.T
        return np.stack([self._along * x, np.sign(y) * self._aside(np.abs(y)), self._up(z)], axis=1)


def _monotone(ours: list[float], theirs: list[float], slope: float) -> PchipInterpolator:
    """A smooth map through pairs that grows everywhere, and goes on with a slope at both ends."""
    return PchipInterpolator(
        [ours[0] - _BEYOND, *ours, ours[-1] + _BEYOND],
        [theirs[0] - slope * _BEYOND, *theirs, theirs[-1] + slope * _BEYOND],
    )
