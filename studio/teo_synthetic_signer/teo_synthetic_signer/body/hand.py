# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One hand of a body: from a hand shape to the places of its bones and of points that go to a place."""

from __future__ import annotations

import math
from functools import cached_property
from itertools import pairwise

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.hand_shapes import FINGERS, HAND_SHAPES, HandShape
from teo_synthetic_signer.body.rig import Rig
from teo_synthetic_signer.body.rotations import about, cross, frame, perpendicular, turn, unit
from teo_synthetic_signer.errors import unknown_name

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
        turned: FloatArray = self.axes @ np.asarray(direction, dtype=np.float64)
        return turned

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
