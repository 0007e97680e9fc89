# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A body at rest: mesh, joints, how its skin follows its bones, and the places that hands go to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.body_data import EARS, load_body_data
from teo_synthetic_signer.body.body_shapes import Phenotype, shape_vertices
from teo_synthetic_signer.body.rotations import perpendicular, unit
from teo_synthetic_signer.body.surface import RayCaster

SIDES = ("R", "L")

# Lengths of the proximal and the middle phalanx of the fingers [mm].
# Source: Buryanov and Kotiuk, Proportions of hand segments, Int. J. Morphol. 28(3), 2010.
_PHALANGES = {2: (39.78, 22.38), 3: (44.63, 26.33), 4: (41.37, 25.65), 5: (32.74, 18.11)}
_SHOULDER_REACH = 0.015  # how near, from above, skin counts as above the joint [m]
_SHOULDER_RAISE = 0.25  # of the joint, of the way to the skin above it
# Where the thumb's first joint is, from the wrist: along the hand, out of the palm, to the thumb's side, for
# a hand of 0.18 m from wrist to fingertip [m]. By the size of the bones of the wrist; no single source.
_TRAPEZIUM = np.array([0.024, 0.006, 0.022])
# From the end of a finger to the keypoint of its tip, the middle of the fingertip [m].
_TIP_BELOW_SKIN = 0.006


