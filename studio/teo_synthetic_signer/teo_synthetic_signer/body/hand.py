# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One hand of a body: the shapes it takes in signing, and where its bones and points are in each.

Angles of the shapes follow from looking at hands, not from a source: a signer would recognise them, and
the truth of a take comes from the pose, not from them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.rig import Rig
from teo_synthetic_signer.body.rotations import about, cross, frame, perpendicular, turn, unit
from teo_synthetic_signer.errors import unknown_name

FINGERS = ("index", "middle", "ring", "little")


@dataclass(frozen=True)
class HandShape:
    """A hand as numbers that can be blended.

    Attributes:
        flexion: Of the knuckle, middle and last joint of index, middle, ring and little finger; 0 is
            straight [rad]. Shape (4, 3).
        spread: Of these fingers towards the thumb, in the plane of the palm [rad]. Shape (4,).
        thumb: Directions in the hand's own axes (along the fingers, out of the palm, towards the thumb's
            side): where the thumb's metacarpal points, and towards where the thumb bends. Shape (2, 3).
        thumb_flexion: Of the thumb's two outer joints [rad]. Shape (2,).
    """

    flexion: FloatArray
    spread: FloatArray
    thumb: FloatArray
    thumb_flexion: FloatArray

    def blend(self, other: HandShape, share: float) -> HandShape:
        """Give the shape on the way to another; a share of 0 is this one, 1 the other."""
        pairs = [
            (self.flexion, other.flexion),
            (self.spread, other.spread),
            (self.thumb, other.thumb),
            (self.thumb_flexion, other.thumb_flexion),
        ]
        return HandShape(*((1.0 - share) * mine + share * its for mine, its in pairs))


Bends = tuple[float, float, float]

# Flexion of knuckle, middle and last joint [deg].
_STRAIGHT: Bends = (2.0, 4.0, 3.0)
_RELAXED: Bends = (22.0, 28.0, 15.0)
_FOLDED: Bends = (82.0, 95.0, 60.0)
_HOOK: Bends = (8.0, 80.0, 50.0)
_CROOKED: Bends = (8.0, 78.0, 48.0)
_BENT: Bends = (75.0, 8.0, 5.0)
_ROUND: Bends = (45.0, 48.0, 30.0)
_CLAW: Bends = (25.0, 50.0, 35.0)
_PINCH: Bends = (55.0, 50.0, 25.0)
_AT_THUMB: Bends = (56.0, 48.0, 24.0)

# Where the thumb's metacarpal points, towards where it bends, and how far in its two outer joints [deg].
THUMBS: dict[str, tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float]]] = {
    "out": ((0.70, 0.30, 0.65), (0.75, 0.15, -0.65), (0.0, 0.0)),
    "beside": ((0.90, 0.30, 0.32), (0.35, 0.35, -0.87), (8.0, 5.0)),
    "relaxed": ((0.80, 0.45, 0.40), (0.30, 0.45, -0.84), (18.0, 15.0)),
    "across": ((0.72, 0.62, 0.30), (0.10, 0.30, -0.95), (42.0, 38.0)),
    "over": ((0.70, 0.66, 0.28), (0.15, 0.25, -0.95), (45.0, 50.0)),
    "up": ((0.35, 0.25, 0.90), (0.80, 0.20, -0.50), (-5.0, -10.0)),
    "opposed": ((0.68, 0.72, 0.15), (0.45, 0.20, -0.87), (22.0, 25.0)),
}


def hand_thumb(name: str) -> tuple[FloatArray, FloatArray]:
    """Give a thumb of `THUMBS`: `HandShape.thumb` and `HandShape.thumb_flexion`."""
    points, bends, angles = THUMBS[name]
    return np.array([points, bends]), np.radians(np.array(angles))


class HandAngles(NamedTuple):
    """A hand shape in degrees.

    Attributes:
        fingers: Flexion of knuckle, middle and last joint of index, middle, ring and little finger.
        thumb: One of `THUMBS`.
        spread: Of index to little finger towards the thumb.
    """

    fingers: tuple[Bends, Bends, Bends, Bends]
    thumb: str
    spread: tuple[float, float, float, float] = (2.0, 0.0, -2.0, -5.0)

    def shape(self) -> HandShape:
        """Give the shape in radians."""
        return HandShape(
            np.radians(np.array(self.fingers)), np.radians(np.array(self.spread)), *hand_thumb(self.thumb)
        )


