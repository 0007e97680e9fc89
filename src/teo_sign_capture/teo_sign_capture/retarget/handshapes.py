# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The inventory of handshapes: names of a person's, and what robots' motors make of them.

It is written for one hand, TEO's; any other follows that as it follows a person's.

TEO bends the three joints of a finger alike and cannot spread the fingers: `open` and `flat` differ by the
thumb, `bent` bends the whole finger a little. What the names mean on a person's hand stands beside each;
`person_handshapes.tsv` tells how the fingers of such a hand bend [deg], where the thumb's tip is, from the
index's knuckle in the palm's axes [lengths of a finger], and how many of the lexicon's hands have it. Hands
are the synthetic signer's, those of letters are of who spells in `spoken-to-signed`.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import HandTable, hand_table, with_clear_thumb
from teo_description.humanoid import Side
from teo_description.robot import Robot
from teo_sign_capture.retarget.hand_motion import (
    THUMB_TIP,
    HandMotion,
    finger_flexions,
    finger_length,
    follow_thumb,
)
from teo_sign_capture.signing_space import WRITTEN_FOR, finger_rows
from teo_sign_capture.tracks.signer_motion import SignerArm
from teo_sign_capture.tracks.skeleton_track import smoothed
from teo_skeleton_retriever.lifting.hand_axes import INDEX, KNUCKLES

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

# Letters whose shape none of these is, as TEO spells them. Scores do not use them.
_LETTERS: dict[str, tuple[float, float, float, float, float, float]] = {
    "letter_c": (90, -75, 23, 26, 26, 22),
    "letter_ch": (0, -56, 13, 22, 85, 85),
    "letter_d": (88, -74, 7, 50, 48, 44),
    "letter_e": (78, -70, 40, 48, 49, 41),
    "letter_f": (16, -16, 43, 7, 7, 7),
    "letter_g": (50, -17, 22, 85, 85, 75),
    "letter_h": (71, -23, 7, 20, 53, 51),
    "letter_k": (32, -24, 7, 44, 75, 70),
    "letter_m": (90, -42, 28, 32, 33, 85),
    "letter_n": (77, -27, 25, 36, 85, 85),
    "letter_p": (69, -7, 7, 7, 7, 47),
    "letter_q": (90, -57, 26, 31, 28, 26),
    "letter_s": (46, -54, 57, 17, 13, 11),
    "letter_t": (88, -45, 54, 7, 7, 7),
}
# Axes of the thumb, the first of a hand.
_THUMB = 2
# The 42 shapes that a person's hand is compared with.
SHOWN = (*NAMES, *_LETTERS)


def written_shape(name: str) -> Array:
    """The axes of the hand that the shapes are written for [rad]. Shape (6,).

    Raises:
        ValueError: There is no such shape.
    """
    shapes = _SHAPES | _LETTERS
    if name not in shapes:
        raise ValueError(f"expected a handshape among {', '.join(NAMES)}; got {name!r}")
    axes: Array = np.radians(shapes[name])
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


# What people's hands of one handshape differ by, and what is seen of them wrongly: bends of knuckles, of both
# other joints together [rad]; places of the thumb's tip [lengths of a finger]. Hands that spell A, B, I, L, U
# are 3 to 4 such deviations from the synthetic signer's of that shape, as chance has it in eleven figures.
_KNUCKLE, _BEYOND, _TIP = np.radians(18.0), np.radians(30.0), 0.22
# A hand that differs from the commonest shapes by more than this many deviations in all is of none.
_OTHER = 5.0
# [s] Standard deviation of the Gaussian over time by which a hand is led to its shape: shapes are held for
# 0.3 s and more, fingers flutter three times a second.
_HELD = 0.12
# [rad] Fingers that go to and fro by more than this deviation within that time are not held, and go on.
_STEADY = np.radians(6.0)


# Of 668 two-handed signs of the lexicon 472 have the same handshapes on both hands, as have hands that both
# move (Battison, "Lexical Borrowing in American Sign Language", 1978).
_SHARED = 0.71


def shape_chances(arms: Mapping[Side, SignerArm]) -> dict[Side, Array]:
    """How sure it is that each of a person's hands has each of the shapes `SHOWN`, in each frame.

    Two hands tell of each other: they likely have the same.

    Args:
        arms: The person's, with their hands.

    Returns:
        In all 1, but for the chance that a hand has none of them. Shape (T, shapes) each.
    """
    alone = {side: _chances(arm) for side, arm in arms.items()}
    if len(alone) < 2:
        return alone
    return {"right": _beside(alone["right"], alone["left"]), "left": _beside(alone["left"], alone["right"])}


