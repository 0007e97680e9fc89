"""Key poses in words: hands at places of the body, facing somewhere, in a shape."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.synthetic.body_data import load_body_data
from teo_skeleton_retriever.synthetic.errors import unknown_name
from teo_skeleton_retriever.synthetic.hand_shapes import hand_shape
from teo_skeleton_retriever.synthetic.pose import ArmPose, Poser
from teo_skeleton_retriever.synthetic.rig import Rig
from teo_skeleton_retriever.synthetic.rotations import frame

Vector = tuple[float, float, float]
"""Forwards, outwards (away from the body's middle, on the hand's side) and up."""

_ARM_LENGTH = 0.53
"""Shoulder to wrist of the person for whom offsets are written [m]; others' are scaled by theirs."""
_ARM_BONES = ("upperarm", "lowerarm", "wrist", "metacarpal", "finger")
PLACES = ("shoulders", "sternum", "belly", "chin", "mouth", "nose", "forehead", "temple", "hip", "side")


@dataclass(frozen=True, kw_only=True)
class ArmKey:
    """Where an arm goes.

    Attributes:
        at: one of `PLACES`, or "other_palm", "other_wrist".
        offset: from there [m, for an arm of 0.53 m].
        point: of the hand that goes there: "wrist", "palm", "index_tip" or "middle_tip".
        fingers: where straight fingers would point.
        palm: where the palm faces.
        shape: of the hand.
        swivel: turns the elbow further outwards and up than is easiest [rad].
    """

    at: str = "shoulders"
    offset: Vector = (0.0, 0.0, 0.0)
    point: str = "palm"
    fingers: Vector = (0.0, 0.0, 1.0)
    palm: Vector = (1.0, 0.0, 0.0)
    shape: str = "flat"
    swivel: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Key:
    """One key pose and how it is reached.

    Attributes:
        right: where the right arm goes; None leaves it where it is.
        left: likewise.
        move: how long it takes to get there [s].
        hold: how long it stays [s].
        arc: by how much hands come forwards on the way, of the length of the way.
        place: forwards and to the left [m].
        heading: turned to the left [rad].
        lean: see `BodyPose`.
        head: see `BodyPose`.
        step: the foot, "R" or "L", that is lifted on the way, if one is.
        face: facial actions.
    """

    right: ArmKey | None = None
    left: ArmKey | None = None
    move: float = 0.45
    hold: float = 0.15
    arc: float = 0.12
    place: tuple[float, float] = (0.0, 0.0)
    heading: float = 0.0
    lean: Vector = (0.0, 0.0, 0.0)
    head: Vector = (0.0, 0.0, 0.0)
    step: str | None = None
    face: Mapping[str, float] = field(default_factory=dict)


class Places:
    """Where the places of a body are while it stands at rest."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._skin = np.unique(load_body_data().groups["body"])
        right, left = rig.head("upperarm01.R"), rig.head("upperarm01.L")
        eyes = (rig.head("eye.R") + rig.head("eye.L")) / 2.0
        head = rig.tail("head")
        hips = (rig.head("upperleg01.R") + rig.head("upperleg01.L")) / 2.0
        shoulders = (right + left) / 2.0
        trunk = shoulders[2] - hips[2]
        face = head[2] - eyes[2]  # from the eyes to the crown, which is as far as from the eyes to the chin
        self._half_hips = self._half_width(float(hips[2]))
        self._half_head = 0.55 * float(face)
        self.middle = {
            "shoulders": shoulders,
            "sternum": self._front(shoulders[2] - 0.22 * trunk),
            "belly": self._front(shoulders[2] - 0.62 * trunk),
            "chin": self._front(eyes[2] - 0.93 * face),
            "mouth": self._front(eyes[2] - 0.58 * face),
            "nose": self._front(eyes[2] - 0.30 * face),
            "forehead": self._front(eyes[2] + 0.45 * face),
            "temple": np.array([eyes[0], 0.0, eyes[2] + 0.1 * face]),
            "hip": hips,
            "side": hips,
        }

    def _front(self, height: float) -> FloatArray:
        """Find the foremost skin at a height, in the middle of the body."""
        skin = self._rig.vertices[self._skin]
        near = np.abs(skin - [0.0, 0.0, height])
        chosen = skin[(near[:, 1] < 0.03) & (near[:, 2] < 0.012)]
        return np.array([chosen[:, 0].max(), 0.0, height])

    def _half_width(self, height: float) -> float:
        """Measure the hips: half of how wide the body is at a height and a hand's breadth above [m]."""
        skin = self._rig.vertices[self._skin]
        arms = [i for i, name in enumerate(load_body_data().bones) if name.startswith(_ARM_BONES)]
        trunk = self._rig.weights[self._skin][:, arms].sum(axis=1) < 0.1
        near = trunk & (skin[:, 2] > height) & (skin[:, 2] < height + 0.1)
        return float(np.abs(skin[near, 1]).max())

    def outwards(self, place: str) -> float:
        """Tell how far a place is from the body's middle, on the side of the hand [m]."""
        if place == "temple":
            return self._half_head
        if place == "side":
            return self._half_hips
        return 0.0


class KeyResolver:
    """Turns key poses in words into poses of one person."""

    def __init__(self, poser: Poser) -> None:
        self._poser = poser
        self._places = Places(poser.rig)
        self._scale = (poser.arms["R"].upper + poser.arms["R"].fore) / _ARM_LENGTH

    def arm(self, side: str, key: ArmKey, other: ArmPose | None) -> ArmPose:
        """Resolve one arm.

        Args:
            side: "R" or "L".
            key: what it does.
            other: what the other arm does, if its place is asked for.

        Raises:
            SyntheticError: a place, point or shape that does not exist.
        """
        shape = hand_shape(key.shape)
        hand = self._poser.hands[side]
        outwards = np.array([1.0, -1.0 if side == "R" else 1.0, 1.0])
        rotation = (
            frame(np.array(key.fingers) * outwards, np.array(key.palm) * outwards)
            @ frame(hand.axes[:, 0], hand.axes[:, 1]).T
        )
        joints = hand.joints(shape)
        points = {
            "wrist": joints[0],
            "palm": (joints[0] + joints[9]) / 2.0,
            "index_tip": joints[8],
            "middle_tip": joints[12],
        }
        if key.point not in points:
            raise unknown_name("point", key.point, points)
        anchor = self._anchor(side, key.at, other)
        target = anchor + self._scale * np.array(key.offset) * outwards
        wrist = target - rotation @ (points[key.point] - hand.wrist)
        arm = self._poser.arms[side]
        _, shoulder = self._poser.girdle(side, wrist)
        wrist = arm.reachable(shoulder, wrist)
        swivel = arm.easiest_swivel(shoulder, wrist, rotation) + key.swivel
        return ArmPose(wrist, rotation, swivel, shape)

    def _anchor(self, side: str, at: str, other: ArmPose | None) -> FloatArray:
        if at in self._places.middle:
            outwards = -1.0 if side == "R" else 1.0
            middle = self._places.middle[at]
            aside = np.array([0.0, outwards * self._places.outwards(at), 0.0])
            place: FloatArray = middle + aside
            return place
        if at in ("other_palm", "other_wrist") and other is not None:
            hand = self._poser.hands["L" if side == "R" else "R"]
            joints = hand.joints(other.shape)
            middle = (joints[9] - joints[0]) / 2.0 if at == "other_palm" else np.zeros(3)
            anchor: FloatArray = other.wrist + other.hand @ middle
            return anchor
        raise unknown_name("place", at, (*PLACES, "other_palm", "other_wrist (one hand only)"))
