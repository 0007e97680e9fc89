# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Hands that would go into TEO's body, or into each other, are moved off, in the frames and between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, maximum_filter1d

from teo_common.arrays import Array
from teo_sign_capture.retarget.arm_kinematics import Bounds
from teo_sign_capture.retarget.arm_residuals import ArmProblem
from teo_sign_capture.retarget.arm_trajectory import TRUSTED, refine_arms
from teo_sign_capture.retarget.collision_terms import (
    LEAST,
    WANTED,
    WATCHED,
    CollisionModel,
    CollisionTerms,
    between,
)
from teo_sign_capture.tracks.skeleton_track import Flags
from teo_sign_capture.tracks.smoothing import runs
from teo_signs.errors import LutError

# [rad] A posture that moves by less keeps its distances to a tenth of a millimetre.
_STILL = 1e-4
# [m] Distances are measured wherever the hands have moved by this on the way between two frames: no hand, 3
# cm thick, is passed unseen.
_SAMPLE_STEP = 0.03
# [m] On these ways parts are at least so far apart: what curves between knots need is left.
_ON_WAY = 0.004


@dataclass(frozen=True, kw_only=True, eq=False)
class _ClearanceSamples:
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
    def tight(self) -> Flags:
        """The frames that are too near to something, or from or to which the way is. Shape (T,)."""
        tight = np.zeros(len(self.arms), bool)
        at = self.short > 0.0
        tight[self.frames[at]] = True
        tight[self.frames[at & (self.shares > 0.0)] + 1] = True
        return tight


def _sample_clearance(
    model: CollisionModel, arms: Array, known: _ClearanceSamples | None = None
) -> _ClearanceSamples:
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
    return _ClearanceSamples(frames=frames, shares=shares, distances=distances, arms=arms)


