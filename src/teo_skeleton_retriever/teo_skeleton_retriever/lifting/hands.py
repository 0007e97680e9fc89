# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depth of a hand's points in a clip, from the lengths of its bones.

Across the view a point is good to a pixel or two. Its depth is what a detector guesses, or nothing at all.
For each bone, the depth that fits its length and the guess best is taken; the guess says above all which
way. The palm is then made rigid: one shape for all frames, laid into each (Kabsch 1976). Detectors show fists
half open and thumbs beside where they are: of what they guess, a network that was shown rendered hands tells
how thumb and fingers are bent.

`fit_hand` of teo_sign_authoring is the thorough way, for the few hands of a letter: half a second each.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.depth.hand_shape import CHILD, PARENT, turned
from teo_skeleton_retriever.lifting.clip import Points, smooth_depth
from teo_skeleton_retriever.lifting.hand_axes import INDEX, LITTLE, PALM, THUMB, WRIST, in_palm, palm_axes
from teo_skeleton_retriever.lifting.network import load_network

_BONES = len(CHILD)
# Makes a left hand a right one.
_MIRROR = np.array([1.0, -1.0, 1.0])

# [m] Lengths of an adult's bones. Metacarpals and phalanges: Buryanov and Kotiuk, "Proportions of Hand
# Segments", Int. J. Morphol. 28(3), 2010; the way from the wrist to a knuckle is that of the metacarpal and
# of 27 mm of carpal bones; to the first joint of the thumb it is 0.39 of the way to the middle knuckle, as in
# the clips of `letter_clips`.
_BONE_LENGTHS = 1e-3 * np.array(
    [
        *(36.0, 46.2, 31.6, 21.7),
        *(95.0, 39.8, 22.4, 15.8),
        *(92.0, 44.6, 26.3, 17.4),
        *(86.0, 41.4, 25.7, 17.3),
        *(81.0, 32.7, 18.1, 16.0),
    ]
)

# A bone lies across the view in some frames: its length is what 9 of 10 do not exceed.
_PERCENTILE = 90.0
# Hands are within these shares of an adult's that suits the body; what is outside was found wrong.
_SIZE = (0.75, 1.35)
# Measured length of a bone as a share of the usual one: below the first it was never seen at full length,
# above the second it was found wrong.
_LEAST_SHARE, _GREATEST_SHARE = 0.85, 1.25
# Units of the clip for a unit of its depth: pixels for pixels have 1, pixels for widths of the picture some
# hundreds.
_SCALES = np.geomspace(0.05, 20000.0, 120)
# A guess of depth must make the bones' lengths more even than none by this share, or it is noise.
_LEAST_TURN = 0.02
# [rad] A palm seems to turn at once by about so much, or more, where the detector took one side of a hand for
# the other, as it does of hands that point at the camera or are seen from their edge. To leave such a frame
# out costs as much as one turn by this: a beat turns a palm by 0.5 rad from frame to frame.
_FLIP = np.radians(90.0)
# Frames beyond which it is never cheaper to leave all out than to turn there and back by half a turn.
_LONGEST_FLIP = int(2.0 * (np.pi / _FLIP) ** 2) + 1
# [s] A hand that is lost for longer may be turned any way when it is found again.
_FORGOTTEN = 0.4
# Deviation of a bone's length as a share of it.
_LENGTH_SHARE = 0.08
# Deviation of the detector's guess of a depth as a share of the bone's length: of the palm's bones, which a
# detector sees whole, and of fingers, which hide each other. Shape (20,).
_GUESS_SHARE = np.where(np.arange(_BONES) % 4 == 0, 0.15, 0.3)
# Where there is no guess, a hand goes on as its forearm, give or take this share of a bone's length; bones of
# fingers are bent out of it to the palm's side by that share.
_NO_GUESS_SHARE, _BENT = 0.6, 0.4
# Depths that are tried, in lengths of the bone.
_STEPS = np.linspace(-1.0, 1.0, 81)
# [m/s^2] Deviation of the acceleration of a bone's end about its beginning, along the view.
_ACCELERATION = 12.0
# [m] Standard deviation of a point across the view: two pixels of a person who is 500 pixels high.
_POINT_SIGMA = 0.004


