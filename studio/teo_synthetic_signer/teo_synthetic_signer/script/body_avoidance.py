# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Hands that go round a body instead of through it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.spatial import cKDTree

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.body_data import load_body_data
from teo_synthetic_signer.body.hand import hand_point
from teo_synthetic_signer.body.pose import ArmPose, Poser
from teo_synthetic_signer.body.rig import SIDES, arm_share, blended, skinned
from teo_synthetic_signer.body.rotations import unit
from teo_synthetic_signer.body.surface import vertex_normals

# Bones of what is kept out: the hand and the lower half of the forearm. The rest follows the elbow.
_HAND = ("lowerarm02", "wrist", "metacarpal", "finger")
# A point is inside a skin if it is behind the skin's nearest vertex: less than 15 mm away, as vertices are
# that far apart, or nearly straight behind it. Else it is beside the end of the skin, as at the shoulder.
_NEAR, _ALONG = 0.015, 0.6
# Times that a hand is moved and looked at again; after four or five nothing moves.
_ROUNDS = 12
# Of a hand's thousand vertices, every third is looked at: they are 3 mm apart.
_EVERY = 3
# Skin that is so little inside other skin touches it [m].
_ENOUGH = 5e-4
# Wrists that are so far apart cannot have arms in each other [m].
_FAR_APART = 0.7
# Added to the way from the left hand to the right one: where they are one, they part to their sides [m].
_TO_THE_RIGHT = np.array([0.0, -0.01, 0.0])
# How far clothes stand off the trunk's skin [m]; see `signer`.
_CLOTH = 0.006


class _Skin(NamedTuple):
    places: FloatArray  # (n, 3) [m]
    normals: FloatArray  # (n, 3), out of the body


class _Limb(NamedTuple):
    """Forearm and hand of a side."""

    vertices: NDArray[np.int64]
    weights: csr_array  # (n, bones)
    bones: tuple[str, ...]


