# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How near parts of the robot come to each other along a motion, in its frames and between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_sign_capture.retarget.collision_terms import LEAST, CollisionModel, between

# [rad] A posture that moves by less keeps its distances to a tenth of a millimetre.
_STILL = 1e-4
# [m] Distances are measured wherever the hands have moved by this on the way between two frames: no hand, 3
# cm thick, is passed unseen.
_SAMPLE_STEP = 0.03
# [m] On these ways parts are at least so far apart: what curves between knots need is left.
_ON_WAY = 0.004


@dataclass(frozen=True, kw_only=True, eq=False)
class ClearanceSamples:
    """Distances along a motion, in its frames and on the straight ways between them.

    Attributes:
        frames: The frame, or the one from which the way begins. Shape (k,).
        shares: Of the way that is behind; 0 in a frame. Shape (k,).
        distances: Smallest one between parts of the robot [m]. Shape (k,).
        arms: At which they were measured [rad]. Shape (T, m).
    """

    frames: NDArray[np.intp]
    shares: Array
    distances: Array
    arms: Array

    @property
    def in_frames(self) -> Array:
        """Shape (T,) [m]."""
        distances: Array = self.distances[self.shares == 0.0]
        return distances

    @property
    def short(self) -> Array:
        """By how much each distance falls short of the least one there; negative where it does not [m]."""
        short: Array = np.where(self.shares == 0.0, LEAST, _ON_WAY) - self.distances
        return short

    @property
    def tight(self) -> NDArray[np.bool_]:
        """The frames that are too near to something, or from or to which the way is. Shape (T,)."""
        tight = np.zeros(len(self.arms), bool)
        at = self.short > 0.0
        tight[self.frames[at]] = True
        tight[self.frames[at & (self.shares > 0.0)] + 1] = True
        return tight


def sample_clearance(
    model: CollisionModel, arms: Array, known: ClearanceSamples | None = None
) -> ClearanceSamples:
    """Measure a motion; what has not moved since it was known is not measured again."""
    every = np.arange(len(arms))
    in_frames = _distances(model, arms, every, np.zeros(len(arms)), known)
    ways = model.ways(arms)
    # Half way at the latest, a part is as near to one end of its way as to the other.
    surely_clear = np.minimum(in_frames[:-1], in_frames[1:]) - ways / 2.0 >= _ON_WAY
    counts = np.append(np.where(surely_clear, 1, np.maximum(np.ceil(ways / _SAMPLE_STEP), 1)), 1).astype(
        np.intp
    )
    frames = np.repeat(every, counts)
    shares = (np.arange(len(frames)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[frames]
    distances = in_frames[frames]
    inner = shares > 0.0
    distances[inner] = _distances(model, arms, frames[inner], shares[inner], known)
    return ClearanceSamples(frames=frames, shares=shares, distances=distances, arms=arms)


def _distances(
    model: CollisionModel,
    arms: Array,
    frames: NDArray[np.intp],
    shares: Array,
    known: ClearanceSamples | None,
) -> Array:
    """Smallest distances on the ways from frames to the next [m]. Shape (k,) each."""
    postures = between(arms, frames, shares)
    measured: dict[tuple[int, float], float] = {}
    if known is not None:
        still = np.abs(postures - between(known.arms, frames, shares)).max(axis=1, initial=0.0) <= _STILL
        keys = zip(known.frames.tolist(), known.shares.tolist(), strict=True)
        before = dict(zip(keys, known.distances.tolist(), strict=True))
        here = zip(frames[still].tolist(), shares[still].tolist(), strict=True)
        measured = {key: before[key] for key in here if key in before}
    samples = zip(frames.tolist(), postures, shares.tolist(), strict=True)
    return np.array(
        [
            measured[frame, share]
            if (frame, share) in measured
            else model.clearance(frame, posture, share).distance
            for frame, posture, share in samples
        ]
    )
