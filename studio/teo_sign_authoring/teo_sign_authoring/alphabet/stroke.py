# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a clip of a letter says over time: where the sign begins and ends, what moves, what is held."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_sign_authoring.alphabet.letter_clips import LetterClip
from teo_skeleton_retriever.lifting.hand_axes import INDEX, KNUCKLES, PALM, WRIST, palm_axes

# Figures below are in pixels of the normalised clips, where wrist to middle knuckle is 59 pixels, and in
# degrees; "still" and "moving" letters lie well apart on each, as said there.
# [pixel/frame] The wrist rises and falls faster than this; no stroke of a letter does for so long.
_RISE = 8.0
# [deg/frame] Fingers bend faster than this, on average of the four, while the handshape forms or dissolves.
_FORMING = 20.0
# [deg] A hand tilted by this much more than it is in the later three quarters of the stroke is still
# arriving.
_SWING = 10.0
# [pixel] Way of the index tip from side to side, all swings added: at most 41 in still letters, 92 up in
# moving.
_SWAY = 60.0
# [deg] The palm turns more than this from its median in one frame of ten: at most 32 in letters that do not
# turn.
_TURN = 45.0
# [pixel] How much a finger's reach, knuckle to tip, changes beyond once through its range: Y's little finger
# 115, others at most 71.
_WAG = 90.0
# [deg] Frames of one hold have palms within this of their first.
_HOLD_ANGLE = 25.0
# [frame] A hold that is shorter is a passage.
_HOLD_FRAMES = 4


@dataclass(frozen=True, kw_only=True)
class Stroke:
    """The part of a clip that is the letter, without the arm's rise and fall.

    Attributes:
        first: First frame.
        last: Last frame, included.
        holds: Runs of frames in which the palm keeps its orientation: first and last frame; at least one.
        sways: Whether the hand moves from place to place, rocks or turns.
        wagging: Fingers that bend again and again: 0 index ... 3 little.
    """

    first: int
    last: int
    holds: tuple[tuple[int, int], ...]
    sways: bool
    wagging: tuple[int, ...]

    @property
    def frames(self) -> NDArray[np.intp]:
        """All frames. Shape (n,)."""
        return np.arange(self.first, self.last + 1)

    @property
    def turns(self) -> bool:
        """Whether the palm has more than one orientation."""
        return len(self.holds) > 1


def find_stroke(clip: LetterClip) -> Stroke:
    """Cut a clip and say what moves in it."""
    hand = clip.hand
    bends = total_bends(hand)
    rising = np.abs(np.diff(hand[:, WRIST, 2])) >= _RISE
    forming = np.abs(np.diff(bends, axis=0)).mean(axis=1) >= _FORMING
    steady = np.flatnonzero(~(rising | forming))
    first, last = int(steady[0]), int(steady[-1]) + 1
    first += _arrival(hand[first : last + 1])
    inside = slice(first, last + 1)
    holds = _holds(hand[inside])
    spans = tuple((first + start, first + end) for start, end in holds)
    way = np.abs(np.diff(hand[inside][:, INDEX + 3, 1])).sum()
    span = reaches(hand[inside])
    beyond = np.abs(np.diff(span, axis=0)).sum(axis=0) - np.ptp(span, axis=0)
    return Stroke(
        first=first,
        last=last,
        holds=spans,
        sways=bool(way > _SWAY) or len(spans) > 1,
        # Fingers of a hand that turns are seen shorter and longer without bending.
        wagging=() if len(spans) > 1 else tuple(int(finger) for finger in np.flatnonzero(beyond > _WAG)),
    )


def _arrival(hand: Array) -> int:
    """Frames at the beginning in which the hand still swings into place, beyond all that it does later."""
    tilt = np.degrees(tilts(hand))
    later = tilt[len(tilt) // 4 :]
    inside = (tilt > later.min() - _SWING) & (tilt < later.max() + _SWING)
    return int(inside.argmax())


def total_bends(hand: Array) -> Array:
    """Bend of each finger, knuckle to tip, all joints added [deg]. Shape (n, 4)."""
    local = np.einsum("nij,nki->nkj", palm_axes(hand), hand - hand[:, WRIST, None])
    total = np.empty((len(hand), 4))
    for finger, knuckle in enumerate(KNUCKLES):
        bones = np.diff(local[:, knuckle : knuckle + 4], axis=1)
        knuckle_bend = np.degrees(np.arctan2(bones[:, 0, 2], bones[:, 0, 0]))
        total[:, finger] = (
            knuckle_bend + _between(bones[:, 0], bones[:, 1]) + _between(bones[:, 1], bones[:, 2])
        )
    return total


def reaches(hand: Array) -> Array:
    """Length of each finger, knuckle to tip, as the viewer sees it [pixel]. Shape (n, 4)."""
    tips = [knuckle + 3 for knuckle in KNUCKLES]
    lengths: Array = np.linalg.norm(hand[:, tips, 1:] - hand[:, KNUCKLES, 1:], axis=-1)
    return lengths


def tilts(hand: Array) -> Array:
    """Direction of the hand as the viewer sees it [rad], unwrapped. Shape (n,)."""
    along = hand[:, KNUCKLES, 1:].mean(axis=1) - hand[:, WRIST, 1:]
    return np.unwrap(np.arctan2(along[:, 1], along[:, 0]))


def palm_centres(hand: Array) -> Array:
    """Middle of the palm across the view: left, up [pixel]. Shape (n, 2)."""
    centres: Array = hand[:, PALM, 1:].mean(axis=1)
    return centres


def _holds(hand: Array) -> list[tuple[int, int]]:
    axes = palm_axes(hand)
    middle = axes[:, :, (0, 2)]
    median = np.median(middle, axis=0)
    median /= np.linalg.norm(median, axis=0)
    away = np.degrees(np.arccos(np.clip((middle * median).sum(axis=1), -1.0, 1.0)))
    if np.percentile(away, 90, axis=0).max() <= _TURN:
        return [(0, len(hand) - 1)]
    found: list[tuple[int, int]] = []
    start = 0
    for frame in range(1, len(hand) + 1):
        if frame < len(hand) and _apart(axes[start], axes[frame]) <= _HOLD_ANGLE:
            continue
        if frame - start >= _HOLD_FRAMES:
            found.append((start, frame - 1))
        start = frame
    return found or [(0, len(hand) - 1)]


def _apart(first: Array, second: Array) -> float:
    """Angle of the rotation between two sets of axes [deg]."""
    cosine = (np.trace(first.T @ second) - 1.0) / 2.0
    return float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _between(first: Array, second: Array) -> Array:
    cosine = (first * second).sum(axis=-1) / (
        np.linalg.norm(first, axis=-1) * np.linalg.norm(second, axis=-1)
    )
    angles: Array = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return angles
