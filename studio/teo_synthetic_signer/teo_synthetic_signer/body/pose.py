# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From what a person does at one moment to the place of each bone: inverse kinematics of arms and legs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.hand import HAND_SHAPES, Hand, HandShape
from teo_synthetic_signer.body.rig import SIDES, Places, Rig
from teo_synthetic_signer.body.rotations import about, cross, frame, perpendicular, turn, twist_about, unit

# How far a place may be, of the length of the stretched arm: elbows are never quite straight.
_REACH = 0.985
# Share of the upper arm's roll that its upper half takes: the skin of the shoulder stays behind.
_UPPER_TWIST = 0.35
# Share of the hand's roll that the two halves of the forearm take: the radius turns about the ulna.
_ELBOW_TWIST, _WRIST_TWIST = 0.15, 0.75

# What is easy for a wrist, and how much less easy what lies beyond is, in the search for the elbow [rad].
_ROLL_EASE = math.radians(70.0)
_BEND_EASE = math.radians(45.0)
# From where on an elbow that is nearer to the body's middle than its shoulder is in the trunk's way [m], and
# what it costs [1/m^2]: 7 cm as much as half a radian beyond what is easy for a wrist.
_INWARDS_EASE, _INWARDS_COST = 0.03, 200.0
_SWIVELS = np.radians(np.arange(-70.0, 71.0, 5.0))


class Arm:
    """One arm of a rig."""

    def __init__(self, rig: Rig, side: str) -> None:
        """Measure a side's arm, "R" or "L", at rest."""
        self.side = side
        self.shoulder = rig.head(f"upperarm01.{side}")
        self.elbow = rig.head(f"lowerarm01.{side}")
        self.wrist = rig.head(f"wrist.{side}")
        self.upper = float(np.linalg.norm(self.elbow - self.shoulder))
        self.fore = float(np.linalg.norm(self.wrist - self.elbow))
        self._outwards = np.array([0.0, -1.0 if side == "R" else 1.0, 0.0])
        self._hinge = unit(cross(self.elbow - self.shoulder, self.wrist - self.elbow))

    def reachable(self, shoulder: FloatArray, wrist: FloatArray) -> FloatArray:
        """Give the place nearest to `wrist` that the arm can reach, seen from the shoulder."""
        away = wrist - shoulder
        distance = float(np.linalg.norm(away))
        longest = _REACH * (self.upper + self.fore)
        # The elbow bends by at most 150 deg.
        shortest = math.sqrt(
            self.upper**2 + self.fore**2 + 2.0 * self.upper * self.fore * math.cos(math.radians(150.0))
        )
        return shoulder + away / distance * min(max(distance, shortest), longest)

    def elbow_at(self, shoulder: FloatArray, wrist: FloatArray, swivel: float) -> FloatArray:
        """Place the elbow.

        Args:
            shoulder: [m].
            wrist: Within reach [m].
            swivel: By how much the elbow is turned outwards and up about the line from shoulder to wrist,
                from where it hangs by itself [rad].
        """
        line = unit(wrist - shoulder)
        distance = float(np.linalg.norm(wrist - shoulder))
        along = (self.upper**2 - self.fore**2 + distance**2) / (2.0 * distance)
        radius = math.sqrt(max(0.0, self.upper**2 - along**2))
        hanging = np.array([-0.45, 0.0, -1.0]) + 0.42 * self._outwards  # down, a little back and outwards
        down = perpendicular(hanging, line)
        turned = turn(line, swivel * (1.0 if self.side == "R" else -1.0)) @ down
        return shoulder + along * line + radius * turned

    def easiest_swivel(
        self, shoulder: FloatArray, wrist: FloatArray, hand: FloatArray, *, outside: bool = False
    ) -> float:
        """Find the swivel with which the wrist is strained least.

        Args:
            shoulder: [m].
            wrist: [m].
            hand: Rotation of the hand from rest. Shape (3, 3).
            outside: Keep the elbow beside the trunk, whatever that asks of the wrist.
        """
        costs = []
        for swivel in _SWIVELS:
            elbow = self.elbow_at(shoulder, wrist, float(swivel))
            roll, bend = self.wrist_strain(shoulder, elbow, wrist, hand)
            inwards = max(0.0, float((shoulder - elbow) @ self._outwards) - _INWARDS_EASE)
            costs.append(
                _INWARDS_COST * inwards**2 * outside
                + 0.35 * swivel**2
                + 4.0 * max(0.0, abs(roll) - _ROLL_EASE) ** 2
                + 4.0 * max(0.0, bend - _BEND_EASE) ** 2
                + 0.3 * bend**2
                + 0.1 * roll**2
            )
        return float(_SWIVELS[int(np.argmin(costs))])

    def wrist_strain(
        self, shoulder: FloatArray, elbow: FloatArray, wrist: FloatArray, hand: FloatArray
    ) -> tuple[float, float]:
        """Tell by how much the forearm must roll, from rest, and the wrist bend [rad]."""
        roll, swing = self.wrist_joint(shoulder, elbow, wrist, hand)
        return roll, math.acos(float(np.clip((np.trace(swing) - 1.0) / 2.0, -1.0, 1.0)))

    def wrist_joint(
        self, shoulder: FloatArray, elbow: FloatArray, wrist: FloatArray, hand: FloatArray
    ) -> tuple[float, FloatArray]:
        """Split the hand's rotation: roll of the forearm [rad], then bend of the wrist, shape (3, 3)."""
        relative = self._fore_rotation(shoulder, elbow, wrist).T @ hand
        along = unit(self.wrist - self.elbow)
        roll = twist_about(relative, along)
        swing: FloatArray = relative @ turn(along, -roll)
        return roll, swing

    def hand_at(
        self, shoulder: FloatArray, elbow: FloatArray, wrist: FloatArray, roll: float, swing: FloatArray
    ) -> FloatArray:
        """Put the hand's rotation together again: the inverse of `wrist_joint`. Shape (3, 3)."""
        along = unit(self.wrist - self.elbow)
        return self._fore_rotation(shoulder, elbow, wrist) @ swing @ turn(along, roll)

    def bones(
        self, shoulder: FloatArray, elbow: FloatArray, wrist: FloatArray, hand: FloatArray, parent: FloatArray
    ) -> dict[str, FloatArray]:
        """Work out where the bones of the arm go.

        Args:
            shoulder: The joint's place [m].
            elbow: Likewise.
            wrist: Likewise.
            hand: Rotation of the hand from rest. Shape (3, 3).
            parent: Transform of the bone that carries the arm. Shape (4, 4).

        Returns:
            Transform of each bone from rest. Shape (4, 4) each.
        """
        hinge = self._hinge_at(shoulder, elbow, wrist)
        upper = frame(elbow - shoulder, hinge) @ frame(self.elbow - self.shoulder, self._hinge).T
        fore = self._fore_rotation(shoulder, elbow, wrist)
        rest_upper = unit(self.elbow - self.shoulder)
        roll = twist_about(parent[:3, :3].T @ upper, rest_upper)
        half = upper @ turn(rest_upper, -(1.0 - _UPPER_TWIST) * roll)
        rest_fore = unit(self.wrist - self.elbow)
        hand_roll = twist_about(fore.T @ hand, rest_fore)
        side = self.side
        return {
            f"upperarm01.{side}": about(self.shoulder, half, shoulder),
            f"upperarm02.{side}": about(self.shoulder, upper, shoulder),
            f"lowerarm01.{side}": about(self.elbow, fore @ turn(rest_fore, _ELBOW_TWIST * hand_roll), elbow),
            f"lowerarm02.{side}": about(self.elbow, fore @ turn(rest_fore, _WRIST_TWIST * hand_roll), elbow),
            f"wrist.{side}": about(self.wrist, hand, wrist),
        }

    def _hinge_at(self, shoulder: FloatArray, elbow: FloatArray, wrist: FloatArray) -> FloatArray:
        return unit(cross(elbow - shoulder, wrist - elbow))

    def _fore_rotation(self, shoulder: FloatArray, elbow: FloatArray, wrist: FloatArray) -> FloatArray:
        hinge = self._hinge_at(shoulder, elbow, wrist)
        return frame(wrist - elbow, hinge) @ frame(self.wrist - self.elbow, self._hinge).T


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


