# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A leg whose foot stands at a place: inverse kinematics of hip, knee and ankle."""

from __future__ import annotations

import math

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.rig import Rig
from teo_synthetic_signer.body.rotations import about, frame, perpendicular, unit

# Longest a leg gets, of its whole length: knees are never quite straight.
_STRAIGHTEST = 0.998


class Leg:
    """One leg of a rig."""

    def __init__(self, rig: Rig, side: str) -> None:
        """Measure a side's leg, "R" or "L", at rest."""
        self.side = side
        self.hip = rig.head(f"upperleg01.{side}")
        self.knee = rig.head(f"lowerleg01.{side}")
        self.ankle = rig.head(f"foot.{side}")
        self.thigh = float(np.linalg.norm(self.knee - self.hip))
        self.shank = float(np.linalg.norm(self.ankle - self.knee))

    @property
    def longest(self) -> float:
        """Greatest distance of the ankle from the hip [m]."""
        return _STRAIGHTEST * (self.thigh + self.shank)

    def bones(self, hip: FloatArray, ankle: FloatArray, foot: FloatArray) -> dict[str, FloatArray]:
        """Work out where the bones of the leg go.

        Args:
            hip: The joint's place [m].
            ankle: Likewise; the leg stretches towards it if it is out of reach.
            foot: Rotation of the foot from rest; the knee points along its toes. Shape (3, 3).

        Returns:
            Transform of each bone from rest. Shape (4, 4) each.
        """
        line = unit(ankle - hip)
        distance = min(float(np.linalg.norm(ankle - hip)), self.longest)
        ankle = hip + line * distance
        along = (self.thigh**2 - self.shank**2 + distance**2) / (2.0 * distance)
        forwards = perpendicular(foot @ np.array([1.0, 0.0, 0.0]), line)
        knee = hip + along * line + math.sqrt(max(0.0, self.thigh**2 - along**2)) * forwards
        ahead = np.array([1.0, 0.0, 0.0])
        thigh = frame(knee - hip, forwards) @ frame(self.knee - self.hip, ahead).T
        shank = frame(ankle - knee, forwards) @ frame(self.ankle - self.knee, ahead).T
        side = self.side
        return {
            f"upperleg01.{side}": about(self.hip, thigh, hip),
            f"upperleg02.{side}": about(self.hip, thigh, hip),
            f"lowerleg01.{side}": about(self.knee, shank, knee),
            f"lowerleg02.{side}": about(self.knee, shank, knee),
            f"foot.{side}": about(self.ankle, foot, ankle),
        }
