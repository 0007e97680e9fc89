# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Forearms and hands before other parts of the body: what they hide, and which surface is theirs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.layouts.layout import HAND_21
from teo_skeleton_retriever.layouts.person_layout import ARMS

_FOREARM, _HAND = 0.045, 0.055  # [m] half a forearm's breadth, half a palm's with the thumb
_STEPS = np.linspace(0.0, 1.0, 6)  # a forearm is covered by discs 5 cm apart, a hand by those 2 cm apart
_CLEAR = 0.02  # [m] where arms cross, both seem as near: the one that is nearer by this hides the other
# [m] The same of a joint's own limb: nearer, it is the joint's own skin that is seen. A forearm that points
# at the camera is so far before its elbow where the camera sees the forearm's skin and no more the elbow's.
_OWN_FOREARM_CLEAR, _OWN_HAND_CLEAR = 0.07, 0.09
_SKIN = 0.03  # [m] from the axis of a forearm or hand to the skin before it
_THICKNESS = 0.05  # [m] depths so near to that skin are of the same arm
_LIKE_A_HAND = 0.4  # of the forearm's length, to the middle of the hand: where no hand is seen it is ahead
_MIDDLE = [HAND_21.index["MiddleMCP"], HAND_21.index["MiddleTip"]]


class Occluders(NamedTuple):
    """Points along forearms and hands, as spheres."""

    points: FloatArray
    """[m]. Shape (k, 3)"""
    radius: FloatArray
    """[m]. Shape (k,)"""
    owner: FloatArray
    """row of the body's joint that each begins at: elbow, or wrist. Shape (k,)"""
    own_clear: FloatArray
    """how far before a joint of the same arm each hides it [m]. Shape (k,)"""

    def hide(self, rays: FloatArray, depth: FloatArray, limbs: Mapping[int, Sequence[int]]) -> BoolArray:
        """Tell before which joints one of them lies. Shape (n,).

        Args:
            rays: x/z, y/z of the joints. Shape (n, 2).
            depth: Of the joints [m]. Shape (n,).
            limbs: By the row of a joint, where its own limbs begin: those hide it only from farther before it
                than their own skin.
        """
        clear = np.full((len(rays), len(self.points)), _CLEAR)
        for row, joints in limbs.items():
            clear[row] = np.where(np.isin(self.owner, joints), self.own_clear, _CLEAR)
        with np.errstate(invalid="ignore"):
            hides = self._on(rays) & (self.points[:, 2] < depth[:, None] - clear)
        hidden: BoolArray = hides.any(axis=1)
        return hidden

    def shown(self, rays: FloatArray, depths: FloatArray) -> BoolArray:
        """Tell which measured depths are those of a forearm or a hand, not of what is behind it.

        Args:
            rays: x/z, y/z. Shape (n, 2).
            depths: Of the surfaces around each [m]. Shape (n, m).
        """
        shown = np.zeros(depths.shape, dtype=bool)
        near = self._on(rays)
        rows = np.flatnonzero(near.any(axis=1))  # in most images no arm is before the face
        with np.errstate(invalid="ignore"):
            apart = np.abs(depths[rows, :, None] - (self.points[:, 2] - _SKIN))
        shown[rows] = (near[rows, None] & (apart < _THICKNESS)).any(axis=2)
        return shown

    def _on(self, rays: FloatArray) -> BoolArray:
        """Tell through which spheres rays go; their depth is taken for the distance. Shape (n, k)."""
        x, y, z = self.points.T
        with np.errstate(invalid="ignore"):
            off = (x - rays[:, :1] * z) ** 2 + (y - rays[:, 1:] * z) ** 2
            on: BoolArray = off < self.radius**2
        return on


def occluders(body: FloatArray, hands: dict[str, FloatArray]) -> Occluders:
    """Find forearms and hands.

    Args:
        body: Joints in space [m]; NaN where not known. Shape (25, 3).
        hands: Keypoints of the left ("L") and right ("R") hand, of those that are seen [m]. Shape (21, 3).
    """
    points, radius, owner, own_clear = [np.zeros((0, 3))], [np.zeros(0)], [np.zeros(0)], [np.zeros(0)]

    def add(start: FloatArray, end: FloatArray, half: float, row: int) -> None:
        line = start + _STEPS[:, None] * (end - start)
        if np.isfinite(line).all() and (line[:, 2] > 0.0).all():
            points.append(line)
            radius.append(np.full(len(line), half))
            owner.append(np.full(len(line), row))
            own_clear.append(np.full(len(line), _OWN_FOREARM_CLEAR if half == _FOREARM else _OWN_HAND_CLEAR))

    for side, (_, elbow, wrist) in ARMS.items():
        add(body[elbow], body[wrist], _FOREARM, elbow)
        hand = hands.get(side)
        if hand is None or not np.isfinite(hand[_MIDDLE]).all():
            add(body[wrist], body[wrist] + _LIKE_A_HAND * (body[wrist] - body[elbow]), _HAND, wrist)
            continue
        knuckle, tip = hand[_MIDDLE]
        add(hand[0], knuckle, _HAND, wrist)
        add(knuckle, tip, _HAND, wrist)
    return Occluders(*(np.concatenate(parts) for parts in (points, radius, owner, own_clear)))
