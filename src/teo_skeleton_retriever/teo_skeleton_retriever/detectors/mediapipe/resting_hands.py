# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Hands at rest, on which the hand networks need not run in every image.

The network of a hand hardly ever finds one that hangs beside the thigh, and takes a quarter of the detector's
time for it all the same. On takes whose hands do hang now and then no hand was found later, or elsewhere, for
being looked at in every third image only.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray

HANDS = ("left_hand", "right_hand")
LOOK_EVERY = 3  # images: a tenth of a second at 30 Hz, in which a hand that rises has left its rest
_IN_VAIN = 3  # images without the hand before it is left alone
_HANGING = 0.85  # least part of the forearm's length that points down: within 32 degrees of it
_ABOVE_HIP = 0.02  # [image heights] that a wrist at rest may be above the hip

# Elbow, wrist and hip among the pose's landmarks.
_ARM = {"left_hand": (13, 15, 23), "right_hand": (14, 16, 24)}


class RestingHands:
    """Which hands to look at in the next image, by what was seen in the last ones.

    May be used by several threads: images may be begun before those before them have been seen.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._in_vain = dict.fromkeys(HANDS, 0)
        self._left_out = dict.fromkeys(HANDS, 0)

    def next_looks(self) -> Mapping[str, bool]:
        """Tell for an image that begins whether to look at each of `HANDS`."""
        with self._lock:
            looks = {}
            for hand in HANDS:
                resting = self._in_vain[hand] >= _IN_VAIN
                looks[hand] = not resting or self._left_out[hand] >= LOOK_EVERY - 1
                self._left_out[hand] = 0 if looks[hand] else self._left_out[hand] + 1
            return MappingProxyType(looks)

    def saw(self, pose: FloatArray | None, found: Mapping[str, bool], *, width: int, height: int) -> None:
        """Take in what was seen in an image.

        Args:
            pose: Its first columns are x, y in [0, 1] of width and height; None if nobody was seen.
                Shape (33, k).
            found: Whether each of `HANDS` was.
            width: Of the image [px].
            height: Likewise.
        """
        with self._lock:
            for hand in HANDS:
                at_rest = not found[hand] and pose is not None and _hangs(pose, hand, width, height)
                self._in_vain[hand] = self._in_vain[hand] + 1 if at_rest else 0


def _hangs(pose: FloatArray, hand: str, width: int, height: int) -> bool:
    elbow, wrist, hip = pose[list(_ARM[hand]), :2]
    across, down = (wrist - elbow) * [width, height]
    return bool(down > _HANGING * np.hypot(across, down) and wrist[1] > hip[1] - _ABOVE_HIP)