def _beside(chances: Array, other: Array) -> Array:
    """Chances of a hand by what is known of the other. Shapes (T, shapes)."""
    signs = _person_hands()[1]
    shares = chances * (1.0 - _SHARED + _SHARED * other * signs.sum() / signs)
    none = (1.0 - _SHARED) * (1.0 - chances.sum(axis=1, keepdims=True))
    found: Array = shares / (shares.sum(axis=1, keepdims=True) + none)
    return found


def _chances(arm: SignerArm) -> Array:
    """The same of a hand by itself. Shape (T, shapes)."""
    hands, signs = _person_hands()
    tip = (arm.local[:, THUMB_TIP] - arm.local[:, INDEX]) / finger_length(arm)
    apart = ((_features(arm.bends, tip)[:, None] - hands) ** 2).sum(axis=2)
    chances = signs / signs.max() * np.exp(-apart / 2.0)
    shares: Array = chances / (chances.sum(axis=1, keepdims=True) + np.exp(-(_OTHER**2) / 2.0))
    return shares


def _features(bends: Array, tip: Array) -> Array:
    """Hands in deviations; the thumb's tip in lengths of a finger. Shapes (n, 4, 3), (n, 3), (n, 11)."""
    return np.concatenate(
        [bends[..., 0] / _KNUCKLE, bends[..., 1:].sum(axis=2) / _BEYOND, tip / _TIP], axis=1
    )


@cache
def _person_hands() -> tuple[Array, Array]:
    """Features of a person's hands of the shapes, and how many signs have each. (shapes, 11), (shapes,)."""
    table = np.loadtxt(Path(__file__).with_name("person_handshapes.tsv"), dtype=str, skiprows=1)
    rows = table[:, 0].tolist()
    found = table[[rows.index(name) for name in SHOWN], 1:].astype(np.float64)
    return _features(np.radians(found[:, 1:13]).reshape(-1, 4, 3), found[:, 13:]), found[:, 0]


class ShapedHand(NamedTuple):
    """A hand of a robot over time that has the handshapes of the inventory where the person's has.

    Attributes:
        axes: As of `HandMotion` [rad]. Shape (T, axes).
        error: Likewise [rad]. Shape (T,).
        chances: How sure each shape is, by `shape_chances`. Shape (T, shapes).
    """

    axes: Array
    error: Array
    chances: Array


def with_known_shapes(robot: Robot, times: Array, chances: Array, motion: HandMotion) -> ShapedHand:
    """A robot's hand that has the handshape of the inventory where the person's has.

    A robot's thumb cannot lie where a person's lies, on folded fingers say, and one that only seeks the place
    stands out beside it: the inventory has what is read as the same.

    Args:
        robot: The robot.
        times: Of the frames [s]. Shape (T,).
        chances: How sure each shape of the person's hand is, by `shape_chances`. Shape (T, shapes).
        motion: The hand that follows it.
    """
    table = hand_table(robot)
    shapes = np.stack([handshape(robot, name) for name in SHOWN])
    changes = chances @ shapes - chances.sum(axis=1, keepdims=True) * motion.axes
    limits = table.hand.limits
    led = smoothed(times, changes, _HELD)
    led[:, _THUMB:] *= _steadiness(times, motion.axes[:, _THUMB:])
    axes = np.clip(motion.axes + led, limits.lower, limits.upper)
    clear = np.stack([with_clear_thumb(table, hand) for hand in axes])
    return ShapedHand(clear, motion.error, chances)


class HeldShape(NamedTuple):
    """A shape that a hand holds."""

    name: str
    """One of `SHOWN`."""
    chance: float
    """How sure it is, 0 to 1."""


def held_shapes(times: Array, chances: Array) -> tuple[HeldShape, ...]:
    """The shapes that a hand holds one after the other, those that are likelier than not.

    Args:
        times: [s]. Shape (T,).
        chances: By `shape_chances`. Shape (T, shapes).
    """
    likeliest, found = chances.argmax(axis=1), []
    changes = np.flatnonzero(np.diff(likeliest)) + 1
    for run in np.split(np.arange(len(times)), changes):
        shape = int(likeliest[run[0]])
        chance = float(chances[run, shape].mean())
        if times[run[-1]] - times[run[0]] >= _HELD and chance > 0.5:
            found.append(HeldShape(SHOWN[shape], chance))
    return tuple(found)


def _steadiness(times: Array, fingers: Array) -> Array:
    """How much a hand's fingers are held, 0 to 1. Shapes (T, fingers), (T, 1)."""
    spread = smoothed(times, (fingers - smoothed(times, fingers, _HELD)) ** 2, _HELD).max(
        axis=1, keepdims=True
    )
    steady: Array = np.exp(-spread / (2.0 * _STEADY**2))
    return steady