_FAN = (12.0, 2.0, -9.0, -20.0)  # spread of an open hand [deg]
_TWO_APART = (8.0, -4.0, -4.0, -6.0)

HAND_ANGLES: dict[str, HandAngles] = {
    "relaxed": HandAngles((_RELAXED, (26, 32, 18), (30, 34, 18), (32, 34, 18)), "relaxed"),
    "open": HandAngles((_STRAIGHT,) * 4, "out", _FAN),
    "flat": HandAngles((_STRAIGHT,) * 4, "beside"),
    "fist": HandAngles((_FOLDED,) * 4, "over"),
    "index": HandAngles((_STRAIGHT, _FOLDED, _FOLDED, _FOLDED), "over"),
    "middle": HandAngles((_FOLDED, _STRAIGHT, _FOLDED, _FOLDED), "over"),
    "little": HandAngles((_FOLDED, _FOLDED, _FOLDED, _STRAIGHT), "over"),
    "v": HandAngles((_STRAIGHT, _STRAIGHT, _FOLDED, _FOLDED), "across", (13, -10, -4, -6)),
    "u": HandAngles((_STRAIGHT, _STRAIGHT, _FOLDED, _FOLDED), "across"),
    "w": HandAngles((_STRAIGHT, _STRAIGHT, _STRAIGHT, _FOLDED), "across", (13, 0, -13, -8)),
    "b": HandAngles((_STRAIGHT,) * 4, "across"),
    "l": HandAngles((_STRAIGHT, _FOLDED, _FOLDED, _FOLDED), "up"),
    "y": HandAngles((_FOLDED, _FOLDED, _FOLDED, _STRAIGHT), "up", (2, 0, -2, -14)),
    "horns": HandAngles((_STRAIGHT, _FOLDED, _FOLDED, _STRAIGHT), "over", (6, 0, -2, -12)),
    "thumb_up": HandAngles((_FOLDED,) * 4, "up"),
    "c": HandAngles((_ROUND,) * 4, "opposed"),
    "o": HandAngles(((58, 56, 35), (58, 58, 36), (60, 58, 36), (62, 58, 36)), "opposed"),
    "claw": HandAngles((_CLAW,) * 4, "out", _FAN),
    "hook": HandAngles((_HOOK, _FOLDED, _FOLDED, _FOLDED), "over"),
    "bent": HandAngles((_BENT,) * 4, "beside"),
    "f": HandAngles((_PINCH, _STRAIGHT, _STRAIGHT, _STRAIGHT), "opposed", (0, 4, -7, -18)),
    # More handshapes of sign scores; the others of theirs have names above.
    "loose": HandAngles(((14, 20, 10), (16, 22, 11), (18, 23, 12), (20, 24, 12)), "relaxed", (6, 1, -4, -10)),
    "cupped": HandAngles(((26, 32, 18),) * 4, "relaxed"),
    "bunched": HandAngles(((58, 38, 18), (62, 36, 16), (60, 40, 18), (58, 46, 22)), "opposed", (-4, 0, 4, 8)),
    "crooked": HandAngles((_CROOKED, _FOLDED, _FOLDED, _FOLDED), "over"),
    "bent_two": HandAngles((_CROOKED, _CROOKED, _FOLDED, _FOLDED), "across", (10, -8, -4, -6)),
    "bent_thumb_two": HandAngles((_CROOKED, _CROOKED, _FOLDED, _FOLDED), "up", _TWO_APART),
    "four": HandAngles((_STRAIGHT,) * 4, "across", _FAN),
    "bent_four": HandAngles((_BENT,) * 4, "across"),
    "thumb_two": HandAngles((_STRAIGHT, _STRAIGHT, _FOLDED, _FOLDED), "up", _TWO_APART),
    "pinch": HandAngles((_AT_THUMB, _FOLDED, _FOLDED, _FOLDED), "opposed"),
    "ring": HandAngles((_AT_THUMB, _STRAIGHT, _STRAIGHT, _STRAIGHT), "opposed", (0, 4, -7, -18)),
    "middle_flick": HandAngles((_STRAIGHT, _AT_THUMB, _STRAIGHT, _STRAIGHT), "opposed", (8, 0, -8, -16)),
    "ring_flick": HandAngles((_STRAIGHT, _STRAIGHT, _AT_THUMB, _STRAIGHT), "opposed", (8, 4, 0, -14)),
    "two_flick": HandAngles((_AT_THUMB, _AT_THUMB, _FOLDED, _FOLDED), "opposed"),
    "three_flick": HandAngles((_AT_THUMB, _AT_THUMB, _AT_THUMB, _FOLDED), "opposed"),
}
HAND_SHAPES: dict[str, HandShape] = {name: angles.shape() for name, angles in HAND_ANGLES.items()}


