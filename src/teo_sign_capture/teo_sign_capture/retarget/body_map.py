# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where on a robot a place at or before a person's body is.

A robot is not built as a person: TEO's shoulders are nearly twice as far apart, its head is small. In the
air the workspace is scaled axis by axis (`_WorkspaceScaling`): crown, shoulders and waist keep their heights;
distances before the body scale with the length of the arms; sideways the scale is half-way between both, so
that circles stay nearly round; and arms stretched out, or hanging, stay so.

At the body this is bent so that each place of articulation comes to lie on TEO's own
(`signing_space`): a chin is a chin. What is between is interpolated smoothly, and the bend fades away
from the body within a forearm's length. At the head all this is done in the head's own axes: a hand at the
chin stays there while the head turns.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pinocchio as pin
from scipy.interpolate import PchipInterpolator

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.head_motion import HeadMotion
from teo_sign_capture.signing_space import MIRROR, find_place
from teo_sign_capture.tracks.signer_motion import Person

# Share of the way from the shoulders to the hips at which the waist is.
_WAIST = 0.7
# [m] Distance beyond any arm, from which on lengths are scaled like an arm's.
_BEYOND = 3.0


class _WorkspaceScaling:
    """The map of one person's space to TEO's, both from between the shoulders.

    Attributes:
        scale: What lengths are multiplied by before the chest: forwards, sideways, up. Shape (3,).
    """

    def __init__(self, person: Person, reach: float, shoulder: float, height: float, crown: float) -> None:
        """Find it.

        Args:
            person: The person.
            reach: Of the robot's arm, shoulder to palm [m].
            shoulder: Half the distance between the robot's shoulders [m].
            height: Of the robot's shoulders above its hips [m].
            crown: The robot's height above its shoulders [m].
        """
        along, own_crown = reach / person.arm, person.places["head_top"][2]
        across = (along + crown / own_crown) / 2.0
        self._along = along
        self._aside = _monotone(
            [0.0, person.shoulder, person.shoulder + person.arm],
            [0.0, across * person.shoulder, shoulder + reach],
            along,
        )
        self._up = _monotone(
            [-person.arm, -_WAIST * person.trunk, 0.0, own_crown],
            [-reach, -_WAIST * height, 0.0, crown],
            along,
        )
        self.scale: Array = np.array([along, across, height / person.trunk])

    def __call__(self, points: Array) -> Array:
        """Points of TEO's space for points of the person's [m]. Shapes (n, 3)."""
        x, y, z = points.T
        return np.stack([self._along * x, np.sign(y) * self._aside(np.abs(y)), self._up(z)], axis=1)


def _monotone(ours: list[float], theirs: list[float], slope: float) -> PchipInterpolator:
    """A smooth map through pairs that grows everywhere, and goes on with a slope at both ends."""
    return PchipInterpolator(
        [ours[0] - _BEYOND, *ours, ours[-1] + _BEYOND],
        [theirs[0] - slope * _BEYOND, *theirs, theirs[-1] + slope * _BEYOND],
    )


# Middle and half sides [m].
Box = tuple[Array, Array]

# [m] Length over which the bend fades, on a person whose trunk is `_TRUNK` long: a contact is felt about a
# hand's width off the skin; wider, and the places of the face would pull at what is signed before the chest.
_REACH = 0.12
_TRUNK = 0.48
# How far, as a share, places that are next to each other may give way to each other: without it two places
# that TEO has nearer together than a person fold the space before them.
_GIVE = 0.02
# [m] The middle of a finger that touches is so far off the skin.
_SKIN = 0.015
# [m] Nearer to the middle of the head a hand goes with it, farther it does not, for the same person.
_HEAD_HELD, _HEAD_LEFT = 0.17, 0.32

# [m] Across the view a hand no farther from the middle of the head is at the face, chin to crown; farther
# than the other it is beside it.
_AT_FACE, _OFF_FACE = 0.12, 0.20

