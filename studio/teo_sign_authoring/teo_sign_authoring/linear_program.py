# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The linear programs by which letters and words are made quicker, one after the other.

Tolerances are curved, so that programs follow each other, each within a shorter distance of the last
(sequential linear programming, F. Palacios-Gomez, L. Lasdon, M. Engquist, Management Science 28, 1982).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog
from scipy.sparse import coo_matrix

from teo_common.arrays import Array
from teo_signs.errors import LutError

# Price of being beyond a tolerance by its whole size, where a second of time or a radian of travel costs 1:
# nothing gained by it is worth it, but a program that is infeasible would end the search.
BEYOND = 10.0

# Directions in which a turn or shift is bounded: the faces, edges and corners of a cube.
DIRECTIONS = np.array([row for row in product((-1.0, 0.0, 1.0), repeat=3) if any(row)])
DIRECTIONS /= np.linalg.norm(DIRECTIONS, axis=1, keepdims=True)

Block = tuple[Sequence[int] | NDArray[np.intp], Array]


class LinearProgram:
    """A sparse linear program, grown block by block: free variables first, then those that have a price."""

    def __init__(self, free: int) -> None:
        """Begin with so many free variables."""
        self._height = 0
        self._prices: list[float] = [0.0] * free
        self._least: list[float] = []
        self._entries: list[tuple[NDArray[np.intp], NDArray[np.intp], Array]] = []
        self._bounds: list[Array] = []

    def variable(self, price: float, *, least: float = 0.0) -> int:
        """Add a variable that is to be small; return its index.

        Args:
            price: Of one unit of it.
            least: The least that it may be.
        """
        self._prices.append(price)
        self._least.append(least)
        return len(self._prices) - 1

    def add(self, blocks: Sequence[Block], bound: Array) -> None:
        """Add rows whose sum of blocks, each for some variables, is at most a bound. Shape (r,)."""
        for variables, block in blocks:
            row, column = np.nonzero(block)
            self._entries.append((row + self._height, np.asarray(variables)[column], block[row, column]))
        self._bounds.append(np.atleast_1d(bound))
        self._height += len(self._bounds[-1])

    def add_distance(self, blocks: Sequence[Block], away: Array, most: int) -> None:
        """Add rows by which a variable is no less than distances: `away` plus the sum of the blocks.

        Args:
            blocks: How the distances change with some variables.
            away: The distances where these are zero, of either sign. Shape (r,).
            most: Index of the variable.
        """
        for sign in (1.0, -1.0):
            signed: list[Block] = [(variables, sign * block) for variables, block in blocks]
            self.add([*signed, ([most], -np.ones((len(away), 1)))], -sign * away)

    def solved(self, lower: Array, upper: Array) -> Array:
        """The free variables within their bounds for which the price of the others is least.

        Raises:
            LutError: "no_posture" if the solver finds nothing.
        """
        rows, columns, values = (np.concatenate(part) for part in zip(*self._entries, strict=True))
        matrix = coo_matrix((values, (rows, columns)), shape=(self._height, len(self._prices)))
        bounds = np.column_stack(
            [np.concatenate([lower, self._least]), np.concatenate([upper, np.full(len(self._least), np.inf)])]
        )
        found = linprog(self._prices, A_ub=matrix.tocsr(), b_ub=np.concatenate(self._bounds), bounds=bounds)
        if not found.success:
            raise LutError("no_posture", f"expected a linear program with a solution, got: {found.message}")
        return np.asarray(found.x[: len(lower)])
