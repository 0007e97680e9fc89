# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From what a person does at one moment to the place of each bone."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.hand import Hand
from teo_synthetic_signer.body.hand_shapes import HAND_SHAPES, HandShape
from teo_synthetic_signer.body.limbs import Arm, Leg
from teo_synthetic_signer.body.rig import SIDES, Rig
from teo_synthetic_signer.body.rotations import about, turn

_SPINE = ("spine05", "spine04", "spine03", "spine02", "spine01")
_NECK = ("neck01", "neck02", "neck03", "head")
_X, _Y, _Z = np.eye(3)

# The shoulder blade follows the arm: by a third of what it is raised beyond 45 deg (the scapulohumeral
# rhythm, Inman and others, 1944, is 1:2), and forwards by a fifth of what it reaches across (no source).
_RAISE, _RAISE_FROM, _RAISE_MOST = 0.33, math.radians(45.0), math.radians(28.0)
_FORWARD, _FORWARD_MOST = 0.2, math.radians(18.0)


@dataclass(frozen=True)
class ArmPose:
    """What one arm does.

    Attributes:
        wrist: Where the wrist's centre is, in the axes of the chest, as if the body stood at rest [m].
        hand: Rotation of the hand from rest, in the same axes. Shape (3, 3).
        swivel: See `Arm.elbow_at` [rad].
        shape: Of the hand.
    """

    wrist: FloatArray
    hand: FloatArray
    swivel: float
    shape: HandShape = field(default_factory=lambda: HAND_SHAPES["relaxed"])


@dataclass(frozen=True, kw_only=True)
class BodyPose:
    """What a person does.

    Attributes:
        arms: Of "R" and "L".
        place: Where on the floor, forwards and to the left of where the person started [m].
        heading: Turned to the left [rad].
        lean: Of the trunk forwards, to the left, and its turn to the left [rad].
        head: Turned to the left, bowed, and tilted to the left [rad].
        feet: Of "R" and "L": forwards, to the left and above the floor, from where the person started [m].
        face: Strength of facial actions, 0 to 1, by their names.
    """

    arms: Mapping[str, ArmPose]
    place: tuple[float, float] = (0.0, 0.0)
    heading: float = 0.0
    lean: tuple[float, float, float] = (0.0, 0.0, 0.0)
    head: tuple[float, float, float] = (0.0, 0.0, 0.0)
    feet: Mapping[str, tuple[float, float, float]] | None = None
    face: Mapping[str, float] = field(default_factory=dict)


class Poser:
    """Brings one person's rig into poses."""

    def __init__(self, rig: Rig) -> None:
        self.rig = rig
        self.arms = {side: Arm(rig, side) for side in SIDES}
        self.hands = {side: Hand(rig, side) for side in SIDES}
        self.legs = {side: Leg(rig, side) for side in SIDES}

    def transforms(self, pose: BodyPose) -> FloatArray:
        """Give the transform of each bone from rest. Shape (bones, 4, 4)."""
        rig = self.rig
        turned = self._trunk(pose)
        root = self._root(pose)
        placed: dict[str, FloatArray] = {}
        chest = rig.transforms(turned, {}, root)[rig.bone("spine01")]
        for side in SIDES:
            girdle, arm = self.arm_bones(side, pose.arms[side])
            turned |= girdle
            placed |= {name: chest @ transform for name, transform in arm.items()}
            placed |= self._leg_bones(side, pose, root)
        return rig.transforms(turned, placed, root)

    def limb(self, side: str, wrist: FloatArray, swivel: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give shoulder, elbow and wrist when the wrist is sent somewhere, in the axes of the chest [m]."""
        arm = self.arms[side]
        _, shoulder = self.girdle(side, wrist)
        wrist = arm.reachable(shoulder, wrist)
        return shoulder, arm.elbow_at(shoulder, wrist, swivel), wrist

    def girdle(self, side: str, wrist: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Let the collar bone follow the arm.

        Returns:
            Its transform, in the axes of the chest, and where the shoulder joint is then [m].
        """
        arm = self.arms[side]
        away = self.arms[side].reachable(arm.shoulder, wrist) - arm.shoulder
        elbow = arm.elbow_at(arm.shoulder, arm.shoulder + away, 0.0) - arm.shoulder
        outwards = -1.0 if side == "R" else 1.0
        raised = math.acos(float(np.clip(-elbow[2] / arm.upper, -1.0, 1.0)))
        lift = min(_RAISE_MOST, _RAISE * max(0.0, raised - _RAISE_FROM))
        across = math.atan2(max(0.0, away[0]), max(0.05, away[1] * outwards + 0.15))
        forward = min(_FORWARD_MOST, _FORWARD * across)
        rotation = turn(_Z, -outwards * forward) @ turn(_X, outwards * lift)
        transform = about(self.rig.head(f"clavicle.{side}"), rotation)
        return transform, (transform @ [*arm.shoulder, 1.0])[:3]

    def arm_bones(self, side: str, pose: ArmPose) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
        """Place one arm in the axes of the chest: what turns below the chest, and what is placed."""
        arm, hand = self.arms[side], self.hands[side]
        girdle, shoulder = self.girdle(side, pose.wrist)
        wrist = arm.reachable(shoulder, pose.wrist)
        elbow = arm.elbow_at(shoulder, wrist, pose.swivel)
        placed = arm.bones(shoulder, elbow, wrist, pose.hand, girdle)
        for name, transform in hand.bones(pose.shape).items():
            placed[name] = placed[f"wrist.{side}"] @ transform
        return {f"clavicle.{side}": girdle[:3, :3]}, placed

    def _root(self, pose: BodyPose) -> FloatArray:
        legs = [self.legs[side] for side in SIDES]
        feet = self.standing_feet() if pose.feet is None else pose.feet
        # As high as the legs can carry the hips, were the feet below them.
        drop = 0.0
        for side, leg in zip(SIDES, legs, strict=True):
            aside = math.hypot(feet[side][0] - pose.place[0], feet[side][1] - pose.place[1] - leg.hip[1])
            highest = math.sqrt(max(0.01, (0.999 * leg.longest) ** 2 - aside**2)) + leg.ankle[2]
            drop = min(drop, highest - leg.hip[2])
        root = about(np.zeros(3), turn(_Z, pose.heading))
        root[:3, 3] = [*pose.place, drop]
        return root

    def standing_feet(self) -> dict[str, tuple[float, float, float]]:
        """Give the feet of a person who stands: below the hips and a little apart."""
        return {
            side: (float(self.legs[side].ankle[0]), 1.15 * float(self.legs[side].hip[1]), 0.0)
            for side in SIDES
        }

    def _leg_bones(self, side: str, pose: BodyPose, root: FloatArray) -> dict[str, FloatArray]:
        leg = self.legs[side]
        feet = self.standing_feet() if pose.feet is None else pose.feet
        forwards, left, above = feet[side]
        hip = (root @ [*leg.hip, 1.0])[:3]
        return leg.bones(hip, np.array([forwards, left, above + leg.ankle[2]]), root[:3, :3])

    @staticmethod
    def _trunk(pose: BodyPose) -> dict[str, FloatArray]:
        bow, aside, twist = (angle / len(_SPINE) for angle in pose.lean)
        spine = turn(_Z, twist) @ turn(_Y, bow) @ turn(_X, -aside)
        yaw, pitch, roll = (angle / len(_NECK) for angle in pose.head)
        neck = turn(_Z, yaw) @ turn(_Y, pitch) @ turn(_X, -roll)
        return dict.fromkeys(_SPINE, spine) | dict.fromkeys(_NECK, neck)
