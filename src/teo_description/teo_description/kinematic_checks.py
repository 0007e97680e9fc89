# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Checks of ``robot.yaml`` by kinematics: axes, limits, and the likeness of left and right."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.completed_urdf import end_link, link_poses
from teo_description.hand_geometry import HandGeometry, HandPoints
from teo_description.humanoid import Humanoid
from teo_description.robot import Robot


class Finding(NamedTuple):
    """One thing that was looked at."""

    ok: bool
    what: str
    """What should be so."""
    measured: str
    """What is so, with units."""
    field: str
    """The field of ``robot.yaml`` to look at where it is not."""
    needed: bool = True
    """Whether a robot that fails here is not fit to sign; else it is only told."""

    @property
    def mark(self) -> str:
        """``ok``, ``note`` or ``FAIL``."""
        return "ok" if self.ok else "FAIL" if self.needed else "note"


# Random postures that left and right are compared in.
_POSTURES = 200

# So far the mirror image of a frame may be from the one of the other side [m]: signs are made for the right
# hand and mirrored, and a finger tip is as wide.
_MIRROR_TOLERANCE = 0.01

# So far limits of mirrored joints may differ [rad]: 1 deg, which nobody sees.
_LIMIT_TOLERANCE = math.radians(1.0)

# Speeds that a joint of a humanoid can have [rad/s]; the fastest actuators that are sold for one reach 40.
_SLOWEST, _FASTEST = 0.05, 50.0

# How far a follower may be told beyond its own limits [rad]: rounding of the file.
_FOLLOWER_TOLERANCE = 1e-3


def frame_checks(robot: Robot) -> Iterator[Finding]:
    """``base_link`` has x forward, y left and z up (REP-103)."""
    humanoid, file = robot.humanoid, robot.humanoid.file
    palms = [humanoid.mirrored_name(file.hand.palm), file.hand.palm]
    sides = robot.placements(robot.configurations(humanoid.ready), palms)[:, :3, 3]
    yield Finding(
        bool(sides[0, 1] > 0.0 > sides[1, 1]),
        "y of base_link points to the left: the left palm is at y > 0, the right one at y < 0",
        f"y {sides[0, 1]:.3f} and {sides[1, 1]:.3f} m in the ready posture",
        "mirror",
    )
    yield Finding(
        bool(sides[:, 0].min() > 0.0),
        "x points forward: both palms are before the body in the ready posture",
        f"x {sides[0, 0]:.3f} and {sides[1, 0]:.3f} m",
        "postures.ready_deg",
    )
    mouth = file.places.get("mouth")
    if mouth is not None:
        yield Finding(
            mouth.outward[0] > 0.0 and mouth.point[2] > sides[:, 2].max(),
            "the face looks along x and is above the hands of the ready posture",
            f"mouth at z {mouth.point[2]:.3f}, hands at {sides[:, 2].max():.3f} m",
            "places.mouth",
        )


def symmetry_checks(robot: Robot) -> Iterator[Finding]:
    """Mirrored positions of the joints give the mirror image."""
    worst, frame = _mirror_deviation(robot)
    near = worst <= _MIRROR_TOLERANCE
    yield Finding(
        near,
        f"left and right are mirror images within {_MIRROR_TOLERANCE * 1e3:.0f} mm",
        f"worst of {_POSTURES} random postures: {worst * 1e3:.2f} mm, {frame}"
        + (f"; mirror images are {', '.join(_mirrored_origins(robot.humanoid))}" if not near else ""),
        "origins",
    )
    humanoid = robot.humanoid
    names = humanoid.arm("right") + humanoid.hand("right")
    here = humanoid.limits(names)
    there = humanoid.limits([humanoid.mirrored_name(name) for name in names])
    signs = humanoid.mirror_signs(names)
    mirrored = np.sort(np.stack([there.lower * signs, there.upper * signs]), axis=0)
    off = np.abs(mirrored - [here.lower, here.upper]).max(axis=0)
    yield Finding(
        float(off.max()) <= _LIMIT_TOLERANCE,
        "arms and hands have the same limits on both sides",
        f"worst: {np.degrees(off.max()):.2f} deg, {names[int(off.argmax())]}",
        "limits",
        needed=False,  # a hand may reach farther than the other: signs are kept to what both can
    )


