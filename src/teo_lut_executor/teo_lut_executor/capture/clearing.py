"""Hands that would go into TEO's body, or into each other, are moved off, in the frames and between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, maximum_filter1d

from teo_lut_executor.capture.arm_problem import EASY, ArmProblem
from teo_lut_executor.capture.arm_trajectory import TRUSTED, Bounds, refine_arms
from teo_lut_executor.capture.skeleton_track import SkeletonTrack
from teo_lut_executor.capture.touches import LEAST, WANTED, WATCHED, WholeRobot, between
from teo_lut_executor.lut_error import LutError

Array = NDArray[np.float64]

_PASSES = 30
"""Each finds anew what is near, and solves the motion with it; after three most hands are off."""
_OPENED, _PUSHED = 3, 18
"""Passes after which what still touches begins anew: from arms that are away from everything (hands that have
gone into each other are pushed to the wrong side; hands that come from outside stay on theirs), and from the
nearest moments that do not touch, where what is wanted counts less."""
_CAREFUL = np.radians(6.0)
"""[rad] A pass turns no joint by more once hands come from outside, so that none skips through the other."""
_SETTLED = np.radians(2.0)
"""[rad] Hands that come from outside are where they belong when a pass turns no joint by more."""
_SEEN_FROM = 0.06
"""[m] So far from each other parts are watched then: what a pass may bring them nearer."""
_FAINT = 0.01
"""Share of this that moves no hand by more than 1 cm."""
_LESS, _AROUND = 0.3, 2
"""By how much less each time, and in how many frames before and after as well."""
_STILL = 1e-4
"""[rad] A posture that moves by less keeps its distances to a tenth of a millimetre."""
_LOOK = 0.03
"""[m] On a way between two frames the robot is looked at where its hands have moved by this: no hand, 3 cm
thick, is passed unseen."""
_ON_WAY = 0.004
"""[m] On these ways parts are at least so far apart: what curves between knots need is left."""
_OPENING = 0.12
"""[s] Deviation of the Gaussian by which arms go away from everything and come back: as swift as a person."""


@dataclass(frozen=True, kw_only=True, eq=False)
class _Looks:
    """Distances along a motion, in its frames and on the straight ways between them.

    Attributes:
        frames: The frame looked at, or from which the way begins. Shape (k,).
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
        """By how much each look falls short of what is asked for there; negative where it does not [m]."""
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


def clear_arms(
    problem: ArmProblem, whole: WholeRobot, track: SkeletonTrack, bounds: list[Bounds], arms: Array
) -> tuple[Array, Array]:
    """Move a motion of the arms off all that it would touch.

    Args:
        problem: What is wanted of the arms.
        whole: The robot.
        track: The person, for times and errors.
        bounds: Of each arm [rad].
        arms: Shape (T, m) [rad].

    Returns:
        The arms, and the smallest distance between parts of the robot in each frame [m], shape (T,). Straight
        ways between frames are clear as well if any way was found on which they are.

    Raises:
        LutError: "self_collision" where no way off is found.
    """
    looks = best = _look(whole, arms)
    shares, careful, moved = np.ones(len(arms)), np.zeros(len(arms), bool), np.inf
    for turn in range(_PASSES):
        if looks.short.max() <= 0.0 and (not careful.any() or moved < _SETTLED):
            break
        if turn == _OPENED:
            around = _around(track.times, looks.tight)
            arms = _opened(bounds, arms, around)
            careful, moved = around > _FAINT, np.inf
            looks = _look(whole, arms, looks)
        if turn >= _PUSHED or (careful.any() and moved < _SETTLED):
            tight = looks.tight
            arms = _begun_anew(arms, tight)
            looks = _look(whole, arms, looks)
            shares = shares * np.where(maximum_filter1d(tight, 2 * _AROUND + 1), _LESS, 1.0)
        near = looks.distances < np.where(careful[looks.frames], _SEEN_FROM, 2.0 * WANTED)
        within = _SEEN_FROM if careful.any() else WATCHED
        touches = whole.touches(looks.frames[near], arms, looks.shares[near], within=within)
        arms = refine_arms(
            problem,
            track.times,
            bounds,
            arms,
            touches=touches,
            shares=shares,
            trusted=_CAREFUL if careful.any() else TRUSTED,
        )
        moved = float(np.abs(arms - looks.arms).max())
        looks = _look(whole, arms, looks)
        best = min(looks, best, key=_badness)
    worst = int(best.in_frames.argmin())
    if best.in_frames[worst] >= LEAST:
        return best.arms, best.in_frames
    found = whole.clearance(worst, best.arms[worst])
    raise LutError(
        "self_collision",
        f"{track.source}: expected a posture that TEO can take at {track.times[worst]:.2f} s, got one in "
        f"which {found.first} comes within {1000.0 * found.distance:.0f} mm of {found.second} (at least "
        f"{1000.0 * LEAST:.0f}) however it is moved: leave this part out, or show the sign farther from the "
        "body",
    )


def _badness(looks: _Looks) -> tuple[float, float]:
    """Frames first, then what is between."""
    return max(LEAST - float(looks.in_frames.min()), 0.0), max(float(looks.short.max()), 0.0)


def _look(whole: WholeRobot, arms: Array, known: _Looks | None = None) -> _Looks:
    """Measure a motion; what has not moved since it was known is not measured again."""
    every = np.arange(len(arms))
    in_frames = _distances(whole, arms, every, np.zeros(len(arms)), known)
    ways = whole.ways(arms)
    # Half way at the latest, a part is as near to one end of its way as to the other.
    surely_clear = np.minimum(in_frames[:-1], in_frames[1:]) - ways / 2.0 >= _ON_WAY
    counts = np.append(np.where(surely_clear, 1, np.maximum(np.ceil(ways / _LOOK), 1)), 1).astype(np.intp)
    frames = np.repeat(every, counts)
    shares = (np.arange(len(frames)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[frames]
    distances = in_frames[frames]
    inner = shares > 0.0
    distances[inner] = _distances(whole, arms, frames[inner], shares[inner], known)
    return _Looks(frames=frames, shares=shares, distances=distances, arms=arms)


def _distances(
    whole: WholeRobot, arms: Array, frames: NDArray[np.intp], shares: Array, known: _Looks | None
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
    looks = zip(frames.tolist(), postures, shares.tolist(), strict=True)
    return np.array(
        [
            measured[frame, share]
            if (frame, share) in measured
            else whole.clearance(frame, posture, share).distance
            for frame, posture, share in looks
        ]
    )


def _around(times: Array, tight: NDArray[np.bool_]) -> Array:
    """1 where a motion is tight, falling to 0 before and after. Shape (T,)."""
    width = _OPENING / float(np.median(np.diff(times))) if len(times) > 1 else 1.0
    wide = maximum_filter1d(tight.astype(float), 2 * int(np.ceil(width)) + 1, mode="constant")
    around: Array = gaussian_filter1d(wide, width, mode="nearest")
    return around


def _opened(bounds: list[Bounds], arms: Array, around: Array) -> Array:
    """The arms gone, by a share in each frame, to where they are away from everything."""
    easy = np.concatenate([np.clip(EASY, *arm) for arm in bounds])
    opened: Array = arms + around[:, None] * (easy - arms)
    return opened


def _begun_anew(arms: Array, tight: NDArray[np.bool_]) -> Array:
    """The arms with each posture that is tight replaced by the nearest in time that is not."""
    clear = np.flatnonzero(~tight)
    if not clear.size:
        return arms
    nearest = clear[np.abs(np.arange(len(arms))[:, None] - clear).argmin(axis=1)]
    begun: Array = arms[nearest]
    return begun
