# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The inventory of handshapes: names of a person's, and what robots' motors make of them.

It is written for one hand, TEO's; any other follows that as it follows a person's.

TEO bends the three joints of a finger alike and cannot spread the fingers: `open` and `flat` differ by the
thumb, `bent` bends the whole finger a little. What the names mean on a person's hand stands beside each.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import HandTable, hand_table
from teo_description.robot import Robot
from teo_sign_capture.retarget.hand_motion import finger_flexions, follow_thumb
from teo_sign_capture.signing_space import WRITTEN_FOR, finger_rows
from teo_skeleton_retriever.lifting.hand_axes import KNUCKLES

# [deg] Abductor, thumb, index, middle, ring, little finger. 7 is straight, 85 fully bent; abductor 0 has the
# thumb at the hand's side, 90 opposite the palm; thumb -90 stands out, 90 is folded. Thumbs over folded
# fingers are as far over as they go without touching (`hand_geometry`); those that meet a finger are those of
# the letters O, T, S.
_SHAPES: dict[str, tuple[float, float, float, float, float, float]] = {
    "flat": (0, -25, 7, 7, 7, 7),  # fingers straight and together, thumb along
    "open": (0, -70, 7, 7, 7, 7),  # fingers straight and spread, thumb out
    "relaxed": (10, -50, 22, 22, 22, 22),  # open, fingers a little bent
    "bent": (0, -30, 40, 40, 40, 40),  # bent at the knuckles only
    "cupped": (20, -50, 32, 32, 32, 32),  # a little hollow
    "claw": (10, -60, 48, 48, 48, 48),  # spread and bent at the middle joints
    "bunched": (80, -54, 40, 38, 42, 42),  # all tips on the thumb's
    "fist": (21, -12, 80, 80, 80, 80),  # thumb along the index: TEO's cannot lie across folded fingers
    "thumb": (0, -70, 80, 80, 80, 80),  # fist, thumb up
    "index": (45, -15, 7, 80, 80, 80),
    "hook": (33, -25, 45, 80, 80, 80),  # index crooked
    "two": (70, -15, 7, 7, 80, 80),  # index and middle: V and U are one on TEO
    "bent_two": (70, -15, 42, 42, 80, 80),
    "bent_thumb_two": (0, -70, 42, 42, 80, 80),  # thumb out, index and middle bent
    "bent_four": (80, -15, 40, 40, 40, 40),  # four fingers bent, thumb before the palm
    "three": (80, -15, 7, 7, 7, 80),  # index, middle, ring
    "four": (80, -15, 7, 7, 7, 7),  # thumb before the palm
    "little": (21, -12, 80, 80, 80, 7),
    "horns": (51, -18, 7, 80, 80, 7),  # index and little finger
    "thumb_little": (0, -70, 80, 80, 80, 7),  # Y
    "l": (0, -70, 7, 80, 80, 80),  # thumb and index at a right angle
    "thumb_two": (0, -70, 7, 7, 80, 80),  # thumb, index, middle
    "pinch": (62, -66, 44, 80, 80, 80),  # thumb on the index, the others folded
    "ring": (62, -66, 44, 14, 8, 7),  # thumb on the index, the others straight
    "middle_flick": (80, -60, 7, 42, 7, 7),  # middle finger on the thumb, the others straight
    "ring_flick": (86, -60, 7, 7, 41, 7),  # ring finger on the thumb, the others straight
    "two_flick": (75, -62, 44, 44, 80, 80),  # index and middle on the thumb, the others folded
    "three_flick": (80, -60, 44, 44, 44, 80),  # index, middle, ring finger on the thumb
}

NAMES = tuple(_SHAPES)


def written_shape(name: str) -> Array:
    """The axes of the hand that the shapes are written for [rad]. Shape (6,).

    Raises:
        ValueError: There is no such shape.
    """
    if name not in _SHAPES:
        raise ValueError(f"expected a handshape among {', '.join(NAMES)}; got {name!r}")
    axes: Array = np.radians(_SHAPES[name])
    return axes


def handshape(robot: Robot, name: str) -> Array:
    """The axes of a robot's right hand, in the order of `HandGeometry.joints` [rad]. Shape (axes,).

    Raises:
        ValueError: There is no such shape.
    """
    axes = written_shape(name)
    if robot.humanoid.name == WRITTEN_FOR:
        return axes
    shape: Array = follow_robot_hand(_written_for(), axes[None], hand_table(robot))[0]
    return shape


@cache
def _written_for() -> HandTable:
    return HandTable(Robot.load(WRITTEN_FOR))


def follow_robot_hand(theirs: HandTable, axes: Array, table: HandTable) -> Array:
    """Bring handshapes of one robot's hand onto another's, as a person's are brought onto it.

    Fingers are bent by as much in all, from where each is straight; the thumb's tip is where theirs is from
    the index's knuckle, in finger lengths, and meets the fingers that theirs meets.

    Args:
        theirs: The hand that has four fingers.
        axes: Its axes [rad]. Shape (n, 6).
        table: The other hand.

    Returns:
        Its axes [rad]. Shape (n, axes).
    """
    straight = theirs.hand.limits.lower[2:]
    bends = np.repeat((axes[:, 2:] - straight)[:, :, None], 3, axis=2)
    fingers = finger_flexions(table, bends)
    points, thumb = theirs.finger_points(axes[:, 2:]), theirs.thumb_points(axes[:, 0], axes[:, 1])
    person = np.zeros((len(axes), 21, 3))
    for row, knuckle in enumerate(KNUCKLES):
        person[:, knuckle : knuckle + 4] = points[:, row]
    person[:, 2:5] = thumb
    person *= table.hand.finger_length / theirs.hand.finger_length
    person -= person[:, KNUCKLES[finger_rows(table.hand)[0]], None]
    # One by one: they do not follow each other.
    thumbs = [
        follow_thumb(table, np.zeros(1), fingers[row : row + 1], person[row : row + 1])
        for row in range(len(axes))
    ]
    return np.concatenate([np.concatenate(thumbs), fingers], axis=1)