def _mirror_deviation(robot: Robot) -> tuple[float, str]:
    """Worst distance of a hand's frame from the mirror image of the other's [m], and its name."""
    humanoid = robot.humanoid
    frames, limits = humanoid.file.hand.frames, humanoid.limits()
    others = [humanoid.mirrored_name(frame) for frame in frames]
    columns = humanoid.columns(map(humanoid.mirrored_name, limits.names))
    signs = humanoid.mirror_signs(limits.names)
    dice = np.random.default_rng(1)
    worst = np.zeros(len(frames))
    for _ in range(_POSTURES):
        values = dice.uniform(limits.lower, limits.upper)
        image = np.empty_like(values)
        image[columns] = values * signs
        here = robot.placements(robot.configurations(values), frames)[:, :3, 3]
        there = robot.placements(robot.configurations(image), others)[:, :3, 3]
        worst = np.maximum(worst, np.linalg.norm(here * [1.0, -1.0, 1.0] - there, axis=1))
    return float(worst.max()), frames[int(worst.argmax())]


# An origin that differs from the mirror image by less is rounded [m], [rad].
_ROUNDED = 1e-3, math.radians(0.5)

# What a mirror image between left and right may do to the axes of a link, each makers' own choice.
_FLIPS = [np.diag([*signs, 1.0]) for signs in ((1, -1, 1), (-1, 1, 1), (1, 1, -1), (-1, -1, -1))]


def _mirrored_origins(humanoid: Humanoid) -> Iterator[str]:
    """Origins of left joints that are no mirror images of right ones, as they should be: for ``origins``."""
    tree = humanoid.urdf_tree()
    poses = {
        **dict.fromkeys((link.attrib["name"] for link in tree.findall("link")), np.eye(4)),
        **link_poses(tree),
    }

    def image(link: str) -> Array:
        """Of the link on the other side, in whichever axes are nearest to those that it has there."""
        there = poses[humanoid.mirrored_name(link)]
        images = [_FLIPS[0] @ poses[link] @ flip for flip in _FLIPS]
        nearest: Array = max(images, key=lambda pose: float((pose[:3, :3] * there[:3, :3]).sum()))
        return nearest

    for joint in tree.findall("joint"):
        name = joint.attrib["name"]
        left = humanoid.mirrored_name(name)
        parent, child = (end_link(joint, end) for end in ("parent", "child"))
        if (
            joint.attrib["type"] == "fixed"
            or left == name
            or not any(right in name for _, right in humanoid.file.mirror)
        ):
            continue
        wanted = np.linalg.inv(image(parent)) @ image(child)
        parent, child = map(humanoid.mirrored_name, (parent, child))
        off = np.linalg.inv(wanted) @ np.linalg.inv(poses[parent]) @ poses[child]
        turned = Rotation.from_matrix(off[:3, :3]).magnitude()
        if np.linalg.norm(off[:3, 3]) > _ROUNDED[0] or turned > _ROUNDED[1]:
            turns = Rotation.from_matrix(wanted[:3, :3]).as_euler("xyz", degrees=True)
            xyz = ", ".join(f"{x:.5f}" for x in wanted[:3, 3])
            yield f"{left}: {{xyz: [{xyz}], rpy_deg: [{', '.join(f'{x:.3f}' for x in turns)}]}}"


