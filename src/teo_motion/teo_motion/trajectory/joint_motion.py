# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Motion of joints as pieces of constant jerk: exact at any time, with exact extremes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array


class Extremes(NamedTuple):
    """The most that motions reach, either way; each of the shape of the pieces without their last axis."""

    least: Array
    """Position [rad]."""
    greatest: Array
    """Position [rad]."""
    velocity: Array
    """Size [rad/s]."""
    acceleration: Array
    """Size [rad/s^2]."""
    jerk: Array
    """Size [rad/s^3]."""


class Pieces(NamedTuple):
    """Pieces of constant jerk, of any shape; each array gives a number for each piece.

    Attributes:
        lengths: How long each piece lasts [s].
        positions: At its beginning [rad].
        velocities: There [rad/s].
        accelerations: There [rad/s^2].
        jerks: During the piece [rad/s^3].
    """

    lengths: Array
    positions: Array
    velocities: Array
    accelerations: Array
    jerks: Array

    def after(self, times: Array) -> tuple[Array, Array, Array]:
        """Position, velocity and acceleration so long after the beginning of each piece."""
        p, v, a, j, t = self.positions, self.velocities, self.accelerations, self.jerks, times
        return p + t * (v + t * (a / 2.0 + t * j / 6.0)), v + t * (a + t * j / 2.0), a + t * j

    def peaks(self) -> Array:
        """Time within each piece at which its acceleration is zero, else 0 [s]."""
        with np.errstate(divide="ignore", invalid="ignore"):
            peak = -self.accelerations / self.jerks
        inside = np.isfinite(peak) & (peak > 0.0) & (peak < self.lengths)
        return np.where(inside, peak, 0.0)

    def _turns(self) -> Array:
        """Times within each piece at which its velocity is zero, else 0 [s]. Shape (2, ...)."""
        v, a, j = self.velocities, self.accelerations, self.jerks
        with np.errstate(divide="ignore", invalid="ignore"):
            # The quadratic's roots in the form that loses no digits, and is right without jerk too.
            q = -(a + np.copysign(np.sqrt(a**2 - 2.0 * j * v), a))
            turns = np.stack([q / j, 2.0 * v / q])
        inside = np.isfinite(turns) & (turns > 0.0) & (turns < self.lengths)
        return np.where(inside, turns, 0.0)

    def range(self) -> tuple[Array, Array]:
        """Least and greatest position along the last axis [rad]."""
        times = np.empty((3, *self.lengths.shape))
        times[0], times[1:] = self.lengths, self._turns()
        p, v, a, j, t = self.positions, self.velocities, self.accelerations, self.jerks, times
        reached = p + t * (v + t * (a / 2.0 + t * (j / 6.0)))
        first = p[..., 0]
        return np.minimum(reached.min(axis=(0, -1)), first), np.maximum(reached.max(axis=(0, -1)), first)

    def extremes(self) -> Extremes:
        """The most that is reached along the last axis, also between any samples."""
        least, greatest = self.range()
        times = np.stack([np.zeros_like(self.lengths), self.lengths, self.peaks()])
        _, velocity, acceleration = self.after(times)
        return Extremes(
            least=least,
            greatest=greatest,
            velocity=np.abs(velocity).max(axis=(0, -1)),
            acceleration=np.abs(acceleration).max(axis=(0, -1)),
            jerk=np.abs(self.jerks).max(axis=-1),
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class JointMotion:
    """The motion of one joint.

    Attributes:
        starts: When each piece begins [s], strictly increasing, the first at 0. Shape (n,).
        pieces: The pieces. Shape (n,).
    """

    starts: Array
    pieces: Pieces

    @property
    def duration(self) -> float:
        """When the last piece ends [s]."""
        return float(self.starts[-1] + self.pieces.lengths[-1])

    def at(self, times: Array) -> tuple[Array, Array, Array]:
        """Position, velocity and acceleration at given times; before and after the motion, of its ends.

        Args:
            times: [s]. Shape (k,).

        Returns:
            [rad], [rad/s], [rad/s^2]; shape (k,) each.
        """
        times = np.clip(times, 0.0, self.duration)
        index = np.searchsorted(self.starts, times, side="right") - 1
        return take(self.pieces, index).after(times - self.starts[index])

    def extremes(self) -> Extremes:
        """The most that the motion reaches, also between any samples."""
        return self.pieces.extremes()


def take(pieces: Pieces, index: NDArray[np.intp] | int | tuple[Any, ...]) -> Pieces:
    """Some of the pieces, by an index as arrays take it."""
    return Pieces(*(values[index] for values in pieces))


def standing(positions: Array) -> Pieces:
    """One piece for each position [rad], in which a joint stands still there for a second. Shape (..., 1)."""
    zero = np.zeros((*positions.shape, 1))
    return Pieces(np.ones_like(zero), positions[..., None], zero, zero, zero)


def begins(start: float, pieces: Pieces) -> Array:
    """When each piece begins if they follow one another along the last axis from a time on [s]."""
    times: Array = start + np.cumsum(pieces.lengths, axis=-1) - pieces.lengths
    return times


def in_a_row(parts: Sequence[Pieces]) -> Pieces:
    """Pieces that follow one another along the last axis."""
    return Pieces(*(np.concatenate(values, axis=-1) for values in zip(*parts, strict=True)))


def in_order(starts: Array, pieces: Pieces, duration: float) -> JointMotion:
    """The motion of a joint, each piece of which ends where the next begins.

    Args:
        starts: When each piece begins [s]. Shape (n,).
        pieces: The pieces, of which those of no length are left out. Shape (n,).
        duration: When the last one ends [s].
    """
    lasting = np.flatnonzero(pieces.lengths > 0.0)
    starts = starts[lasting]
    # Sums in another order differ in the last digits: where a piece would begin at or after the next one, it
    # is left out too.
    keep = np.append(starts[:-1] < np.minimum.accumulate(starts[:0:-1])[::-1], True)
    starts = starts[keep]
    kept = take(pieces, lasting[keep])._replace(lengths=np.diff(starts, append=duration))
    return JointMotion(starts=starts, pieces=kept)


def motion_of(parts: Sequence[tuple[float, Pieces]], duration: float) -> JointMotion:
    """The motion of a joint, part after part, that ends at a time [s].

    Args:
        parts: When each part begins [s], and its pieces, which follow one another. Shape (k,) each. The last
            piece of a part lasts until the next part begins.
        duration: When the last part ends [s].
    """
    starts = np.concatenate([begins(start, pieces) for start, pieces in parts])
    return in_order(starts, in_a_row([pieces for _, pieces in parts]), duration)