# A person's places on the midline, and those aside, which stand for both sides, with their names in
# `signing_space`.
_MIDDLE = ("head_top", "forehead", "nose", "mouth", "chin", "throat", "upper_chest", "chest", "belly")
_ASIDE = {"eye": "eye", "ear": "ear", "shoulder": "shoulder", "chest_aside": "other_chest"}


class BodyMap:
    """The map from one person's body to TEO's, head and trunk of TEO at home.

    Attributes:
        humanoid: The robot.
        scale: What lengths are multiplied by before the chest: forwards, sideways, up. Shape (3,).
        shoulder_height: Of TEO's shoulders above its hips [m].
    """

    def __init__(self, robot: Robot, arm: ArmKinematics, person: Person) -> None:
        reach, shoulder = arm.reach, -float(arm.shoulder[1])
        self._origin = arm.shoulder * (1.0, 0.0, 1.0)
        self.shoulder_height = float(arm.shoulder[2])
        self.humanoid = robot.humanoid
        crown = find_place(self.humanoid, "head_top").point[2] - self.shoulder_height
        self._scaling = _WorkspaceScaling(person, reach, shoulder, self.shoulder_height, crown)
        self.scale: Array = self._scaling.scale
        self._size = person.trunk / _TRUNK
        self._boxes = body_boxes(robot)
        self._centres, wanted = self._pairs(person)
        bends = wanted - self._far(self._centres)
        near = self._nearness(self._centres) + _GIVE * np.eye(len(bends))
        self._weights = np.linalg.solve(near, bends)
        self._head = person.head

    def place(self, points: Array) -> Array:
        """Where points at the person's body are on TEO, both heads straight [m]. Shapes (..., 3)."""
        flat = points.reshape(-1, 3)
        placed: Array = self._far(flat) + self._nearness(flat) @ self._weights
        return placed.reshape(points.shape)

    def place_with_head(self, points: Array, head: HeadMotion) -> Array:
        """The same while both heads move. Shapes (T, k, 3) [m]."""
        placed, share = self._placed_straight(points, head)
        turned = np.einsum("tij,tkj->tki", head.robot_turns, placed - head.pivot) + head.pivot
        moved: Array = placed + share * (turned - placed)
        return moved

    def distance(self, points: Array, head: HeadMotion) -> Array:
        """How far the places that TEO has for points are from TEO's trunk and head [m]. (T, k, 3), (T, k)."""
        placed, _ = self._placed_straight(points, head)
        away = [
            np.linalg.norm(np.maximum(np.abs(placed - middle) - half, 0.0), axis=-1)
            for middle, half in self._boxes
        ]
        nearest: Array = np.min(away, axis=0)
        return nearest

    def outside(self, points: Array) -> Array:
        """Points that would be within TEO's trunk or head, moved out by the shortest way but the back [m].

        What a camera finds a few centimetres too deep, or is lifted so, is on the skin. Shape (T, 3).
        """
        moved = points.copy()
        for middle, half in self._boxes:
            away = moved - middle
            room = half + _SKIN
            inside = (np.abs(away) < room).all(axis=1)
            out = room - np.stack([away[:, 0], np.abs(away[:, 1]), np.abs(away[:, 2])], axis=1)
            axis = out.argmin(axis=1)
            sign = np.where(axis == 0, 1.0, np.where(away[np.arange(len(away)), axis] < 0.0, -1.0, 1.0))
            moved[inside, axis[inside]] += (sign * out[np.arange(len(away)), axis])[inside]
        return moved

    def _placed_straight(self, points: Array, head: HeadMotion) -> tuple[Array, Array]:
        """Places before TEO's head turns [m], and how much they go with it. Shapes (T, k, 3), (T, k, 1)."""
        share = self._head_share(points, head)[..., None]
        straight = np.einsum("tij,tki->tkj", head.turns, points - head.places[:, None]) + self._head
        return self.place(points + share * (straight - points)), share

    def _head_share(self, points: Array, head: HeadMotion) -> Array:
        """By how much points go with the head, 0 to 1. Shape (T, k)."""
        away = np.linalg.norm(points - head.places[:, None], axis=-1) / self._size
        return smooth_step((_HEAD_LEFT - away) / (_HEAD_LEFT - _HEAD_HELD))

    def at_face(self, points: Array, head: HeadMotion) -> Array:
        """How much a hand is at the face for who watches, 0 to 1, by its points. Shapes (T, k, 3), (T,)."""
        away = np.linalg.norm((points - head.places[:, None])[..., 1:], axis=-1).min(axis=1) / self._size
        return smooth_step((_OFF_FACE - away) / (_OFF_FACE - _AT_FACE))

    def _far(self, points: Array) -> Array:
        moved: Array = self._origin + self._scaling(points)
        return moved

    def _nearness(self, points: Array) -> Array:
        """How much a bend at each of the places is felt at points: Matern's kernel of order 3/2."""
        away = np.linalg.norm(points[:, None] - self._centres, axis=-1) * (
            np.sqrt(3.0) / (_REACH * self._size)
        )
        felt: Array = (1.0 + away) * np.exp(-away)
        return felt

    def _pairs(self, person: Person) -> tuple[Array, Array]:
        """Places on the person, and the same on TEO. Shapes (k, 3)."""
        ours, theirs = [], []
        for name in _MIDDLE:
            ours.append(person.places[name])
            theirs.append(on_skin(self.humanoid, self._boxes, name) * (1.0, 0.0, 1.0))
        for name, place in _ASIDE.items():
            right = on_skin(self.humanoid, self._boxes, place)
            right[1] = -abs(right[1])
            for side in (np.ones(3), MIRROR):
                ours.append(person.places[name] * side)
                theirs.append(right * side)
        return np.array(ours), np.array(theirs)


