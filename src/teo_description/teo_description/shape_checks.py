# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Checks of the shapes in ``robot.yaml`` against what is seen of the robot: meshes, boxes, rods and balls."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import pinocchio as pin
from scipy.spatial import ConvexHull, KDTree

from teo_common.arrays import Array
from teo_description.clearance import watched_pairs
from teo_description.humanoid import SIDES, Humanoid
from teo_description.kinematic_checks import Finding
from teo_description.pictures.visual_parts import Mesh, Part, visual_parts
from teo_description.robot import Robot
from teo_description.urdf_links import box_about

# So far a part may stand out of all shapes [m]: a hand is as thick. GR1T2's trunk, whose shapes are measured
# on its meshes, stands out by 28 mm.
_PART_OUTSIDE = 0.03

# So far the middle of a side of a shape may be from all that is seen [m]: more keeps hands from places that
# they could come to. GR1T2's thigh, a rod round a cone, is 52 mm off, TEO's hips 64.
_SHAPE_OUTSIDE = 0.07

# Points spread over a link's surface: 5 mm apart on a hand's link, 2 cm on a trunk.
_POINTS = 3000


def shape_checks(robot: Robot) -> Iterator[Finding]:
    """What an arm can come to has a shape about it, and no shape is much wider than what it stands for."""
    missing = _missing_meshes(robot.humanoid)
    if missing:
        meshes = robot.humanoid.file.meshes
        how = "" if meshes is None else f": {meshes.install}"
        yield Finding(
            False,
            "shapes are compared with meshes",
            f"those of {len(missing)} links are not on this machine{how}",
            "meshes",
            needed=False,
        )
    seen = _surfaces(robot, missing)
    shapes = _Shapes(robot)
    yield _places_on_shapes(robot.humanoid, shapes)
    outside = dict(_parts_outside(robot, seen, shapes))
    boxes = {link: _box(robot, link, seen[link]) for link in outside}
    yield Finding(
        not outside,
        f"what an arm can come to is within {_PART_OUTSIDE * 1e3:.0f} mm of the shapes that are watched",
        "; ".join(
            f"{link} is {far * 1e3:.0f} mm outside: {boxes[link]} holds it" for link, far in outside.items()
        )
        or "all is",
        "collision",
    )
    wide = dict(_shapes_outside(robot, seen, missing, shapes))
    yield Finding(
        not wide,
        f"every side of a shape is within {_SHAPE_OUTSIDE * 1e3:.0f} mm of what is seen",
        ", ".join(f"{link} {far * 1e3:.0f} mm" for link, far in wide.items()) or "all are",
        "collision.shapes",
    )


# So far a place of the body may be from the shapes, in or out [m]: TEO's shoulder is 28 mm before them.
_PLACE_OFF = 0.03


def _places_on_shapes(humanoid: Humanoid, shapes: _Shapes) -> Finding:
    places = {name: place.point for name, place in humanoid.file.places.items() if place.body}
    away = dict(zip(places, shapes.distances(np.array(list(places.values()))).tolist(), strict=True))
    off = [
        f"{name} {abs(far) * 1e3:.0f} mm {'in' if far < 0.0 else 'before'} them"
        for name, far in away.items()
        if abs(far) > _PLACE_OFF
    ]
    return Finding(
        not off,
        f"places of the body are on the shapes within {_PLACE_OFF * 1e3:.0f} mm",
        ", ".join(off) or "all are",
        "places",
        needed=False,  # a sign whose place is off is made beside it
    )


def _missing_meshes(humanoid: Humanoid) -> set[str]:
    """Links with a mesh that is not on this machine."""
    return {
        link.attrib["name"]
        for link in humanoid.urdf_tree().findall("link")
        for mesh in link.iterfind("visual/geometry/mesh")
        if humanoid.mesh_path(mesh.attrib["filename"]) is None
    }


def _surfaces(robot: Robot, but: set[str]) -> dict[str, Array]:
    """Points spread over what is seen of each link, at home, in ``base_link`` [m]. Shapes (n, 3)."""
    pin.forwardKinematics(robot.model, robot.data, robot.configuration({}))
    parts: dict[str, list[Part]] = defaultdict(list)
    for part in visual_parts(robot):
        if part.link not in but:
            parts[part.link].append(part)
    dice = np.random.default_rng(5)
    found = {}
    for link, seen in parts.items():
        pose = robot.data.oMi[seen[0].joint]
        points = np.vstack([_spread(part.mesh, dice) for part in seen])
        found[link] = points @ pose.rotation.T + pose.translation
    return found


def _spread(mesh: Mesh, dice: np.random.Generator) -> Array:
    """Its corners, and points spread evenly over its surface [m]. Shape (n, 3)."""
    corners = mesh.vertices[mesh.triangles]
    sides = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    chosen = dice.choice(len(areas), _POINTS, p=areas / areas.sum())
    shares = dice.random((_POINTS, 2))
    beyond = shares.sum(axis=1) > 1.0
    shares[beyond] = 1.0 - shares[beyond]
    inside = corners[chosen, 0] + np.einsum("nk,nki->ni", shares, sides[chosen])
    return np.vstack([mesh.vertices, inside])