@dataclass(frozen=True, eq=False)
class Rig:
    """One person's body at rest, standing at the origin, the floor at z = 0.

    Attributes:
        vertices: Shape (n, 3).
        heads: Of each bone, the centre of the joint about which it turns [m]. Shape (bones, 3).
        tails: Of each bone, its end; of the last bone of a finger the middle of the fingertip [m].
        weights: How much each vertex follows each bone. Shape (n, bones), sparse.
    """

    vertices: FloatArray
    heads: FloatArray
    tails: FloatArray
    weights: csr_array

    @classmethod
    def of(cls, phenotype: Phenotype) -> Rig:
        """Build the body of such a person."""
        data = load_body_data()
        vertices = shape_vertices(phenotype)
        feet = vertices[np.unique(data.groups["body"])][:, 2].min()
        root = data.bones.index("root")
        middle = vertices[data.head_vertices[root]].mean(axis=0)
        vertices = vertices - [middle[0], 0.0, feet]
        heads = np.array([vertices[chosen].mean(axis=0) for chosen in data.head_vertices])
        tails = np.array([vertices[chosen].mean(axis=0) for chosen in data.tail_vertices])
        rig = cls(vertices, heads, tails, csr_array(data.weights))
        for side in SIDES:
            rig._place_shoulder(side)
            rig._place_knuckles(side)
        return rig

    @staticmethod
    def bone(name: str) -> int:
        """Give the index of a bone."""
        return load_body_data().bones.index(name)

    def head(self, name: str) -> FloatArray:
        """Give the joint about which a bone turns [m]."""
        joint: FloatArray = self.heads[self.bone(name)]
        return joint

    def tail(self, name: str) -> FloatArray:
        """Give the end of a bone [m]."""
        end: FloatArray = self.tails[self.bone(name)]
        return end

    def _place_shoulder(self, side: str) -> None:
        """Raise the shoulder joint to where anatomy has it.

        MakeHuman's is 6 cm below the skin. The head of the humerus is a tenth of the upper arm below the tip
        of the acromion (De Leva, J. Biomechanics 29, 1996), which is 3 cm, and that is a centimetre or more
        below the skin.
        """
        bone = self.bone(f"upperarm01.{side}")
        near = np.hypot(*(self.vertices - self.heads[bone])[:, :2].T) < _SHOULDER_REACH
        on_body = np.isin(np.arange(len(self.vertices)), np.unique(load_body_data().groups["body"]))
        top = float(self.vertices[near & on_body][:, 2].max())
        self.heads[bone, 2] += _SHOULDER_RAISE * (top - self.heads[bone, 2])

    def _place_knuckles(self, side: str) -> None:
        """Move the joints at the base of each finger to where anatomy has them, and tips into the finger.

        MakeHuman's rig bends the fingers at the web, 7 to 16 mm beyond the knuckle, and the thumb in the
        middle of its metacarpal. The finger's other joints, which are at the creases, give the scale.
        """
        self._place_trapezium(side)
        for finger in range(1, 6):
            base, second, last = (self.bone(f"finger{finger}-{i}.{side}") for i in (1, 2, 3))
            if finger in _PHALANGES:
                proximal, middle = _PHALANGES[finger]
                length = proximal / middle * np.linalg.norm(self.heads[last] - self.heads[second])
                # Back along the metacarpal, from where the rig has the knuckle.
                away = self.heads[base] - self.heads[second]
                hand = self.head(f"metacarpal{finger - 1}.{side}") - self.heads[base]
                away = away + hand / np.linalg.norm(hand) * max(0.0, length - np.linalg.norm(away))
                self.heads[base] = self.heads[second] + away / np.linalg.norm(away) * length
                self.tails[self.bone(f"metacarpal{finger - 1}.{side}")] = self.heads[base]
            end = self.tails[last] - self.heads[last]
            self.tails[last] -= end / np.linalg.norm(end) * _TIP_BELOW_SKIN

    def _place_trapezium(self, side: str) -> None:
        wrist = self.head(f"wrist.{side}")
        middle = self.tail(f"finger3-3.{side}")
        along, palm, across = self.hand_axes(side).T
        scale = float(np.linalg.norm(middle - wrist)) / 0.18
        shift = along * _TRAPEZIUM[0] + palm * _TRAPEZIUM[1] + across * _TRAPEZIUM[2]
        self.heads[self.bone(f"finger1-1.{side}")] = wrist + scale * shift

    def hand_axes(self, side: str) -> FloatArray:
        """Give a hand's own axes: columns along the fingers, out of the palm, towards the thumb's side.

        They are the same directions of either hand, so those of a left hand are left-handed.
        """
        along = unit(self.head(f"finger3-1.{side}") - self.head(f"wrist.{side}"))
        across = perpendicular(self.head(f"finger2-1.{side}") - self.head(f"finger5-1.{side}"), along)
        palm = np.cross(across, along) if side == "R" else np.cross(along, across)
        return np.column_stack([along, palm, across])

    def transforms(
        self, turned: Mapping[str, FloatArray], placed: Mapping[str, FloatArray], root: FloatArray
    ) -> FloatArray:
        """Work out where each bone goes.

        Args:
            turned: Rotations of bones about their heads, relative to their parents, in the axes of the
                body at rest. Shape (3, 3) each.
            placed: Bones whose transform from rest is given, whatever their parents do. Shape (4, 4) each.
            root: Transform of the whole body. Shape (4, 4).

        Returns:
            From places at rest to places now. Shape (bones, 4, 4).
        """
        data = load_body_data()
        result = np.empty((len(data.bones), 4, 4))
        for i, (name, parent) in enumerate(zip(data.bones, data.parents, strict=True)):
            if name in placed:
                result[i] = placed[name]
                continue
            above = root if parent < 0 else result[parent]
            if name in turned:
                local = np.eye(4)
                local[:3, :3] = turned[name]
                local[:3, 3] = self.heads[i] - turned[name] @ self.heads[i]
                above = above @ local
            result[i] = above
        return result


def blended(weights: csr_array, transforms: FloatArray) -> FloatArray:
    """Blend the transforms of bones by how much each vertex follows them. Shape (n, 3, 4)."""
    blend: FloatArray = (weights @ transforms[:, :3].reshape(-1, 12)).reshape(-1, 3, 4)
    return blend


def skinned(blend: FloatArray, vertices: FloatArray) -> FloatArray:
    """Bring vertices from rest to a pose, by linear blend skinning. Shape (n, 3)."""
    moved: FloatArray = np.einsum("nij,nj->ni", blend[:, :, :3], vertices) + blend[:, :, 3]
    return moved


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
        return outside - distance * np.array(direction)


def arm_share(rig: Rig) -> FloatArray:
    """Give by how much each vertex follows the bones of the arms. Shape (n,)."""
    arms = [i for i, name in enumerate(load_body_data().bones) if name.startswith(_ARM_BONES)]
    return np.asarray(rig.weights[:, arms].sum(axis=1)).ravel()
