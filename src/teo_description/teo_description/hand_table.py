"""Where the points of TEO's hand are for many handshapes at once.

A finger's points depend on its one flexion, the thumb's on abductor and flexion: both are worked out once by
forward kinematics (`DextraHand`) on a fine grid and looked up.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from teo_description import RIGHT_HAND, joint_limits
from teo_description.hand_geometry import DextraHand
from teo_description.robot import Robot

Array = NDArray[np.float64]

_STEP = np.radians(2.0)
"""[rad] Between them the table's points are off by (finger length) * step^2 / 8 < 0.1 mm."""


class DextraTable:
    """Joints and tips of the right hand in palm axes (along, to the little finger's side, out of the palm).

    Attributes:
        flexions: At which the fingers are tabled [rad]. Shape (f,).
        fingers: Knuckle, middle joint, last joint and tip of index ... little finger [m]. Shape (f, 4, 4, 3).
        abductors, thumb_flexions: At which the thumb is tabled [rad]. Shapes (a,) and (t,).
        thumb: Knuckle, joint and tip [m]. Shape (a, t, 3, 3).
    """

    def __init__(self, robot: Robot) -> None:
        hand, limits = DextraHand(robot), joint_limits(RIGHT_HAND)
        self.abductors, self.thumb_flexions, self.flexions = (
            np.linspace(low, high, int(np.ceil((high - low) / _STEP)) + 1)
            for low, high in zip(limits.lower[:3], limits.upper[:3], strict=True)
        )
        straight = limits.lower[2:]
        self.fingers = np.stack(
            [hand.points(np.concatenate([[0.0, 0.0], np.full(4, bend)])).fingers for bend in self.flexions]
        )
        self.thumb = np.stack(
            [
                [
                    hand.points(np.concatenate([[abductor, bend], straight])).thumb
                    for bend in self.thumb_flexions
                ]
                for abductor in self.abductors
            ]
        )

    def finger_points(self, flexions: Array) -> Array:
        """Knuckle, middle joint, last joint and tip of four fingers [m].

        Args:
            flexions: Of index, middle, ring and little finger [rad]. Shape (n, 4).

        Returns:
            Shape (n, 4, 4, 3).
        """
        below, share = _between(self.flexions, flexions)
        finger = np.arange(4)
        low, high = self.fingers[below, finger], self.fingers[below + 1, finger]
        points: Array = low + share[..., None, None] * (high - low)
        return points

    def thumb_points(self, abductors: Array, flexions: Array) -> Array:
        """Knuckle, joint and tip of the thumb [m]; arguments and result of shapes (n,) and (n, 3, 3)."""
        row, down = _between(self.abductors, abductors)
        column, right = _between(self.thumb_flexions, flexions)
        down, right = down[..., None, None], right[..., None, None]
        points: Array = (1.0 - down) * (
            (1.0 - right) * self.thumb[row, column] + right * self.thumb[row, column + 1]
        ) + down * ((1.0 - right) * self.thumb[row + 1, column] + right * self.thumb[row + 1, column + 1])
        return points


_tables: WeakKeyDictionary[Robot, DextraTable] = WeakKeyDictionary()


def dextra_table(robot: Robot) -> DextraTable:
    """The table of a robot, worked out once: it takes longer than bringing a second onto TEO."""
    if robot not in _tables:
        _tables[robot] = DextraTable(robot)
    return _tables[robot]


def _between(grid: Array, values: Array) -> tuple[NDArray[np.intp], Array]:
    """Index of the grid's point below each value, and the share of the way to the next."""
    place = (values - grid[0]) / (grid[1] - grid[0])
    below = np.clip(place.astype(np.intp), 0, len(grid) - 2)
    return below, place - below