# Forwards, to the left and above the floor [m].
Foot = tuple[float, float, float]


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
    feet: Mapping[str, Foot] | None = None
    face: Mapping[str, float] = field(default_factory=dict)


class Poser:
    """Brings one person's rig into poses."""

    def __init__(self, rig: Rig) -> None:
        self.rig = rig
        self.arms = {side: Arm(rig, side) for side in SIDES}
        self.hands = {side: Hand(rig, side) for side in SIDES}
        self.legs = {side: Leg(rig, side) for side in SIDES}

    @cached_property
    def places(self) -> Places:
        """The places of the body that hands go to."""
        return Places(self.rig)

    def transforms(self, pose: BodyPose) -> FloatArray:
        """Give the transform of each bone from rest. Shape (bones, 4, 4)."""
        rig = self.rig
        turned = self._trunk(pose)
        feet = self.standing_feet() if pose.feet is None else pose.feet
        root = self._root(pose, feet)
        placed: dict[str, FloatArray] = {}
        chest = rig.transforms(turned, {}, root)[rig.bone("spine01")]
        for side in SIDES:
            girdle, arm = self.arm_bones(side, pose.arms[side])
            turned |= girdle
            placed |= {name: chest @ transform for name, transform in arm.items()}
            placed |= self._leg_bones(side, feet[side], root)
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

    def _root(self, pose: BodyPose, feet: Mapping[str, Foot]) -> FloatArray:
        # As high as the legs can carry the hips, were the feet below them.
        drop = 0.0
        for side, leg in self.legs.items():
            aside = math.hypot(feet[side][0] - pose.place[0], feet[side][1] - pose.place[1] - leg.hip[1])
            highest = math.sqrt(max(0.01, (0.999 * leg.longest) ** 2 - aside**2)) + leg.ankle[2]
            drop = min(drop, highest - leg.hip[2])
        root = about(np.zeros(3), turn(_Z, pose.heading))
        root[:3, 3] = [*pose.place, drop]
        return root

    def standing_feet(self) -> dict[str, Foot]:
        """Give the feet of a person who stands: below the hips and a little apart."""
        return {
            side: (float(self.legs[side].ankle[0]), 1.15 * float(self.legs[side].hip[1]), 0.0)
            for side in SIDES
        }

    def _leg_bones(self, side: str, foot: Foot, root: FloatArray) -> dict[str, FloatArray]:
        leg = self.legs[side]
        forwards, left, above = foot
        hip = (root @ [*leg.hip, 1.0])[:3]
        return leg.bones(hip, np.array([forwards, left, above + leg.ankle[2]]), root[:3, :3])

    @staticmethod
    def _trunk(pose: BodyPose) -> dict[str, FloatArray]:
        bow, aside, twist = (angle / len(_SPINE) for angle in pose.lean)
        spine = turn(_Z, twist) @ turn(_Y, bow) @ turn(_X, -aside)
        yaw, pitch, roll = (angle / len(_NECK) for angle in pose.head)
        neck = turn(_Z, yaw) @ turn(_Y, pitch) @ turn(_X, -roll)
        return dict.fromkeys(_SPINE, spine) | dict.fromkeys(_NECK, neck)
