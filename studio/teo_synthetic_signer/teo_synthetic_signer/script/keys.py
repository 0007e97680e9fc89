# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Key poses in words: hands at places of the body, facing somewhere, in a shape."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.hand import HAND_SHAPES, OTHER_HAND, HandShape, hand_point
from teo_synthetic_signer.body.pose import ArmPose, Poser
from teo_synthetic_signer.body.rig import PLACES
from teo_synthetic_signer.body.rotations import about, cross, frame, turn
from teo_synthetic_signer.errors import named, unknown_name

# Forwards, outwards (away from the body's middle, on the hand's side) and up.
Vector = tuple[float, float, float]

# Shoulder to wrist of the person for whom offsets are written [m]; others' are scaled by theirs.
_ARM_LENGTH = 0.53


@dataclass(frozen=True, kw_only=True)
class Swing:
    """By how much joints of an arm are turned after its hand is where it goes: what a wiggle needs [rad].

    Attributes:
        wrist: Bends the hand towards the thumb's side.
        forearm: Rolls the palm upwards, as a right hand turns a key to the right.
        elbow: Stretches the arm.
    """

    wrist: float = 0.0
    forearm: float = 0.0
    elbow: float = 0.0


@dataclass(frozen=True, kw_only=True)
class ArmKey:
    """Where an arm goes.

    Attributes:
        at: One of `PLACES`, or of `OTHER_HAND`.
        offset: From there [m, for an arm of 0.53 m].
        point: Of the hand that goes there, one of `POINTS`.
        fingers: Where straight fingers would point.
        palm: Where the palm faces.
        shape: Of the hand, by its name or in full.
        swing: Of joints, from there.
        swivel: Turns the elbow further outwards and up than is easiest [rad].
    """

    at: str = "shoulders"
    offset: Vector = (0.0, 0.0, 0.0)
    point: str = "palm"
    fingers: Vector = (0.0, 0.0, 1.0)
    palm: Vector = (1.0, 0.0, 0.0)
    shape: str | HandShape = "flat"
    swing: Swing = Swing()
    swivel: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Key:
    """One key pose and how it is reached.

    Attributes:
        right: Where the right arm goes; None leaves it where it is.
        left: Likewise.
        move: How long it takes to get there [s].
        hold: How long it stays [s].
        arc: By how much hands come forwards on the way, of the length of the way.
        bulge: By how much the hands' way swings out in its middle [m, for an arm of 0.53 m].
        place: Forwards and to the left [m].
        heading: Turned to the left [rad].
        lean: See `BodyPose`.
        head: See `BodyPose`.
        step: The foot, "R" or "L", that is lifted on the way, if one is.
        face: Facial actions.
        through: Goes on without a stop; there is no hold then, no arc and no bulge.
        keep_out: Hands go round the body and each other instead of through them.
    """

    right: ArmKey | None = None
    left: ArmKey | None = None
    move: float = 0.45
    hold: float = 0.15
    arc: float = 0.12
    bulge: Vector = (0.0, 0.0, 0.0)
    place: tuple[float, float] = (0.0, 0.0)
    heading: float = 0.0
    lean: Vector = (0.0, 0.0, 0.0)
    head: Vector = (0.0, 0.0, 0.0)
    step: str | None = None
    face: Mapping[str, float] = field(default_factory=dict)
    through: bool = False
    keep_out: bool = False


class KeyResolver:
    """Turns key poses in words into poses of one person.

    Attributes:
        shortfall: By how much a hand stayed off its place at most, as arms are too short or elbows bend no
            further [m].
    """

    def __init__(self, poser: Poser) -> None:
        self._poser = poser
        self.shortfall = 0.0
        self._scale = (poser.arms["R"].upper + poser.arms["R"].fore) / _ARM_LENGTH

    def swung_out(self, side: str, bulge: Vector) -> FloatArray:
        """Give a hand's `Key.bulge` in the axes of the body [m]. Shape (3,)."""
        outwards = np.array([1.0, -1.0 if side == "R" else 1.0, 1.0])
        way: FloatArray = self._scale * np.array(bulge) * outwards
        return way

    def arm(self, side: str, key: ArmKey, other: ArmPose | None, *, outside: bool = False) -> ArmPose:
        """Resolve one arm.

        Args:
            side: "R" or "L".
            key: What it does.
            other: What the other arm does, if its place is asked for.
            outside: Keep the elbow out of the trunk.

        Raises:
            SyntheticError: A place, point or shape that does not exist.
        """
        shape = named("hand_shape", key.shape, HAND_SHAPES) if isinstance(key.shape, str) else key.shape
        hand = self._poser.hands[side]
        outwards = np.array([1.0, -1.0 if side == "R" else 1.0, 1.0])
        rotation = (
            frame(np.array(key.fingers) * outwards, np.array(key.palm) * outwards)
            @ frame(hand.axes[:, 0], hand.axes[:, 1]).T
        )
        anchor = self._anchor(side, key.at, other)
        target = anchor + self._scale * np.array(key.offset) * outwards
        wrist = target - rotation @ (hand_point(hand, shape, key.point) - hand.wrist)
        arm = self._poser.arms[side]
        _, shoulder = self._poser.girdle(side, wrist)
        wanted, wrist = wrist, arm.reachable(shoulder, wrist)
        self.shortfall = max(self.shortfall, float(np.linalg.norm(wrist - wanted)))
        swivel = arm.easiest_swivel(shoulder, wrist, rotation, outside=outside) + key.swivel
        return self._swung(side, ArmPose(wrist, rotation, swivel, shape), key.swing)

    def _swung(self, side: str, pose: ArmPose, swing: Swing) -> ArmPose:
        if swing == Swing():
            return pose
        sign = 1.0 if side == "R" else -1.0  # the same about a right and a left axis mirrors
        shoulder, elbow, wrist = self._poser.limb(side, pose.wrist, pose.swivel)
        palm = pose.hand @ self._poser.hands[side].axes[:, 1]
        hand = turn(wrist - elbow, sign * swing.forearm) @ turn(palm, -sign * swing.wrist) @ pose.hand
        stretch = about(elbow, turn(cross(elbow - shoulder, wrist - elbow), -swing.elbow))
        moved = (stretch @ [*wrist, 1.0])[:3]
        return ArmPose(moved, stretch[:3, :3] @ hand, pose.swivel, pose.shape)

    def _anchor(self, side: str, at: str, other: ArmPose | None) -> FloatArray:
        if at in PLACES:
            return self._poser.places.at(at, side)
        if at in OTHER_HAND and other is not None:
            hand = self._poser.hands["L" if side == "R" else "R"]
            point = hand_point(hand, other.shape, OTHER_HAND[at])
            return other.wrist + other.hand @ (point - hand.wrist)
        raise unknown_name("place", at, (*PLACES, *(f"{name} (one hand only)" for name in OTHER_HAND)))