def limit_checks(robot: Robot) -> Iterator[Finding]:
    """Limits are there, make sense, and hold the postures and the followers."""
    humanoid = robot.humanoid
    limits = humanoid.limits()
    empty = [
        n for n, low, high in zip(limits.names, limits.lower, limits.upper, strict=True) if not low < high
    ]
    yield Finding(not empty, "every commanded joint can move", ", ".join(empty) or "all can", "limits")
    odd = [
        f"{name} {speed:g}"
        for name, speed in zip(limits.names, limits.velocity, strict=True)
        if not _SLOWEST <= speed <= _FASTEST
    ]
    measured = ", ".join(odd) or f"{limits.velocity.min():.2f} to {limits.velocity.max():.2f} rad/s"
    yield Finding(not odd, f"greatest speeds within {_SLOWEST} and {_FASTEST} rad/s", measured, "limits")
    for title, posture in (("home", humanoid.hanging), ("ready", humanoid.ready)):
        outside = [
            name
            for name, value, low, high in zip(limits.names, posture, limits.lower, limits.upper, strict=True)
            if not low - 1e-6 <= value <= high + 1e-6
        ]
        yield Finding(
            not outside,
            f"the {title} posture is within the limits",
            ", ".join(outside) or "it is",
            f"postures.{title}_deg",
        )
    beyond = list(_followers_beyond(humanoid))
    yield Finding(
        not beyond,
        "joints that follow others stay within limits of their own",
        "; ".join(beyond) or "they do",
        "limits",
    )


def _followers_beyond(humanoid: Humanoid) -> Iterator[str]:
    for joint in humanoid.urdf_tree().findall("joint"):
        mimic, limit = joint.find("mimic"), joint.find("limit")
        if mimic is None or limit is None or mimic.attrib["joint"] not in humanoid.commanded_joints:
            continue
        leader = humanoid.limits([mimic.attrib["joint"]])
        times, offset = float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
        ends = sorted(float(times * end + offset) for end in (leader.lower[0], leader.upper[0]))
        low, high = float(limit.get("lower", "-inf")), float(limit.get("upper", "inf"))
        if ends[0] < low - _FOLLOWER_TOLERANCE or ends[1] > high + _FOLLOWER_TOLERANCE:
            way = f"{ends[0]:.2f} .. {ends[1]:.2f} of {low:.2f} .. {high:.2f} rad"
            yield f"{joint.attrib['name']} is led to {way}"


def hand_checks(robot: Robot) -> Iterator[Finding]:
    """The palm's axes, and that every axis of a hand moves what its name says."""
    hand = HandGeometry(robot)
    low, high = hand.limits.lower, hand.limits.upper
    straight = hand.points(low)

    def turned(axis: str, share: float) -> HandPoints:
        """With one axis at this share of its range [1], and the others at their lower limits."""
        row = hand.joints.index(axis)
        positions = low.copy()
        positions[row] += share * (high[row] - low[row])
        return hand.points(positions)

    directions = straight.fingers[:, 3] - straight.fingers[:, 0]
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    yield Finding(
        bool((directions[:, 0] > 0.8).all()),
        "x of the palm runs along the straight fingers (cosine over 0.8)",
        ", ".join(f"{name} {value:.2f}" for name, value in zip(hand.fingers, directions[:, 0], strict=True)),
        "hand.palm",
    )
    across = straight.fingers[:, 0, 1]
    yield Finding(
        bool((np.diff(across) > 0.0).all()),
        "y of the palm points to the little finger's side",
        ", ".join(f"{name} {value * 1e3:.0f} mm" for name, value in zip(hand.fingers, across, strict=True)),
        "hand.palm",
    )
    for row, (axis, finger) in enumerate(zip(hand.joints[-len(hand.fingers) :], hand.fingers, strict=True)):
        moved = turned(axis, 0.5).fingers[row, 3] - straight.fingers[row, 3]
        yield Finding(
            bool(moved[2] > 0.005),
            f"{axis} bends the {finger} finger towards the palm's side",
            f"its tip moves {moved[2] * 1e3:.0f} mm out of the palm at half way",
            f"groups.right_hand.{finger}",
        )
    for thumb_axis, name in zip(robot.humanoid.hand_axes("right")[:2], ("abductor", "thumb"), strict=True):
        if thumb_axis is not None:
            way = float(np.linalg.norm(turned(thumb_axis, 1.0).thumb[-1] - straight.thumb[-1]))
            yield Finding(
                way > 0.01,
                f"{thumb_axis} moves the thumb",
                f"its tip is {way * 1e3:.0f} mm away at the other end",
                f"groups.right_hand.{name}",
            )
