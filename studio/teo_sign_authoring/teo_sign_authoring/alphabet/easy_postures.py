# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures of all letters, found together, between which TEO has the shortest way.

At 50 deg/s on every joint, spelling takes as long as the slowest joint from letter to letter. Each letter may
be moved a little, by one offset to the joints of all its knots (`LetterTolerance` says how far); the
offsets of all letters are found in one linear program that makes the expected travel of the slowest joint
least. Tolerances are curved, so that programs follow each other, each within a shorter distance of the last
(sequential linear programming, F. Palacios-Gomez, L. Lasdon, M. Engquist, Management Science 28, 1982).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import permutations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog
from scipy.sparse import coo_matrix

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.face_visibility import shift_off_face
from teo_sign_authoring.alphabet.letter_tolerance import LetterTolerance
from teo_sign_languages import Alphabet
from teo_signs.errors import LutError
from teo_signs.likeness import SEEN_LENGTH, nearest_pairs
from teo_signs.motion_hash import with_alternatives
from teo_signs.sign import Sign

# [rad] Most by which a joint's offset changes in each program.
_STEPS = np.radians([15.0, 15.0, 10.0, 7.0, 5.0, 3.0, 2.0, 1.0])

# [rad] What being beyond a tolerance by its whole size costs, against the expected travel: nothing gained
# by it is worth it, but a program that is infeasible would end the search.
_BEYOND = 10.0

# Letters that are nearer than this are look-alikes [just seen differences]: what tells their hands apart
# stays.
_LOOK_ALIKE = 2.5


def ease_letters(
    robot: Robot, alphabet: Alphabet, tolerances: Mapping[str, LetterTolerance]
) -> dict[str, Array]:
    """Offsets of the letters with which spelling needs least travel.

    Args:
        robot: The robot.
        alphabet: The language's, with how often each letter is spelled.
        tolerances: Of each of its letters.

    Returns:
        By letter, what is added to every knot [rad]. Shape (m,) each.

    Raises:
        LutError: A letter is missing ("unknown_sign").
    """
    missing = [letter for letter in alphabet.letters if letter not in tolerances]
    if missing:
        raise LutError(
            "unknown_sign", f"expected all letters of the alphabet, got none for {', '.join(missing)}"
        )
    part_look_alikes(robot, tolerances)
    offsets = {letter: np.zeros(len(one.sign.joints)) for letter, one in tolerances.items()}
    for step in _STEPS:
        offsets = _program(tolerances, alphabet.frequencies, offsets, float(step))
        for letter, one in tolerances.items():
            shift = shift_off_face(robot, one.sign.knots + offsets[letter])
            if shift.any():
                one.keep_off(offsets[letter], shift)
    return {letter: one.settled(offsets[letter]) for letter, one in tolerances.items()}


def part_look_alikes(robot: Robot, tolerances: Mapping[str, LetterTolerance]) -> None:
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
    free, slack = size * len(letters), len(pairs)
    table = _Rows(free + slack + len(letters))
    for index, one in enumerate(linear):
        own = np.arange(size * index, size * (index + 1))
        table.add([(own, one.matrix), (np.array([free + slack + index]), -one.scale[:, None])], one.bound)
    for number, (first, second) in enumerate(pairs):
        ends = tolerances[letters[first]].sign.knots[-1]
        begins = tolerances[letters[second]].sign.knots[0]
        for sign in (1.0, -1.0):
            unit = sign * np.eye(size)
            columns = [np.arange(size * index, size * (index + 1)) for index in (first, second)]
            travel = (np.array([free + number]), -np.ones((size, 1)))
            table.add([(columns[0], unit), (columns[1], -unit), travel], sign * (begins - ends))
    counts = np.array([frequencies.get(letter, 1) for letter in letters])
    share = counts / counts.sum()
    price = np.concatenate(
        [
            np.zeros(free),
            [share[first] * share[second] for first, second in pairs],
            np.full(len(letters), _BEYOND),
        ]
    )
    lower = np.concatenate([*(one.lower for one in linear), np.zeros(slack + len(letters))])
    upper = np.concatenate([*(one.upper for one in linear), np.full(slack + len(letters), np.inf)])
    found = linprog(price, A_ub=table.matrix(), b_ub=table.bounds(), bounds=np.column_stack([lower, upper]))
    if not found.success:
        raise LutError("no_posture", f"expected a linear program with a solution, got: {found.message}")
    rows = found.x[:free].reshape(len(letters), size)
    return dict(zip(letters, rows, strict=True))


class _Rows:
    """Inequalities of a sparse linear program, block by block."""

    def __init__(self, columns: int) -> None:
        self._columns, self._height = columns, 0
        self._entries: list[tuple[NDArray[np.intp], NDArray[np.intp], Array]] = []
        self._bounds: list[Array] = []

    def add(self, blocks: Sequence[tuple[NDArray[np.intp], Array]], bound: Array) -> None:
        """Add rows whose sum of blocks, each for some columns, is at most a bound. Shape (r,)."""
        for columns, block in blocks:
            row, column = np.nonzero(block)
            self._entries.append((row + self._height, columns[column], block[row, column]))
        self._bounds.append(bound)
        self._height += len(bound)

    def matrix(self) -> coo_matrix:
        """All rows."""
        rows, columns, values = (np.concatenate(part) for part in zip(*self._entries, strict=True))
        return coo_matrix((values, (rows, columns)), shape=(self._height, self._columns))

    def bounds(self) -> Array:
        """Their bounds."""
        return np.concatenate(self._bounds)
