# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures of all letters, found together, between which TEO has the shortest way.

At 50 deg/s on every joint, spelling takes as long as the slowest joint from letter to letter. Each letter may
be moved a little, by one offset to the joints of all its knots (`LetterTolerance` says how far); the
offsets of all letters are found in linear programs that make the expected travel of the slowest joint least.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import permutations

import numpy as np

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.spelling_arm import shift_off_face
from teo_sign_authoring.easing.letter_tolerance import LetterTolerance
from teo_sign_authoring.linear_program import BEYOND, LinearProgram
from teo_sign_languages import Alphabet
from teo_signs.errors import LutError
from teo_signs.likeness import SEEN_LENGTH, nearest_pairs
from teo_signs.sign import Sign, with_alternatives

# [rad] Most by which a joint's offset changes in each program.
_STEPS = np.radians([15.0, 15.0, 10.0, 7.0, 5.0, 3.0, 2.0, 1.0])

# Letters that are nearer than this are look-alikes [just seen differences]: what tells their hands apart
# stays.
_LOOK_ALIKE = 2.5


def ease_letters(
    robot: Robot, alphabet: Alphabet, tolerances: Mapping[str, LetterTolerance]
) -> dict[str, Array]:
    """Offsets of the letters with which spelling needs least travel.

    Returns:
        By letter, what is added to every knot [rad]. Shape (m,) each.

    Raises:
        LutError: There is no letter ("unknown_sign").
    """
    if not tolerances:
        raise LutError("unknown_sign", f"expected letters among {', '.join(alphabet.letters)}, got none")
    _part_look_alikes(robot, tolerances)
    offsets = {letter: np.zeros(len(one.sign.joints)) for letter, one in tolerances.items()}
    for step in _STEPS:
        offsets = _program(tolerances, alphabet.frequencies, offsets, float(step))
        for letter, one in tolerances.items():
            shift = shift_off_face(robot, one.sign.knots + offsets[letter])
            if shift.any():
                one.keep_off(offsets[letter], shift)
    return {letter: one.settled(offsets[letter]) for letter, one in tolerances.items()}


def _part_look_alikes(robot: Robot, tolerances: Mapping[str, LetterTolerance]) -> None:
    """Have letters that look alike keep what tells them apart: finger tips, movement, or palms."""
    for pair in nearest_pairs(robot, [one.sign for one in tolerances.values()]):
        if pair.seen >= _LOOK_ALIKE:
            continue
        first, second = tolerances[pair.first], tolerances[pair.second]
        told = pair.seen * SEEN_LENGTH * (1.0 - 1e-9)
        if pair.handshape >= told:
            first.keep_from(second)
            second.keep_from(first)
        elif pair.movement >= told:
            for one in (first, second):
                if len(one.sign.knots) > 2:  # else it stands still
                    one.keep_moving()
        else:
            first.keep_turned_from(second)
            second.keep_turned_from(first)


def with_easy_posture(sign: Sign, offset: Array) -> Sign:
    """A letter with the posture that is easy to reach as its alternative; as it is where that is its own."""
    alternatives = (sign.knots + offset,) if offset.any() else ()
    return with_alternatives(sign, alternatives)


def _program(
    tolerances: Mapping[str, LetterTolerance],
    frequencies: Mapping[str, int],
    offsets: Mapping[str, Array],
    step: float,
) -> dict[str, Array]:
    """Solve for the offsets within a step of those given."""
    letters = list(tolerances)
    linear = [tolerances[letter].linear(offsets[letter], step) for letter in letters]
    pairs = list(permutations(range(len(letters)), 2))
    size = len(offsets[letters[0]])
    own = np.arange(size * len(letters)).reshape(len(letters), size)
    counts = np.array([frequencies.get(letter, 1) for letter in letters])
    share = (counts / counts.sum()).tolist()
    program = LinearProgram(own.size)
    travels = [program.variable(share[first] * share[second]) for first, second in pairs]
    beyond = [program.variable(BEYOND) for _ in letters]
    for columns, one, excess in zip(own, linear, beyond, strict=True):
        program.add([(columns, one.matrix), ([excess], -one.scale[:, None])], one.bound)
    unit = np.eye(size)
    for (first, second), travel in zip(pairs, travels, strict=True):
        ends = tolerances[letters[first]].sign.knots[-1]
        begins = tolerances[letters[second]].sign.knots[0]
        program.add_distance([(own[first], unit), (own[second], -unit)], ends - begins, travel)
    lower, upper = (
        np.concatenate(bounds) for bounds in zip(*((one.lower, one.upper) for one in linear), strict=True)
    )
    return dict(zip(letters, program.solved(lower, upper).reshape(own.shape), strict=True))
