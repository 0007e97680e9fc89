# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What arms keep to: bounds, arms at ease, arms seen in a mirror. Both arms are solved for as right arms.

An arm of six joints reaches a pose of the hand in few ways, one of seven may turn its elbow about the line
from shoulder to wrist. Bounds and the arm at ease keep it where a person has it.
"""

from __future__ import annotations

from functools import cache
from typing import Literal

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid

Bounds = tuple[Array, Array]
Side = Literal["right", "left"]

# Distance kept from every limit, so that a planner may overshoot by its rounding [rad].
MARGIN = np.radians(1.0)
# Starts of a search on an arm for which none are given: more find no better arm for one in a hundred of the
# scores' postures.
_SAMPLED = 32
# Joints that hold a hand in space, and no more.
_WITHOUT_CHOICE = 6


@cache
def arm_bounds(humanoid: Humanoid, side: Side | Literal["both"]) -> Bounds:
    """Lower and upper bounds kept by an arm of j joints, seen as a right arm [rad]. Shapes (j,).

    Args:
        humanoid: Whose arm.
        side: Which arm; "both" for a right arm that the left one can mirror.
    """
    if side == "both":
        (right_lower, right_upper), (left_lower, left_upper) = (
            arm_bounds(humanoid, "right"),
            arm_bounds(humanoid, "left"),
        )
        return np.maximum(right_lower, left_lower), np.minimum(right_upper, left_upper)
    limits = humanoid.limits(humanoid.arm(side))
    lower, upper = limits.lower, limits.upper
    if side == "left":
        ends = np.stack([mirrored(humanoid, lower), mirrored(humanoid, upper)])
        lower, upper = ends.min(axis=0), ends.max(axis=0)
    natural = humanoid.file.natural_arm
    return (
        np.maximum(lower, np.radians(natural.lower_deg)) + MARGIN,
        np.minimum(upper, np.radians(natural.upper_deg)) - MARGIN,
    )


def mirrored(humanoid: Humanoid, arm: Array) -> Array:
    """The arm, or arms, of the other side that mirror some [rad]. Shape (j,) or (n, j)."""
    swapped: Array = _signs(humanoid) * arm
    return swapped


def mirrored_hand(humanoid: Humanoid, axes: Array) -> Array:
    """Axes of a left hand that mirrors a right one, or the reverse [rad]. Shape (axes,) or (n, axes)."""
    swapped: Array = _hand_signs(humanoid) * axes
    return swapped


@cache
def easy_arm(humanoid: Humanoid) -> Array:
    """A right arm that signs at ease [rad]. Shape (j,)."""
    arms = humanoid.file.signing_arms
    return _waiting(humanoid) if arms is None else np.radians(arms.easy_deg)


def with_elbow_out(humanoid: Humanoid, bounds: Bounds) -> Bounds | None:
    """Bounds in which the upper arm is no nearer to the body than at ease; None of an arm without a choice.

    An arm of six joints or fewer holds a hand in one way, or a few. The elbow of one with more is free, and
    may be led off a body that it would touch.

    Args:
        humanoid: Whose right arm.
        bounds: Which to narrow [rad].
    """
    easy, joints = easy_arm(humanoid), humanoid.arm("right")
    if len(easy) <= _WITHOUT_CHOICE:
        return None
    lower, upper = bounds[0].copy(), bounds[1].copy()
    for joint, share in humanoid.file.detour.sideways.items():
        row = joints.index(joint)
        if share < 0.0:
            upper[row] = min(upper[row], easy[row])
        else:
            lower[row] = max(lower[row], easy[row])
    return lower, upper


@cache
def spelling_arm(humanoid: Humanoid) -> Array:
    """A right arm that spells at ease [rad]. Shape (j,)."""
    arms = humanoid.file.signing_arms
    return _waiting(humanoid) if arms is None else np.radians(arms.spelling_deg)


@cache
def search_starts(humanoid: Humanoid) -> Array:
    """Right arms from which a posture is sought, the one at ease first [rad]. Shape (s, j)."""
    arms = humanoid.file.signing_arms
    if arms is not None:
        return np.vstack([easy_arm(humanoid), np.radians([arms.spelling_deg, *arms.starts_deg])])
    from scipy.stats import qmc  # here: a second that robots whose arms have given starts do without

    lower, upper = arm_bounds(humanoid, "right")
    # Evenly spread, the same ones each time (J. H. Halton, Numerische Mathematik 2, 1960).
    spread = qmc.Halton(len(lower), scramble=False).random(_SAMPLED)
    return np.vstack([easy_arm(humanoid), lower + spread * (upper - lower)])


def _waiting(humanoid: Humanoid) -> Array:
    waiting: Array = humanoid.ready[humanoid.columns(humanoid.arm("right"))]
    return waiting


@cache
def _hand_signs(humanoid: Humanoid) -> Array:
    return humanoid.mirror_signs(humanoid.hand("right"))


@cache
def _signs(humanoid: Humanoid) -> Array:
    return humanoid.mirror_signs(humanoid.arm("right"))