class LiftedHand(NamedTuple):
    """A hand's points relative to its wrist, forward, left and up."""

    points: FloatArray
    """[m]; NaN where not seen. Shape (T, 21, 3)."""
    sigma: FloatArray
    """Standard deviation, root mean over the axes [m]. Shape (T, 21)."""


def has_depth(hand: Points) -> bool:
    """Whether the detector guessed depths of a hand's points."""
    return bool(np.isfinite(hand.places[..., 0]).any())


def lift_hand(hand: Points, *, scale: float, period: float, right: bool, forearm: FloatArray) -> LiftedHand:
    """Find the depth of a hand's points.

    Args:
        hand: In the picture; frames in which a point is missing, or the palm flips and flips back even with
            front and back exchanged, count as not seen.
        scale: Metres for a unit of the clip.
        period: Between two frames [s].
        right: Whether it is a right hand.
        forearm: How far its forearm comes forward for each of its lengths, where the detector guesses no
            depth; may be NaN where it does. Shape (T,).
    """
    seen: BoolArray = np.asarray(hand.seen.all(axis=1))
    points = np.full((*hand.seen.shape, 3), np.nan)
    sigma = np.full(hand.seen.shape, np.nan)
    if not seen.any():
        return LiftedHand(points, sigma)
    # A left hand is lifted as the right hand that its mirror image is.
    places = hand.places[seen] * (1.0 if right else _MIRROR)
    places = places - places[:, WRIST, None]
    lengths = _bone_lengths(places, scale)
    guess = _guess(places, scale)
    if guess is not None:
        times = np.flatnonzero(seen) * np.float64(period)
        # Front taken for back: what the detector has behind the wrist is before it.
        guess[~without_flips(_palms(guess, scale * places), times)] *= -1.0
        kept = without_flips(_palms(guess, scale * places), times)
        seen[np.flatnonzero(seen)[~kept]] = False
        places, guess = places[kept], guess[kept]
    if guess is None:
        expected, share = _expected(places, forearm[seen]) * lengths, np.full(_BONES, _NO_GUESS_SHARE)
    else:
        expected, share = _bones(guess), _GUESS_SHARE
    depths, bone_sigma = _bone_depths(scale * places[..., 1:], expected, share * lengths, lengths)
    every = np.full((len(seen), _BONES), np.nan)
    every[seen] = depths
    sigmas = np.full_like(every, np.nan)
    sigmas[seen] = bone_sigma
    depths = smooth_depth(every, sigmas, period=period, acceleration=_ACCELERATION)[seen]
    lifted = np.zeros_like(places)
    lifted[..., 1:] = scale * places[..., 1:]
    spread = np.zeros(lifted.shape[:2])
    for bone, (first, second) in enumerate(zip(PARENT, CHILD, strict=True)):
        lifted[:, second, 0] = lifted[:, first, 0] + np.clip(depths[:, bone], -lengths[bone], lengths[bone])
        spread[:, second] = np.hypot(spread[:, first], bone_sigma[:, bone])
    lifted = _with_rigid_palm(lifted)
    kept = np.ones(len(lifted), dtype=np.bool_)
    if guess is not None:
        # What is smoothed into a hand that is seen from its edge may flip it once more.
        kept = without_flips(palm_axes(lifted)[..., 2], np.flatnonzero(seen) * np.float64(period))
    found = np.flatnonzero(seen)[kept]
    points[found] = lifted[kept] * (1.0 if right else _MIRROR)
    sigma[found] = np.sqrt((2.0 * _POINT_SIGMA**2 + spread[kept] ** 2) / 3.0)
    return LiftedHand(points, sigma)


# Bones beyond the palm: all of the thumb's, three of each finger.
FREE_BONES = np.array([bone for bone in range(_BONES) if bone < 4 or bone % 4])


# Three axes of the palm, too.
_HAND_INPUTS = 3 * (len(FREE_BONES) + 3)