class _Shapes:
    """The shapes of the links that are watched, at home."""

    def __init__(self, robot: Robot) -> None:
        watched = {link for pair in watched_pairs(robot.humanoid) for link in pair}
        geometry = pin.buildGeomFromUrdfString(
            robot.model, robot.humanoid.urdf_text(), pin.GeometryType.COLLISION
        )
        named = [(robot.model.frames[item.parentFrame].name, item) for item in geometry.geometryObjects]
        self._all = [
            (link, item.geometry, robot.data.oMi[item.parentJoint] * item.placement)
            for link, item in named
            if link in watched
        ]

    def distances(self, points: Array) -> Array:
        """From the nearest shape [m]; negative inside of one. Shapes (n, 3) and (n,)."""
        each = [
            _distances(shape, (points - pose.translation) @ pose.rotation) for _, shape, pose in self._all
        ]
        nearest: Array = np.min(each, axis=0)
        return nearest

    def sides(self) -> Iterator[tuple[str, Array]]:
        """Link and the middles of the six sides of each shape [m]. Shape (6, 3)."""
        for link, shape, pose in self._all:
            middles = np.vstack([np.eye(3), -np.eye(3)]) * _half_sizes(shape)
            yield link, middles @ pose.rotation.T + pose.translation


def _half_sizes(shape: Any) -> Array:
    if hasattr(shape, "halfSide"):
        return np.asarray(shape.halfSide)
    if hasattr(shape, "halfLength"):
        return np.array([shape.radius, shape.radius, shape.halfLength])
    return np.full(3, shape.radius)


def _distances(shape: Any, points: Array) -> Array:
    """Of points in a shape's axes from it; negative inside [m]."""
    if hasattr(shape, "halfSide"):
        beyond = np.abs(points) - shape.halfSide
    elif hasattr(shape, "halfLength"):
        beyond = np.column_stack(
            [
                np.linalg.norm(points[:, :2], axis=1) - shape.radius,
                np.abs(points[:, 2]) - shape.halfLength,
            ]
        )
    else:
        beyond = np.linalg.norm(points, axis=1)[:, None] - shape.radius
    found: Array = np.linalg.norm(np.maximum(beyond, 0.0), axis=1) + np.minimum(beyond.max(axis=1), 0.0)
    return found


def _parts_outside(robot: Robot, seen: Mapping[str, Array], shapes: _Shapes) -> Iterator[tuple[str, float]]:
    """Links that stand out of all shapes where an arm can come, and by how much [m]."""
    shoulders, reach = _reach(robot)
    far = {}
    for link, points in seen.items():
        away = np.min([np.linalg.norm(points - shoulder, axis=1) for shoulder in shoulders], axis=0)
        within = points[away < reach]
        if len(within):
            far[link] = float(shapes.distances(within).max())
    yield from _of_one_side(robot.humanoid, far, _PART_OUTSIDE)


def _shapes_outside(
    robot: Robot, seen: Mapping[str, Array], missing: set[str], shapes: _Shapes
) -> Iterator[tuple[str, float]]:
    """Links with a shape whose side is off what it and its neighbours show, and by how much [m]."""
    joints = {link: robot.moving_joint(link) for link in seen}
    unseen = {robot.moving_joint(link) for link in missing}
    # Joggled: a part may be flat.
    hulls = {link: ConvexHull(points, qhull_options="QJ").equations for link, points in seen.items()}
    far: dict[str, float] = {}
    for link, middles in shapes.sides():
        about = _neighbours(robot, robot.moving_joint(link))
        near = [other for other in seen if joints[other] in about]
        if not near or about & unseen:
            continue
        away, _ = KDTree(np.vstack([seen[other] for other in near])).query(middles)
        inside = [(middles @ hulls[other][:, :3].T + hulls[other][:, 3]).max(axis=1) < 0.0 for other in near]
        far[link] = max(far.get(link, 0.0), float(np.where(np.any(inside, axis=0), 0.0, away).max()))
    yield from _of_one_side(robot.humanoid, far, _SHAPE_OUTSIDE)


def _neighbours(robot: Robot, joint: str) -> set[str]:
    """A joint, the one that carries it, and those that it carries next."""
    names, parents = robot.model.names, robot.model.parents
    index = robot.model.getJointId(joint)
    after = {names[other] for other in range(1, len(names)) if parents[other] == index}
    return {joint, names[parents[index]], *after}


def _of_one_side(humanoid: Humanoid, far: Mapping[str, float], most: float) -> Iterable[tuple[str, float]]:
    """Links that are farther off than the most [m]: right ones alone, of which the left are mirror images."""
    for link, away in far.items():
        left = any(name in link for name, _ in humanoid.file.mirror)
        if away > most and not (left and far.get(humanoid.mirrored_name(link), 0.0) > most):
            yield link, away


def _reach(robot: Robot) -> tuple[list[Array], float]:
    """Where both arms begin [m], and how far a finger's tip comes from there at most [m]."""
    humanoid, q = robot.humanoid, robot.configuration({})
    tip = robot.placement(q, next(iter(humanoid.file.hand.fingers.values()))[3])[:3, 3]
    chain = np.vstack([robot.joint_placements(q, humanoid.arm("right"))[:, :3, 3], tip])
    shoulders = [robot.joint_placements(q, humanoid.arm(side)[:1])[0, :3, 3] for side in SIDES]
    return shoulders, float(np.linalg.norm(np.diff(chain, axis=0), axis=1).sum())


def _box(robot: Robot, link: str, points: Array) -> str:
    """The box that holds a link, as it is written under ``collision.shapes``."""
    pose = robot.placement(robot.configuration({}), link)
    own = (points - pose[:3, 3]) @ pose[:3, :3]
    return box_about(own)