def _distances(
    model: CollisionModel,
    arms: Array,
    frames: NDArray[np.intp],
    shares: Array,
    known: _ClearanceSamples | None,
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


# Most passes. Each finds anew what is near and solves what still touches; after three most hands are off.
_PASSES = 30
# Passes after which what still touches begins anew: from hands that are away from everything, each on the
# side of the other on which the person's is (hands that have gone into each other are pushed to the wrong
# side; hands that come from outside stay on theirs; eight passes bring them back), and from the nearest
# moments that do not touch, where what is wanted counts less.
_SPREAD_AFTER, _RESTART_AFTER = 3, 11
# [rad] A pass turns no joint by more once hands come from outside, so that none skips through the other.
_CAREFUL = np.radians(6.0)
# [rad] Hands that come from outside are where they belong when a pass turns no joint by more.
_SETTLED = np.radians(2.0)
# [s] Time before and after what touches that is solved with it: as long as a way aside takes.
_GIVE = 0.35
# Passes at the end over all that was moved, the first of which may have moved some of it too far.
_EASED = 1
# [m] Distance within which parts are watched then: what one pass may bring them nearer.
_SEEN_FROM = 0.06
# Share of `_OPEN` that moves no hand by more than 1 cm.
_FAINT = 0.01
# Factor on what is wanted, each time a frame begins anew, and frames before and after that get it as well.
_LESS, _AROUND = 0.3, 2
# [m] Distance at which hands that come from outside begin: TEO's forearms and hands are 10 cm thick.
_OPEN = 0.25
# [s] Deviation of the Gaussian by which arms go away from everything and come back: as swift as a person.
_OPENING = 0.12


def clear_arms(
    problem: ArmProblem,
    model: CollisionModel,
    times: Array,
    bounds: list[Bounds],
    arms: Array,
    *,
    source: str,
) -> tuple[Array, Array]:
    """Move a motion of the arms off all that it would touch.

    Args:
        problem: What is wanted of the arms.
        model: The robot, which must not touch itself.
        times: Of the frames [s]. Shape (T,).
        bounds: Of each arm [rad].
        arms: Shape (T, m) [rad].
        source: Name of the recording, for errors.

    Returns:
        The arms, and the smallest distance between parts of the robot in each frame [m], shape (T,). Straight
        ways between frames are clear as well if any way was found on which they are.

    Raises:
        LutError: "self_collision" where no way off is found.
    """
    work = _Clearing(problem, model, times, bounds)
    wished, count = arms, len(arms)
    samples = best = _sample_clearance(model, arms)
    shares, careful, moved = np.ones(count), np.zeros(count, bool), np.zeros(count)
    touched = np.zeros(count, bool)
    for turn in range(_PASSES):
        unsettled = careful & (moved >= _SETTLED) & (turn < _RESTART_AFTER)
        at_work = _widened(times, samples.tight | unsettled)
        if not at_work.any():
            break
        if turn == _SPREAD_AFTER:
            around = _around(times, samples.tight)
            at_work = careful = around > _FAINT
            samples = work.spread_apart(samples, wished, around, at_work)
        if turn >= _RESTART_AFTER:
            shares = shares * np.where(maximum_filter1d(samples.tight, 2 * _AROUND + 1), _LESS, 1.0)
            samples = _sample_clearance(model, _begun_anew(samples.arms, samples.tight), samples)
        before, touched = samples.arms, touched | at_work
        samples = work.passed(samples, at_work, careful, shares)
        moved = np.abs(samples.arms - before).max(axis=1)
        best = min(samples, best, key=_shortfall)
    for _ in range(_EASED if touched.any() else 0):
        samples = work.passed(best, touched, touched, shares)
        if _shortfall(samples) > _shortfall(best):
            break
        best = samples
    worst = int(best.in_frames.argmin())
    if best.in_frames[worst] >= LEAST:
        return best.arms, best.in_frames
    found = model.clearance(worst, best.arms[worst])
    raise LutError(
        "self_collision",
        f"{source}: expected a posture that TEO can take at {times[worst]:.2f} s, got one in "
        f"which {found.first} comes within {1000.0 * found.distance:.0f} mm of {found.second} (at least "
        f"{1000.0 * LEAST:.0f}) however it is moved: leave this part out, or show the sign farther from the "
        "body",
    )


class _Clearing:
    """One motion that is being cleared: solves runs of its frames anew."""

    def __init__(
        self, problem: ArmProblem, model: CollisionModel, times: Array, bounds: list[Bounds]
    ) -> None:
        self._problem = problem
        self._model = model
        self._times = times
        self._bounds = bounds

    def spread_apart(
        self, samples: _ClearanceSamples, wished: Array, around: Array, at_work: Flags
    ) -> _ClearanceSamples:
        """Hands away from everything in the frames at work, by a share in each, from how they were wished."""
        start = np.where(at_work[:, None], wished, samples.arms)
        arms = self._solved(self._problem.spread_apart(_OPEN * around), start, at_work)
        return _sample_clearance(self._model, arms, samples)

    def passed(
        self,
        samples: _ClearanceSamples,
        at_work: Flags,
        careful: Flags,
        shares: Array,
    ) -> _ClearanceSamples:
        """The frames at work off what they touch, as far as one pass goes."""
        last = np.minimum(samples.frames + (samples.shares > 0.0), len(at_work) - 1)
        near = samples.distances < np.where(careful[samples.frames], _SEEN_FROM, 2.0 * WANTED)
        near &= at_work[samples.frames] | at_work[last]
        within = _SEEN_FROM if (careful & at_work).any() else WATCHED
        terms = self._model.terms(samples.frames[near], samples.arms, samples.shares[near], within=within)
        trusted: Array = np.asarray(np.where(careful, _CAREFUL, TRUSTED), dtype=np.float64)
        arms = self._solved(self._problem, samples.arms, at_work, terms=terms, shares=shares, trusted=trusted)
        return _sample_clearance(self._model, arms, samples)

    def _solved(
        self,
        problem: ArmProblem,
        arms: Array,
        at_work: Flags,
        *,
        terms: CollisionTerms | None = None,
        shares: Array | None = None,
        trusted: Array | None = None,
    ) -> Array:
        """The arms with each run of frames at work solved anew, the frames before and after it held."""
        found = arms.copy()
        for first, last in runs(at_work):
            part = slice(max(first - 1, 0), min(last + 2, len(arms)))
            found[part] = refine_arms(
                problem.between(part),
                self._times[part],
                self._bounds,
                arms[part],
                terms=None if terms is None else terms.between(part),
                shares=None if shares is None else shares[part],
                trusted=TRUSTED if trusted is None else trusted[part, None],
                held=~at_work[part],
            )
        return found


def _widened(times: Array, frames: Flags) -> Flags:
    """Some frames, and what is solved with them."""
    chosen = times[frames]
    if not chosen.size:
        return frames
    widened: Flags = np.abs(times[:, None] - chosen).min(axis=1) <= _GIVE
    return widened


def _shortfall(samples: _ClearanceSamples) -> tuple[float, float]:
    """Frames first, then what is between."""
    return max(LEAST - float(samples.in_frames.min()), 0.0), max(float(samples.short.max()), 0.0)


def _around(times: Array, tight: Flags) -> Array:
    """1 where a motion is tight, falling to 0 before and after. Shape (T,)."""
    width = _OPENING / float(np.median(np.diff(times))) if len(times) > 1 else 1.0
    wide = maximum_filter1d(tight.astype(float), 2 * int(np.ceil(width)) + 1, mode="constant")
    around: Array = gaussian_filter1d(wide, width, mode="nearest")
    return around


def _begun_anew(arms: Array, tight: Flags) -> Array:
    """The arms with each posture that is tight replaced by the nearest in time that is not."""
    clear = np.flatnonzero(~tight)
    if not clear.size:
        return arms
    nearest = clear[np.abs(np.arange(len(arms))[:, None] - clear).argmin(axis=1)]
    begun: Array = arms[nearest]
    return begun