def free_bones(hand: FloatArray) -> FloatArray:
    """Directions of the bones beyond the palm, in the palm's axes. Shapes (n, 21, 3), (n, 16, 3)."""
    bones = _bones(in_palm(hand))[:, FREE_BONES]
    ways: FloatArray = bones / np.maximum(np.linalg.norm(bones, axis=2, keepdims=True), 1e-9)
    return ways


def hand_inputs(hand: FloatArray) -> FloatArray:
    """What the network sees of a right hand: how it is bent, and how it is turned to the camera.

    Args:
        hand: The points [m]. Shape (n, 21, 3).

    Returns:
        Shape (n, 57).
    """
    return np.concatenate([free_bones(hand), palm_axes(hand)], axis=1).reshape(len(hand), _HAND_INPUTS)


def with_learned_fingers(points: FloatArray, *, right: bool) -> FloatArray:
    """A hand whose thumb and fingers are bent as people's are who look so to a detector that guesses depths.

    Args:
        points: As they were lifted; NaN where not seen [m]. Shape (T, 21, 3).
        right: Whether it is a right hand.
    """
    seen = np.isfinite(points).all(axis=(1, 2))
    hand = points[seen] * (1.0 if right else _MIRROR)
    changes = load_network("hands")(hand_inputs(hand))
    ways = free_bones(hand) + changes.reshape(len(hand), len(FREE_BONES), 3)
    ways /= np.maximum(np.linalg.norm(ways, axis=2, keepdims=True), 1e-9)
    lengths = np.linalg.norm(_bones(hand), axis=2)[:, FREE_BONES, None]
    bones = lengths * np.einsum("tij,tkj->tki", palm_axes(hand), ways)
    for at, bone in enumerate(FREE_BONES.tolist()):
        hand[:, CHILD[bone]] = hand[:, PARENT[bone]] + bones[:, at]
    bent = points.copy()
    bent[seen] = hand * (1.0 if right else _MIRROR)
    return bent


def _bone_lengths(places: FloatArray, scale: float) -> FloatArray:
    """[m] Shape (20,)."""
    longest = scale * np.percentile(np.linalg.norm(_bones(places)[..., 1:], axis=2), _PERCENTILE, axis=0)
    # Half of the bones at least lay across the view; those say how large the hand is.
    size = float(np.clip(np.percentile(longest / _BONE_LENGTHS, 60.0), *_SIZE))
    usual = size * _BONE_LENGTHS
    lengths: FloatArray = np.clip(longest, _LEAST_SHARE * usual, _GREATEST_SHARE * usual)
    return lengths


def _guess(places: FloatArray, scale: float) -> FloatArray | None:
    """The detector's depths in metres, in the unit in which bones keep their lengths best. Shape (T, 21).

    None if it gives no depth, or one with which the lengths are no more even than without.
    """
    depths = places[..., 0]
    if not np.isfinite(depths).all() or np.ptp(depths) == 0.0:
        return None
    bones = _bones(places)
    across, along = (bones[..., 1:] ** 2).sum(axis=2), bones[..., 0] ** 2

    def unevenness(unit: float) -> float:
        lengths = np.sqrt(across + unit**2 * along)
        return float((lengths.std(axis=0) / lengths.mean(axis=0)).mean())

    uneven = [unevenness(unit) for unit in _SCALES]
    best = int(np.argmin(uneven))
    if uneven[best] > (1.0 - _LEAST_TURN) * unevenness(0.0):
        return None
    return scale * float(_SCALES[best]) * depths


