"""Hands that would go into TEO's body, or into each other, are moved off, in the frames and between them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, maximum_filter1d

from teo_sign_capture.retarget.arm_bounds import Bounds
from teo_sign_capture.retarget.arm_residuals import ArmProblem
from teo_sign_capture.retarget.arm_trajectory import TRUSTED, refine_arms
from teo_sign_capture.retarget.clearance_samples import Looks, look
from teo_sign_capture.retarget.collision_terms import LEAST, WANTED, WATCHED, Touches, WholeRobot
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_signs.errors import LutError

Array = NDArray[np.float64]

_PASSES = 30
"""Each finds anew what is near, and solves what still touches with it; after three most hands are off."""
_OPENED, _PUSHED = 3, 11
"""Passes after which what still touches begins anew: from hands that are away from everything, each on the
side of the other on which the person's is (hands that have gone into each other are pushed to the wrong side;
hands that come from outside stay on theirs; eight passes bring them back), and from the nearest moments that
do not touch, where what is wanted counts less."""
_CAREFUL = np.radians(6.0)
"""[rad] A pass turns no joint by more once hands come from outside, so that none skips through the other."""
_SETTLED = np.radians(2.0)
"""[rad] Hands that come from outside are where they belong when a pass turns no joint by more."""
_GIVE = 0.35
"""[s] So much before and after what touches is solved with it: as long as a way aside takes."""
_EASED = 1
"""Passes at the end over all that was moved, the first of which may have moved some of it too far."""
_SEEN_FROM = 0.06
"""[m] So far from each other parts are watched then: what a pass may bring them nearer."""
_FAINT = 0.01
"""Share of this that moves no hand by more than 1 cm."""
_LESS, _AROUND = 0.3, 2
"""By how much less each time, and in how many frames before and after as well."""
_OPEN = 0.25
"""[m] So far apart hands begin then: TEO's forearms and hands are 10 cm thick."""
_OPENING = 0.12
"""[s] Deviation of the Gaussian by which arms go away from everything and come back: as swift as a person."""


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
    work = _Work(problem, whole, track.times, bounds)
    wished, count = arms, len(arms)
    looks = best = look(whole, arms)
    shares, careful, moved = np.ones(count), np.zeros(count, bool), np.zeros(count)
    touched = np.zeros(count, bool)
    for turn in range(_PASSES):
        unsettled = careful & (moved >= _SETTLED) & (turn < _PUSHED)
        at_work = _widened(track.times, looks.tight | unsettled)
        if not at_work.any():
            break
        if turn == _OPENED:
            around = _around(track.times, looks.tight)
            at_work = careful = around > _FAINT
            looks = work.opened(looks, wished, around, at_work)
        if turn >= _PUSHED:
            shares = shares * np.where(maximum_filter1d(looks.tight, 2 * _AROUND + 1), _LESS, 1.0)
            looks = look(whole, _begun_anew(looks.arms, looks.tight), looks)
        before, touched = looks.arms, touched | at_work
        looks = work.passed(looks, at_work, careful, shares)
        moved = np.abs(looks.arms - before).max(axis=1)
        best = min(looks, best, key=_badness)
    for _ in range(_EASED if touched.any() else 0):
        looks = work.passed(best, touched, touched, shares)
        if _badness(looks) > _badness(best):
            break
        best = looks
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


class _Work:
    """What is solved anew, and with what."""

    def __init__(self, problem: ArmProblem, whole: WholeRobot, times: Array, bounds: list[Bounds]) -> None:
        self._problem = problem
        self._whole = whole
        self._times = times
        self._bounds = bounds

    def opened(self, looks: Looks, wished: Array, around: Array, at_work: NDArray[np.bool_]) -> Looks:
        """Hands away from everything in the frames at work, by a share in each, from how they were wished."""
        start = np.where(at_work[:, None], wished, looks.arms)
        arms = self._solved(self._problem.opened(_OPEN * around), start, at_work)
        return look(self._whole, arms, looks)

    def passed(
        self, looks: Looks, at_work: NDArray[np.bool_], careful: NDArray[np.bool_], shares: Array
    ) -> Looks:
        """The frames at work off what they touch, as far as one pass goes."""
        last = np.minimum(looks.frames + (looks.shares > 0.0), len(at_work) - 1)
        near = looks.distances < np.where(careful[looks.frames], _SEEN_FROM, 2.0 * WANTED)
        near &= at_work[looks.frames] | at_work[last]
        within = _SEEN_FROM if (careful & at_work).any() else WATCHED
        touches = self._whole.touches(looks.frames[near], looks.arms, looks.shares[near], within=within)
        trusted: Array = np.asarray(np.where(careful, _CAREFUL, TRUSTED), dtype=np.float64)
        arms = self._solved(
            self._problem, looks.arms, at_work, touches=touches, shares=shares, trusted=trusted
        )
        return look(self._whole, arms, looks)

    def _solved(
        self,
        problem: ArmProblem,
        arms: Array,
        at_work: NDArray[np.bool_],
        *,
        touches: Touches | None = None,
        shares: Array | None = None,
        trusted: Array | None = None,
    ) -> Array:
        """The arms with each run of frames at work solved anew, the frames before and after it held."""
        found = arms.copy()
        ends = np.flatnonzero(np.diff(np.concatenate([[False], at_work, [False]])))
        for start, stop in ends.reshape(-1, 2).tolist():
            part = slice(max(start - 1, 0), min(stop + 1, len(arms)))
            found[part] = refine_arms(
                problem.between(part),
                self._times[part],
                self._bounds,
                arms[part],
                touches=None if touches is None else touches.between(part),
                shares=None if shares is None else shares[part],
                trusted=TRUSTED if trusted is None else trusted[part, None],
                held=~at_work[part],
            )
        return found


def _widened(times: Array, frames: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Some frames, and what is solved with them."""
    chosen = times[frames]
    if not chosen.size:
        return frames
    widened: NDArray[np.bool_] = np.abs(times[:, None] - chosen).min(axis=1) <= _GIVE
    return widened


def _badness(looks: Looks) -> tuple[float, float]:
    """Frames first, then what is between."""
    return max(LEAST - float(looks.in_frames.min()), 0.0), max(float(looks.short.max()), 0.0)


def _around(times: Array, tight: NDArray[np.bool_]) -> Array:
    """1 where a motion is tight, falling to 0 before and after. Shape (T,)."""
    width = _OPENING / float(np.median(np.diff(times))) if len(times) > 1 else 1.0
    wide = maximum_filter1d(tight.astype(float), 2 * int(np.ceil(width)) + 1, mode="constant")
    around: Array = gaussian_filter1d(wide, width, mode="nearest")
    return around


def _begun_anew(arms: Array, tight: NDArray[np.bool_]) -> Array:
    """The arms with each posture that is tight replaced by the nearest in time that is not."""
    clear = np.flatnonzero(~tight)
    if not clear.size:
        return arms
    nearest = clear[np.abs(np.arange(len(arms))[:, None] - clear).argmin(axis=1)]
    begun: Array = arms[nearest]
    return begun