# By how much flexed fingers turn towards the thumb [rad]: they all point to the scaphoid bone.
_CONVERGENCE = dict(zip(FINGERS, np.radians([-2.0, 3.0, 9.0, 16.0]), strict=True))
# By how much the ring and the little finger's metacarpals follow their knuckle: the palm hollows.
_ARCH = dict(zip(FINGERS, (0.0, 0.0, 0.06, 0.14), strict=True))


class Hand:
    """One hand of a rig.

    Attributes:
        axes: See `Rig.hand_axes`.
        wrist: Its centre at rest [m].
    """

    def __init__(self, rig: Rig, side: str) -> None:
        """Find the axes of a side's hand, "R" or "L", at rest."""
        self._rig = rig
        self.side = side
        self.wrist = rig.head(f"wrist.{side}")
        self.axes = rig.hand_axes(side)

    @cached_property
    def _thumb_bend(self) -> FloatArray:
        """Towards where the thumb bends at rest, in the axes of the body."""
        joints = [self._rig.head(f"finger1-{i}.{self.side}") for i in (1, 2, 3)]
        joints.append(self._rig.tail(f"finger1-3.{self.side}"))
        steps = [unit(b - a) for a, b in pairwise(joints)]
        return perpendicular(steps[2] - steps[0], unit(joints[3] - joints[1]))

    @cached_property
    def joints_straight(self) -> FloatArray:
        """The hand's 21 keypoints with all fingers straight and the wrist at rest [m]. Shape (21, 3)."""
        return self.joints(HAND_SHAPES["open"])

    def to_body(self, direction: FloatArray) -> FloatArray:
        """Bring a direction in the hand's axes to those of the body at rest."""
        return self.axes @ np.asarray(direction, dtype=np.float64)

    def bones(self, shape: HandShape) -> dict[str, FloatArray]:
        """Work out by how much each finger's bones move while the wrist stays at rest.

        Returns:
            Transform of each bone. Shape (4, 4) each.
        """
        placed = self._thumb(shape)
        for number, finger in enumerate(FINGERS):
            placed |= self._finger(number, finger, shape)
        return placed

    def joints(self, shape: HandShape) -> FloatArray:
        """Give the hand's 21 keypoints with the wrist at rest [m]. Shape (21, 3)."""
        placed = self.bones(shape)
        points = [self.wrist]
        for finger in range(1, 6):
            names = [f"finger{finger}-{i}.{self.side}" for i in (1, 2, 3)]
            points += [(placed[name] @ [*self._rig.head(name), 1.0])[:3] for name in names]
            points.append((placed[names[-1]] @ [*self._rig.tail(names[-1]), 1.0])[:3])
        return np.array(points)

    def _finger(self, number: int, finger: str, shape: HandShape) -> dict[str, FloatArray]:
        names = [f"finger{number + 2}-{i}.{self.side}" for i in (1, 2, 3)]
        spread = float(shape.spread[number])
        lean = _CONVERGENCE[finger]
        straight = self.to_body(np.array([math.cos(spread), 0.0, math.sin(spread)]))
        inwards = perpendicular(self.to_body(np.array([0.0, math.cos(lean), math.sin(lean)])), straight)
        # The joints of a finger bend in one plane; at rest it is the one that holds the palm's direction.
        angles = np.cumsum(shape.flexion[number])
        towards = [math.cos(a) * straight + math.sin(a) * inwards for a in angles]
        bends = [math.cos(a) * inwards - math.sin(a) * straight for a in angles]
        metacarpal = f"metacarpal{number + 1}.{self.side}"
        # The mean of both directions of folding is enough: the arch is a few degrees.
        hollow = turn(cross(straight, inwards), _ARCH[finger] * float(shape.flexion[number, 0]))
        base = about(self._rig.head(metacarpal), hollow)
        placed = {metacarpal: base}
        joint = (base @ [*self._rig.head(names[0]), 1.0])[:3]
        return placed | self._chain(names, joint, towards, bends, self.axes[:, 1])

    def _thumb(self, shape: HandShape) -> dict[str, FloatArray]:
        names = [f"finger1-{i}.{self.side}" for i in (1, 2, 3)]
        straight = unit(self.to_body(shape.thumb[0]))
        inwards = perpendicular(self.to_body(shape.thumb[1]), straight)
        angles = np.concatenate([[0.0], np.cumsum(shape.thumb_flexion)])
        towards = [math.cos(a) * straight + math.sin(a) * inwards for a in angles]
        bends = [math.cos(a) * inwards - math.sin(a) * straight for a in angles]
        return self._chain(names, self._rig.head(names[0]), towards, bends, self._thumb_bend)

    def _chain(
        self,
        names: list[str],
        start: FloatArray,
        towards: list[FloatArray],
        bends: list[FloatArray],
        bend_at_rest: FloatArray,
    ) -> dict[str, FloatArray]:
        """Lay bones end to end, each in its direction, its inner side facing where it bends."""
        placed = {}
        for i, name in enumerate(names):
            head = self._rig.head(name)
            end = self._rig.head(names[i + 1]) if i + 1 < len(names) else self._rig.tail(name)
            rotation = frame(towards[i], bends[i]) @ frame(end - head, bend_at_rest).T
            placed[name] = about(head, rotation, start)
            start = start + towards[i] * float(np.linalg.norm(end - head))
        return placed


