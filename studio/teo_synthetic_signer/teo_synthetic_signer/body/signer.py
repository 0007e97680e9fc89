# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person who can be posed: skin, clothes and keypoints."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_synthetic_signer.body.appearance import Dress
from teo_synthetic_signer.body.body_data import (
    EARS,
    FACE_VERTICES,
    HEELS,
    NOSE_TIP,
    load_body_data,
    load_target,
)
from teo_synthetic_signer.body.body_shapes import body_shape
from teo_synthetic_signer.body.pose import BodyPose, Poser
from teo_synthetic_signer.body.rig import SIDES, Rig
from teo_synthetic_signer.errors import SyntheticError

_JOINTS = {
    "Shoulder": "upperarm01",
    "Elbow": "lowerarm01",
    "Wrist": "wrist",
    "Hip": "upperleg01",
    "Knee": "lowerleg01",
    "Ankle": "foot",
}
_TOES = {"BigToe": "toe1-2", "SmallToe": "toe5-3"}


@cache
def _facial_action(name: str) -> FloatArray:
    try:
        return load_target(f"faceunits/{name}")
    except SyntheticError as error:
        raise SyntheticError(
            "unknown_facial_action", f"the body model has no facial action {name!r}"
        ) from error


class Signer:
    """One person."""

    def __init__(self, name: str) -> None:
        """Build a person of `BODIES`.

        Raises:
            SyntheticError: Nobody has that name.
        """
        shape = body_shape(name)
        self.rig = Rig.of(shape.phenotype)
        self.poser = Poser(self.rig)
        self.dress = Dress(self.rig, shape)
        self._weights = self.rig.weights[self.dress.sources]
        groups = load_body_data().groups
        self._eyes = {}
        for side in SIDES:
            chosen = self.rig.vertices[np.unique(groups[f"helper-{side.lower()}-eye"])]
            front = float(chosen[:, 0].max())
            self._eyes[side] = np.array([front, *self.rig.head(f"eye.{side}")[1:]])

    @property
    def height(self) -> float:
        """From floor to crown [m]."""
        return float(self.rig.tail("head")[2])

    def vertices(self, pose: BodyPose, transforms: FloatArray) -> FloatArray:
        """Give where the vertices of the visible surface are [m]. Shape (n, 3)."""
        blended = (self._weights @ transforms[:, :3].reshape(-1, 12)).reshape(-1, 3, 4)
        rest = self.dress.vertices + self._moved_face(pose.face)[self.dress.sources]
        placed: FloatArray = np.einsum("nij,nj->ni", blended[:, :, :3], rest) + blended[:, :, 3]
        return placed

    def keypoints(self, pose: BodyPose, transforms: FloatArray) -> tuple[FloatArray, ...]:
        """Give the true places of the keypoints [m]: BODY_25, left hand, right hand, face."""
        rest = self.rig.vertices + self._moved_face(pose.face)

        def joint(name: str, end: bool = False) -> FloatArray:
            bone = self.rig.bone(name)
            place = self.rig.tails[bone] if end else self.rig.heads[bone]
            moved: FloatArray = transforms[bone, :3, :3] @ place + transforms[bone, :3, 3]
            return moved

        def skin(vertices: tuple[int, ...]) -> FloatArray:
            rows = self.rig.weights[list(vertices)] @ transforms[:, :3].reshape(-1, 12)
            blended = rows.reshape(-1, 3, 4)
            moved: FloatArray = (
                np.einsum("nij,nj->ni", blended[:, :, :3], rest[list(vertices)]) + blended[:, :, 3]
            )
            return moved

        body = np.empty((len(BODY_25), 3))
        pupils = []
        for side in SIDES:
            for keypoint, bone in _JOINTS.items():
                body[BODY_25.index[side + keypoint]] = joint(f"{bone}.{side}")
            for keypoint, bone in _TOES.items():
                body[BODY_25.index[side + keypoint]] = joint(f"{bone}.{side}", end=True)
            eye = self.rig.bone(f"eye.{side}")
            pupils.append(transforms[eye, :3, :3] @ self._eyes[side] + transforms[eye, :3, 3])
            body[BODY_25.index[f"{side}Eye"]] = pupils[-1]
            ear, heel = skin((EARS[side], HEELS[side]))
            body[BODY_25.index[f"{side}Ear"]] = ear
            body[BODY_25.index[f"{side}Heel"]] = heel
        body[BODY_25.index["Nose"]] = skin((NOSE_TIP,))[0]
        for middle, ends in (("Neck", "Shoulder"), ("MidHip", "Hip")):
            both = [body[BODY_25.index[side + ends]] for side in SIDES]
            body[BODY_25.index[middle]] = (both[0] + both[1]) / 2.0
        hands = {}
        for side in SIDES:
            points = [joint(f"wrist.{side}")]
            for finger in range(1, 6):
                points += [joint(f"finger{finger}-{i}.{side}") for i in (1, 2, 3)]
                points.append(joint(f"finger{finger}-3.{side}", end=True))
            hands[side] = np.array(points)
        face = np.concatenate([skin(FACE_VERTICES), np.array(pupils)])
        return body, hands["L"], hands["R"], face

    def _moved_face(self, actions: Mapping[str, float]) -> FloatArray:
        moved = np.zeros_like(self.rig.vertices)
        for name, strength in actions.items():
            if strength > 0.0:
                moved += strength * _facial_action(name)
        return moved