class Clearing:
    """Keeps the hands of one person out of the body, and the arms out of each other; both give way.

    The head counts as it is at rest, whatever way it is turned.
    """

    def __init__(self, poser: Poser) -> None:
        """Find the skin that hands must not go into."""
        self._poser = poser
        rig = poser.rig
        triangles = load_body_data().groups["body"]
        self._normals = vertex_normals(rig.vertices, triangles)
        skin = np.unique(triangles)
        share = arm_share(rig)
        self._trunk = _Skin(*(field[skin[share[skin] < 0.3]] for field in (rig.vertices, self._normals)))
        collar = float(rig.head("neck01")[2])
        self._trunk.places[:] += _CLOTH * self._trunk.normals * (self._trunk.places[:, 2:] < collar)
        self._tree = cKDTree(self._trunk.places)
        self._limbs = {side: self._limb(side, skin) for side in SIDES}
        self._known: dict[str, tuple[ArmPose, ArmPose]] = {}

    def cleared(self, arms: Mapping[str, ArmPose]) -> dict[str, ArmPose]:
        """Move hands off what they are in, the shortest way; they keep their turn and shape."""
        kept = {side: self._out_of_trunk(side, arms[side]) for side in SIDES}
        if np.linalg.norm(kept["R"].wrist - kept["L"].wrist) > _FAR_APART:
            return kept
        skins = {side: self._skin(side, kept[side]) for side in SIDES}
        trees = _trees(skins)
        gone = np.zeros(3)  # by the right hand; the left one goes as far the other way
        for _ in range(_ROUNDS):
            way = self._apart(kept, skins, trees, gone)
            if way @ way < _ENOUGH**2:
                break
            gone = gone + 0.5 * way
        if not gone.any():
            return kept
        return {
            side: self._out_of_trunk(side, replace(kept[side], wrist=kept[side].wrist + share * gone))
            for side, share in (("R", 1.0), ("L", -1.0))
        }

    def depth(self, arms: Mapping[str, ArmPose]) -> float:
        """Tell how far a hand is in the body, or in the other arm, at most [m]."""
        skins = {side: self._skin(side, arms[side]) for side in SIDES}
        found = [self._inside(skins[side].places, self._trunk, self._tree) for side in SIDES]
        found.append(self._apart(arms, skins, _trees(skins), np.zeros(3)))
        return max(float(np.linalg.norm(move)) for move in found)

    def _out_of_trunk(self, side: str, pose: ArmPose) -> ArmPose:
        if side in self._known and self._known[side][0] is pose:  # a hand that hangs, or holds
            return self._known[side][1]
        places = self._skin(side, pose).places
        gone = np.zeros(3)
        for _ in range(_ROUNDS):
            move = self._inside(places + gone, self._trunk, self._tree)
            depth = float(np.linalg.norm(move))
            if depth < _ENOUGH:
                break
            # Keeping to the way that it went so far, a hand does not go to and fro between nose and chin.
            gone = gone + depth * (unit(unit(move) + unit(gone)) if gone.any() else unit(move))
        kept = replace(pose, wrist=pose.wrist + gone) if gone.any() else pose
        self._known[side] = (pose, kept)
        return kept

    def _apart(
        self,
        arms: Mapping[str, ArmPose],
        skins: Mapping[str, _Skin],
        trees: Mapping[str, cKDTree],
        gone: FloatArray,
    ) -> FloatArray:
        """Give the way that the right hand must go from the left one.

        Args:
            arms: Of both sides.
            skins: Of these arms.
            trees: Of these skins' places.
            gone: By the right hand since, by the left one the other way [m]. Shape (3,).
        """
        right, left = skins["R"], skins["L"]
        forth = self._inside(right.places + 2.0 * gone, left, trees["L"])
        back = self._inside(left.places - 2.0 * gone, right, trees["R"])
        depth = max(float(np.linalg.norm(forth)), float(np.linalg.norm(back)))
        if depth == 0.0:
            return np.zeros(3)
        # Deep in each other, hands' skins say little of the way out; their middles do.
        away = self._middle("R", arms["R"]) - self._middle("L", arms["L"]) + 2.0 * gone + _TO_THE_RIGHT
        way: FloatArray = depth * away / np.linalg.norm(away)
        return way

    def _middle(self, side: str, pose: ArmPose) -> FloatArray:
        """Give the middle of a hand, between wrist and middle knuckle, in the axes of the chest [m]."""
        hand = self._poser.hands[side]
        return pose.wrist + pose.hand @ (hand_point(hand, pose.shape, "palm") - hand.wrist)

    @staticmethod
    def _inside(points: FloatArray, skin: _Skin, tree: cKDTree) -> FloatArray:
        """Give the move that takes points out of a skin: as far as the deepest, the way most of them go."""
        points = points[::_EVERY]
        away, nearest = tree.query(points)
        normals = skin.normals[nearest]
        depths = -((points - skin.places[nearest]) * normals).sum(axis=1)
        depths = np.where((depths > 0.0) & ((away < _NEAR) | (depths > _ALONG * away)), depths, 0.0)
        way = depths @ normals
        length = float(np.linalg.norm(way))
        if length < 1e-9:
            return np.zeros(3)
        move: FloatArray = depths.max() * way / length
        return move

    def _limb(self, side: str, skin: NDArray[np.int64]) -> _Limb:
        rig = self._poser.rig
        bones = tuple(name for name in load_body_data().bones if name.endswith(f".{side}"))
        bones = tuple(name for name in bones if name.startswith(_HAND))
        columns = rig.weights[:, [rig.bone(name) for name in bones]]
        share = np.asarray(columns.sum(axis=1)).ravel()
        vertices = skin[share[skin] > 0.99]
        weights = csr_array(columns[vertices])
        return _Limb(vertices, weights, bones)

    def _skin(self, side: str, pose: ArmPose) -> _Skin:
        """Give the skin of forearm and hand in a pose, in the axes of the chest."""
        vertices, weights, bones = self._limbs[side]
        _, placed = self._poser.arm_bones(side, pose)
        transforms = np.array([placed[name][:3] for name in bones])
        blend = blended(weights, transforms)
        normals = np.einsum("nij,nj->ni", blend[:, :, :3], self._normals[vertices])
        return _Skin(skinned(blend, self._poser.rig.vertices[vertices]), normals)


def _trees(skins: Mapping[str, _Skin]) -> dict[str, cKDTree]:
    return {side: cKDTree(skin.places) for side, skin in skins.items()}