# `palm` is the middle of the hand, between wrist and middle knuckle; `back` is on its back; `index_side` and
# `little_side` are its edges; `fingertips` is the middle of the tips of the fingers that are stretched most.
POINTS = (
    *("wrist", "palm", "back", "index_side", "little_side"),
    *("index_tip", "middle_tip", "thumb_tip", "fingertips", "knuckles"),
)

# Places on the other hand, and which of its points they are.
OTHER_HAND = {
    "other_palm": "palm",
    "other_back": "back",
    "other_wrist": "wrist",
    "other_index_side": "index_side",
    "other_little_side": "little_side",
    "other_fingertips": "fingertips",
}

# Half of a hand's thickness at the knuckles, of its length from wrist to fingertip: 27 mm of 180 mm, a middle
# between both sexes (NASA-STD-3000, hand thickness at the third metacarpal).
_HALF_THICK = 0.075
# Fingers that are bent by so much more than the straightest one are stretched too.
_AS_STRETCHED = math.radians(30.0)


def hand_point(hand: Hand, shape: HandShape, name: str) -> FloatArray:
    """Give a point of `POINTS` with the wrist at rest [m]. Shape (3,).

    Raises:
        SyntheticError: No point has that name.
    """
    joints = hand.joints(shape)
    middle = (joints[0] + joints[9]) / 2.0
    _, palm, thumbwards = hand.axes.T
    half = _HALF_THICK * float(np.linalg.norm(hand.joints_straight[12] - joints[0]))
    bent = shape.flexion.sum(axis=1)
    stretched = np.flatnonzero(bent <= bent.min() + _AS_STRETCHED)
    points = {
        "wrist": joints[0],
        "palm": middle,
        "back": middle - half * palm,
        "index_side": joints[5] + half * thumbwards,
        "little_side": (joints[0] + 2.0 * joints[17]) / 3.0 - half * thumbwards,
        "index_tip": joints[8],
        "middle_tip": joints[12],
        "thumb_tip": joints[4],
        "fingertips": joints[8 + 4 * stretched].mean(axis=0),
        "knuckles": (joints[6] + joints[10]) / 2.0,
    }
    if name not in points:
        raise unknown_name("point", name, POINTS)
    point: FloatArray = points[name]
    return point
