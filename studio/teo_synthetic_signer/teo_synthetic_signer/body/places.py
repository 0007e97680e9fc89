# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Places of a body that hands go to, found on each person's own skin."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.body_data import EARS, load_body_data
from teo_synthetic_signer.body.rig import Rig
from teo_synthetic_signer.body.surface import RayCaster

_ARM_BONES = ("upperarm", "lowerarm", "wrist", "metacarpal", "finger")

# From the crown down. `shoulders` is the middle between both joints and `hip` between both hips, inside the
# body; all others are on the skin. Those beside the middle are on the side of the hand, but for `other_`.
PLACES = (
    *(
        "crown",
        "forehead",
        "temple",
        "eye",
        "nose",
        "ear",
        "cheek",
        "mouth",
        "mouth_corner",
        "chin",
        "throat",
    ),
    *("shoulders", "shoulder", "other_shoulder", "upper_chest", "sternum", "other_chest"),
    *("belly", "hip", "side"),
)

# From the centre of an eye to the front of its closed lid [m]: an eyeball is 12 mm in radius.
_EYE_DEPTH = 0.014
# From any place inside a body, so far away is outside [m].
_OUTSIDE = 0.6


class Places:
    """Where the places of a body are while it stands at rest."""

    def __init__(self, rig: Rig) -> None:
        """Find them on a person's skin."""
        self._rig = rig
        self._skin = np.unique(load_body_data().groups["body"])
        self._triangles = rig.vertices[load_body_data().groups["body"]]
        right, left = rig.head("upperarm01.R"), rig.head("upperarm01.L")
        eyes = (rig.head("eye.R") + rig.head("eye.L")) / 2.0
        head = rig.tail("head")
        hips = (rig.head("upperleg01.R") + rig.head("upperleg01.L")) / 2.0
        shoulders = (right + left) / 2.0
        trunk = shoulders[2] - hips[2]
        face = head[2] - eyes[2]  # from the eyes to the crown, which is as far as from the eyes to the chin
        half_shoulders = float(left[1])
        mouth = eyes[2] - 0.58 * face
        middle = {
            "shoulders": shoulders,
            "sternum": self._front(shoulders[2] - 0.22 * trunk),
            "belly": self._front(shoulders[2] - 0.62 * trunk),
            "chin": self._front(eyes[2] - 0.93 * face),
            "mouth": self._front(mouth),
            "nose": self._front(eyes[2] - 0.30 * face),
            "forehead": self._front(eyes[2] + 0.45 * face),
            "hip": hips,
            "throat": self._front(eyes[2] - 1.35 * face),
            "upper_chest": self._front(shoulders[2] - 0.10 * trunk),
            "crown": self._hit(eyes - [0.06, 0.0, 0.0], (0.0, 0.0, 1.0)),
        }
        # Beside the middle, on the left.
        aside = {
            "temple": np.array([eyes[0], 0.55 * float(face), eyes[2] + 0.1 * face]),
            "side": np.array([hips[0], self._half_width(float(hips[2])), hips[2]]),
            "eye": rig.head("eye.L") + np.array([_EYE_DEPTH, 0.0, 0.0]),
            "ear": rig.vertices[EARS["L"]],
            "cheek": self._hit(np.array([eyes[0] - 0.07, 0.0, eyes[2] - 0.42 * face]), (0.6, 0.8, 0.0)),
            "mouth_corner": self._hit(np.array([eyes[0] - 0.05, 0.21 * face, mouth]), (1.0, 0.0, 0.0)),
            "shoulder": self._hit(left * [1.0, 0.87, 1.0], (1.0, 0.0, 0.0)),
            "other_shoulder": self._hit(
                np.array([left[0], -0.6 * half_shoulders, left[2] - 0.03 * trunk]), (1.0, 0.0, 0.0)
            ),
            "other_chest": self._hit(
                np.array([left[0], -0.2 * trunk, left[2] - 0.20 * trunk]), (1.0, 0.0, 0.0)
            ),
        }
        self._left: dict[str, FloatArray] = middle | aside

    def at(self, name: str, side: str) -> FloatArray:
        """Give a place of `PLACES` for the hand of a side, "R" or "L" [m]. Shape (3,)."""
        mirror = np.array([1.0, -1.0 if side == "R" else 1.0, 1.0])
        place: FloatArray = self._left[name] * mirror
        return place

    def _front(self, height: float) -> FloatArray:
        """Find the foremost skin at a height, in the middle of the body."""
        skin = self._rig.vertices[self._skin]
        near = np.abs(skin - [0.0, 0.0, height])
        chosen = skin[(near[:, 1] < 0.03) & (near[:, 2] < 0.012)]
        return np.array([chosen[:, 0].max(), 0.0, height])

    def _half_width(self, height: float) -> float:
        """Measure the hips: half of how wide the body is at a height and a hand's breadth above [m]."""
        skin = self._rig.vertices[self._skin]
        trunk = arm_share(self._rig)[self._skin] < 0.1
        near = trunk & (skin[:, 2] > height) & (skin[:, 2] < height + 0.1)
        return float(np.abs(skin[near, 1]).max())

    def _hit(self, start: FloatArray, direction: tuple[float, float, float]) -> FloatArray:
        """Find the outermost skin from a place inside, in a direction that the arms are not in."""
        outside = start + _OUTSIDE * np.array(direction)
        ray = -np.array([direction], dtype=np.float32)
        distance = float(RayCaster(self._triangles - outside).cast(ray).distance[0])
        found: FloatArray = outside - distance * np.array(direction)
        return found


def arm_share(rig: Rig) -> FloatArray:
    """Give by how much each vertex follows the bones of the arms. Shape (n,)."""
    arms = [i for i, name in enumerate(load_body_data().bones) if name.startswith(_ARM_BONES)]
    return np.asarray(rig.weights[:, arms].sum(axis=1)).ravel()