def on_skin(humanoid: Humanoid, boxes: list[Box], name: str) -> Array:
    """A place on a robot, moved out of the shapes that count in a collision [m]. Shape (3,)."""
    place = find_place(humanoid, name)
    out = place.outward
    leaving = [0.0]
    for middle, half in boxes:
        inside = place.point - middle
        if (np.abs(inside) < half).all():
            with np.errstate(divide="ignore"):
                leaving.append(float(np.min((half - np.sign(out) * inside) / np.abs(out))))
    return np.asarray(place.point + max(leaving) * out)


def smooth_step(share: Array) -> Array:
    """0 below 0, 1 above 1, and smooth between."""
    inside = np.clip(share, 0.0, 1.0)
    step: Array = inside * inside * (3.0 - 2.0 * inside)
    return step


def body_boxes(robot: Robot) -> list[Box]:
    """Middles and half sides of boxes round the shapes of trunk and head, at home [m]."""
    humanoid = robot.humanoid
    geometry = pin.buildGeomFromUrdfString(robot.model, humanoid.urdf_text(), pin.GeometryType.COLLISION)
    moved_by = {*humanoid.trunk[-1:], *humanoid.head[-1:]}
    found = []
    for item in geometry.geometryObjects:
        link = robot.model.frames[item.parentFrame].name
        if link not in humanoid.file.collision.torso or robot.moving_joint(link) not in moved_by:
            continue
        shape = robot.model.frames[item.parentFrame].placement.inverse() * item.placement
        home = robot.placement(robot.configuration({}), link)
        middle = home[:3, :3] @ shape.translation + home[:3, 3]
        found.append((middle, np.abs(home[:3, :3] @ shape.rotation) @ _half_sides(item.geometry)))
    return found


def _half_sides(shape: Any) -> Array:
    """Half the sides of the box round a shape of Coal's, which knows no type of its own. Shape (3,) [m]."""
    if hasattr(shape, "halfSide"):
        return np.asarray(shape.halfSide)
    half = getattr(shape, "halfLength", shape.radius)
    return np.array([shape.radius, shape.radius, half])