def without_flips(palms: FloatArray, times: FloatArray) -> BoolArray:
    """Which frames to keep so that the palm turns least and few are left out. Shape (n,).

    Args:
        palms: Ways the palm faces, unit vectors. Shape (n, 3).
        times: [s]. Shape (n,).
    """
    count = len(palms)
    if not count:
        return np.zeros(0, dtype=np.bool_)
    best, before = np.zeros(count), np.full(count, -1)
    for frame in range(count):
        best[frame] = frame  # all earlier ones left out
        earlier = np.arange(max(frame - _LONGEST_FLIP, 0), frame)
        if not len(earlier):
            continue
        turns = np.arccos(np.clip(palms[earlier] @ palms[frame], -1.0, 1.0))
        turns[times[frame] - times[earlier] > _FORGOTTEN] = 0.0
        costs = best[earlier] + (frame - 1 - earlier) + (turns / _FLIP) ** 2
        if costs.min() < best[frame]:
            best[frame], before[frame] = costs.min(), earlier[costs.argmin()]
    kept = np.zeros(count, dtype=np.bool_)
    at = int((best + np.arange(count)[::-1]).argmin())
    while at >= 0:
        kept[at] = True
        at = int(before[at])
    return kept


def _palms(depths: FloatArray, places: FloatArray) -> FloatArray:
    """Ways the palm faces. Shape (T, 3)."""
    return palm_axes(np.concatenate([depths[..., None], places[..., 1:]], axis=2))[..., 2]


def _bones(points: FloatArray) -> FloatArray:
    """The way from each bone's beginning to its end. Shapes (T, 21, ...) and (T, 20, ...)."""
    ways: FloatArray = points[:, CHILD] - points[:, PARENT]
    return ways


def _bone_depths(
    across: FloatArray, expected: FloatArray, expected_sigma: FloatArray, lengths: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """How far each bone's end is in front of its beginning, and how sure that is [m]. Shapes (T, 20)."""
    seen = np.linalg.norm(_bones(across), axis=2)
    tried = _STEPS * lengths[:, None]  # (20, steps)
    long = np.hypot(seen[..., None], tried) - lengths[:, None]
    cost = (long / (_LENGTH_SHARE * lengths[:, None])) ** 2
    cost += ((tried - expected[..., None]) / expected_sigma[:, None]) ** 2
    weights = np.exp(-0.5 * (cost - cost.min(axis=2, keepdims=True)))
    # The best depth, and the spread of all that are likely about it: two where front and back look alike.
    best = tried[np.arange(len(lengths)), cost.argmin(axis=2)]
    around = (weights * (tried - best[..., None]) ** 2).sum(axis=2) / weights.sum(axis=2)
    return best, np.sqrt(around) + _POINT_SIGMA


def _expected(places: FloatArray, forearm: FloatArray) -> FloatArray:
    """How far each bone comes forward where nobody guessed, for each of its lengths. Shape (T, 20).

    A palm that is seen has fingers that bend towards the viewer, a back of a hand has them bend away.
    """
    across = places[..., 1:]
    index, little = across[:, INDEX] - across[:, WRIST], across[:, LITTLE] - across[:, WRIST]
    palm_seen = index[:, 0] * little[:, 1] - index[:, 1] * little[:, 0] > 0.0
    bend = np.where(palm_seen, _BENT, -_BENT)
    of_finger = np.arange(_BONES) % 4 > 0
    forward = np.where(np.isfinite(forearm), forearm, 0.0)
    return np.asarray(np.clip(forward[:, None] + bend[:, None] * of_finger, -1.0, 1.0))


def _with_rigid_palm(points: FloatArray) -> FloatArray:
    """Lay one palm into all frames; the fingers go with their knuckles."""
    palm = list(PALM)
    axes = palm_axes(points)
    local = np.einsum("tij,tki->tkj", axes, points[:, palm])
    shape = np.median(local, axis=0)
    shape = shape - shape.mean(axis=0)
    middle = points[:, palm].mean(axis=1, keepdims=True)
    onto = points[:, palm] - middle
    laid = turned(np.broadcast_to(shape, onto.shape), onto, np.ones(onto.shape[:2])) + middle
    moved = points.copy()
    for at, point in enumerate(palm):
        away = laid[:, at] - points[:, point]
        last = point + 4 if point != WRIST else point + 1
        moved[:, point:last] += away[:, None]
    # The thumb's first joint is of the palm too, but moves in it: it goes with the wrist.
    moved[:, THUMB : THUMB + 4] += (laid[:, 0] - points[:, WRIST])[:, None]
    rigid: FloatArray = moved - moved[:, WRIST, None]
    return rigid
