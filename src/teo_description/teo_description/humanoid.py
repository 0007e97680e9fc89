# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A humanoid as data: names, groups, limits, postures and places, read from its ``robot.yaml`` and URDF.

``robots/<name>/`` of this package and ``$XDG_DATA_HOME/teo/robots/<name>/`` hold one each; one's own come
first. Nothing outside such a folder knows a joint by its name.
"""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Literal

import numpy as np

from teo_common.arrays import Array
from teo_common.installed_packages import installed_path, package_path
from teo_description.completed_urdf import (
    Urdf,
    completed_urdf,
    joint_directions,
    mirrored_name,
    urdf_hash,
    with_speeds,
)
from teo_description.errors import DescriptionError
from teo_description.robot_file import RobotFile, read_robot_file
from teo_description.robot_schema import AXES, HandDriveSpeeds

Side = Literal["left", "right"]
SIDES: tuple[Side, Side] = ("left", "right")

DEFAULT_ROBOT = "teo"


@dataclass(frozen=True, kw_only=True, eq=False)
class JointLimits:
    """Limits of some joints, in the order of `names`; the arrays are read-only.

    Attributes:
        names: Joint names.
        lower, upper: Position limits [rad]. Shape (n,).
        velocity: Greatest speed [rad/s]. Shape (n,).
    """

    names: tuple[str, ...]
    lower: Array
    upper: Array
    velocity: Array


class Humanoid:
    """A robot that can sign.

    Attributes:
        name: Of its folder, for example ``teo``.
        file: What ``robot.yaml`` says.
        head, trunk: Joints that turn them.
        body_joints: Head, trunk, left arm, right arm.
        commanded_joints: All that a sign can move, in every trajectory's order: body, left hand, right hand.
        standing: Joints that are in the state and stand still.
        all_joints: The joints of the joint state: commanded, then standing.
    """

    def __init__(self, folder: Path) -> None:
        """Read a folder with ``robot.yaml``.

        Raises:
            DescriptionError: ``bad_robot``, or ``robot_package_missing``.
        """
        self.name = folder.name
        self._path = folder / "robot.yaml"
        self.file: RobotFile = read_robot_file(self._path)
        groups = self.file.groups
        self.head: tuple[str, ...] = tuple(groups.head.values())
        self.trunk: tuple[str, ...] = tuple(groups.trunk.values())
        self._arms: dict[Side, tuple[str, ...]] = {"left": groups.left_arm, "right": groups.right_arm}
        self._axes: dict[Side, tuple[str | None, ...]] = {
            side: tuple(getattr(getattr(groups, f"{side}_hand"), axis) for axis in AXES) for side in SIDES
        }
        self._hands = {side: tuple(name for name in self._axes[side] if name) for side in SIDES}
        self.standing = self.file.standing
        self.body_joints = self.head + self.trunk + groups.left_arm + groups.right_arm
        self.commanded_joints = self.body_joints + self._hands["left"] + self._hands["right"]
        self.all_joints = self.commanded_joints + self.standing
        self._check_groups()

    def arm(self, side: Side) -> tuple[str, ...]:
        """Joints of an arm from the shoulder on."""
        return self._arms[side]

    def hand(self, side: Side) -> tuple[str, ...]:
        """Commanded axes that a hand has, of abductor, thumb, index, middle, ring and little finger."""
        return self._hands[side]

    def hand_axes(self, side: Side) -> tuple[str | None, ...]:
        """The same six with None for what the hand lacks."""
        return self._axes[side]

    @property
    def elbows(self) -> tuple[str, ...]:
        """Joints of both arms that open the elbows."""
        right = tuple(self.file.detour.open)
        return (*right, *map(self.mirrored_name, right))

    @property
    def limbs(self) -> Mapping[str, tuple[str, ...]]:
        """Commanded joints by limb, in the order of `commanded_joints`."""
        return {
            "head": self.head,
            "trunk": self.trunk,
            "left_arm": self._arms["left"],
            "right_arm": self._arms["right"],
            "left_hand": self._hands["left"],
            "right_hand": self._hands["right"],
        }

    @cached_property
    def limb_columns(self) -> Mapping[str, list[int]]:
        """Rows of the joints of each of the `limbs` among `commanded_joints`; limbs without joints aside."""
        return MappingProxyType({limb: self.columns(joints) for limb, joints in self.limbs.items() if joints})

    def head_axis(self, turning: Literal["yaw", "pitch", "roll"]) -> tuple[str, float] | None:
        """The joint that turns the head about an axis, and its sign; None where none does.

        Returns:
            Its name, and 1.0 where it counts as the body's axes do (yaw: to the left, pitch: forward, roll:
            to the right side; REP-103), else -1.0.
        """
        name = self.file.groups.head.get(turning)
        if name is None:
            return None
        along = float(self._directions[name][("roll", "pitch", "yaw").index(turning)])
        return name, 1.0 if along > 0.0 else -1.0

    def columns(self, joints: Iterable[str]) -> list[int]:
        """Rows of joints among `commanded_joints`."""
        return [self._column[name] for name in joints]

    @cached_property
    def _column(self) -> dict[str, int]:
        return {name: index for index, name in enumerate(self.commanded_joints)}

    @cached_property
    def home(self) -> Mapping[str, float]:
        """The pose in which the robot is parked, of `all_joints` [rad]."""
        lower, upper = self.limits(self.all_joints).lower, self.limits(self.all_joints).upper
        given = self.file.postures.home_deg
        within = {
            name: min(max(0.0, low), high)
            for name, low, high in zip(self.all_joints, lower.tolist(), upper.tolist(), strict=True)
        }
        return MappingProxyType(within | {name: math.radians(angle) for name, angle in given.items()})

    @cached_property
    def hanging(self) -> Array:
        """`home` of the `commanded_joints` [rad]."""
        positions = np.array([self.home[name] for name in self.commanded_joints])
        positions.setflags(write=False)
        return positions

    @cached_property
    def ready(self) -> Array:
        """The posture in which a signer waits, of the `commanded_joints` [rad]."""
        positions = self.with_both_arms(self.hanging, self.file.postures.ready_deg)
        positions.setflags(write=False)
        return positions

    def with_both_arms(self, positions: Array, right_deg: Mapping[str, float]) -> Array:
        """Positions of the `commanded_joints` with some joints of the right arm, and the left ones mirrored.

        Args:
            positions: [rad]. Shape (commanded joints,).
            right_deg: Angles of joints of the right arm [deg].
        """
        changed = positions.copy()
        for name, degrees in right_deg.items():
            angle = math.radians(degrees)
            changed[self._column[name]] = angle
            changed[self._column[self.mirrored_name(name)]] = angle * self.mirror_signs((name,))[0]
        return changed

    def check_joint_names(self, names: Iterable[str], where: str = "") -> None:
        """Refuse names that are not among `all_joints`.

        Args:
            names: The names.
            where: What the message begins with: their source, a colon and a blank.

        Raises:
            DescriptionError: ``unknown_joint``.
        """
        unknown = [name for name in names if name not in self.all_joints]
        if unknown:
            expected, got = ", ".join(self.all_joints), ", ".join(map(repr, unknown))
            others = [name for name in available_robots() if name != self.name and _has(name, unknown)]
            hint = f"; {' and '.join(others)} has them: `--robot {others[0]}`" if others else ""
            message = f"{where}expected joints of {self.name} among {expected}; got {got}{hint}"
            raise DescriptionError("unknown_joint", message)

    def mirrored_name(self, name: str) -> str:
        """The same joint, link or frame of the other side; a name without a side comes back unchanged."""
        return mirrored_name(name, self.file.mirror)

    def mirror_signs(self, joints: Sequence[str]) -> Array:
        """By what positions of the mirrored joints differ in the mirror image of a posture: 1 or -1 each.

        A mirror image about the plane between left and right turns an axis of rotation (x, y, z) into
        (-x, y, -z); the sign says whether the mirrored joint turns about that or its opposite.

        Raises:
            DescriptionError: ``unknown_joint``.
        """
        self.check_joint_names(joints)
        return np.array([self._mirror_sign(name) for name in joints])

    def _mirror_sign(self, name: str) -> float:
        mirrored = self._directions[name] * [-1.0, 1.0, -1.0]
        return 1.0 if float(mirrored @ self._directions[self.mirrored_name(name)]) > 0.0 else -1.0

    @cached_property
    def _directions(self) -> Mapping[str, Array]:
        """The way that every joint's axis points with all joints at zero, in ``base_link``."""
        return joint_directions(self.urdf_tree())

    @property
    def hand_drives(self) -> tuple[str, ...]:
        """Drives that the hands come with; none where the URDF's speeds are all that is known."""
        drives = self.file.hand_drives
        return () if drives is None else tuple(drives.drives)

    @property
    def default_hand_drive(self) -> str:
        """The drive that is meant when none is named; empty where there is no choice."""
        drives = self.file.hand_drives
        return "" if drives is None else drives.default

    def urdf_text(self, hand_drive: str = "") -> str:
        """The URDF, completed by ``robot.yaml``.

        Args:
            hand_drive: One of `hand_drives`; empty: the default.

        Raises:
            DescriptionError: ``unknown_hand_drive``, ``bad_robot``, ``urdf_missing`` or
                ``robot_package_missing``.
        """
        return self._urdf(hand_drive or self.default_hand_drive).text

    def urdf_tree(self, hand_drive: str = "") -> ET.Element:
        """The same, parsed. It is not to be changed: everybody's is the same."""
        return self._urdf(hand_drive or self.default_hand_drive).tree

    @cache  # noqa: B019  a humanoid lives as long as the process
    def _urdf(self, hand_drive: str) -> Urdf:
        if hand_drive != self.default_hand_drive:
            return with_speeds(self.urdf_text(), self._hand_speeds(hand_drive))
        return completed_urdf(self.urdf_path().read_text(encoding="utf-8"), self.file, str(self._path))

    def quickness(self, hand_drive: str = "") -> Array:
        """Greatest acceleration and jerk of the `commanded_joints` over those of the body's joints [1].

        Args:
            hand_drive: One of `hand_drives`; empty: the default.

        Raises:
            DescriptionError: ``unknown_hand_drive``.
        """
        quickness = np.ones(len(self.commanded_joints))
        if drive := hand_drive or self.default_hand_drive:
            hands = self.columns((*self._hands["left"], *self._hands["right"]))
            quickness[hands] = self._drive(drive).quickness
        return quickness

    def _drive(self, name: str) -> HandDriveSpeeds:
        drives = self.file.hand_drives
        if drives is None or name not in drives.drives:
            expected = f"one of {', '.join(self.hand_drives)}" if self.hand_drives else "none"
            message = f"hand_drive: expected {expected} for {self.name}, got {name!r}"
            raise DescriptionError("unknown_hand_drive", message)
        return drives.drives[name]

    def _hand_speeds(self, drive: str) -> Mapping[str, float]:
        speeds = self._drive(drive)
        of_axis = (speeds.abductor_deg, speeds.thumb_deg, *(speeds.finger_deg,) * 4)
        return {
            name: math.radians(speed)
            for side in SIDES
            for name, speed in zip(self._axes[side], of_axis, strict=True)
            if name
        }

    def urdf_path(self) -> Path:
        """Where the URDF is as its makers wrote it.

        Raises:
            DescriptionError: ``urdf_missing``, ``robot_package_missing``.
        """
        source = self.file.urdf
        path = self._path.parent / source.file
        if source.package is not None:
            located = installed_path(source.package, source.file)
            if located is None:
                how = source.install or f"python -m pip install {source.package}"
                message = f"{self._path}: urdf: expected the Python package {source.package}: {how}"
                raise DescriptionError("robot_package_missing", message)
            path = located
        if not path.is_file():
            raise DescriptionError("urdf_missing", f"{self._path}: urdf: expected a file {path}")
        return path

    def mesh_path(self, name: str) -> Path | None:
        """Where a mesh file of the URDF is, or None where it is not on this machine.

        Args:
            name: As the URDF has it: a path from its own folder, or ``package://`` and one from any above it.
        """
        meshes = self.file.meshes
        folder = self.urdf_path().parent if meshes is None else installed_path(meshes.package, meshes.folder)
        return None if folder is None else find_mesh(folder, name)

    @cached_property
    def description_hash(self) -> str:
        """Names the robot of a sign; see `urdf_hash`."""
        return urdf_hash(self.urdf_text())

    def limits(self, joints: Sequence[str] | None = None, *, hand_drive: str = "") -> JointLimits:
        """Limits of joints.

        Args:
            joints: Joints among `all_joints`, in the order wanted; None: the `commanded_joints`.
            hand_drive: One of `hand_drives`; empty: the default.

        Raises:
            DescriptionError: ``unknown_joint``, ``unknown_hand_drive``.
        """
        names = self.commanded_joints if joints is None else tuple(joints)
        self.check_joint_names(names)
        table = self._limit_table(hand_drive)
        values = np.array([table[name][:3] for name in names], dtype=np.float64).reshape(-1, 3)
        values.setflags(write=False)
        return JointLimits(names=names, lower=values[:, 0], upper=values[:, 1], velocity=values[:, 2])

    def effort_limits(self, joints: Sequence[str]) -> Array:
        """Greatest torques of joints [N m]. Shape (n,).

        Raises:
            DescriptionError: ``unknown_joint``.
        """
        self.check_joint_names(joints)
        table = self._limit_table("")
        return np.array([table[name][3] for name in joints])

    @cache  # noqa: B019  a humanoid lives as long as the process
    def _limit_table(self, hand_drive: str) -> Mapping[str, tuple[float, ...]]:
        limits = {}
        for joint in self.urdf_tree(hand_drive).findall("joint"):
            limit = joint.find("limit")
            if limit is not None and joint.find("mimic") is None:
                keys = ("lower", "upper", "velocity", "effort")
                limits[joint.attrib["name"]] = tuple(float(limit.attrib[key]) for key in keys)
        missing = [name for name in self.all_joints if name not in limits]
        if missing:
            raise self._bad(f"groups: expected joints with limits in the URDF; {', '.join(missing)}: none")
        return limits

    def _check_groups(self) -> None:
        twice = sorted({name for name in self.all_joints if self.all_joints.count(name) > 1})
        if twice:
            raise self._bad(f"groups: expected every joint once, got {', '.join(twice)} twice")
        for what, (left, right) in {"arm": self._arms.values(), "hand": self._hands.values()}.items():
            mirrored = tuple(self.mirrored_name(name) for name in left)
            if mirrored != right:
                raise self._bad(
                    f"groups.right_{what}: expected the mirror image of left_{what}, "
                    f"{', '.join(mirrored)}; got {', '.join(right)}"
                )
        fingers = tuple(finger for finger, axis in zip(AXES, self._axes["right"], strict=True) if axis)[2:]
        if tuple(self.file.hand.fingers) != fingers:
            raise self._bad(
                f"hand.fingers: expected those of groups.right_hand, {', '.join(fingers)}; "
                f"got {', '.join(self.file.hand.fingers)}"
            )
        arm, signing, count = self.file.natural_arm, self.file.signing_arms, len(self._arms["right"])
        arms = {"natural_arm": [arm.lower_deg, arm.upper_deg]}
        if signing is not None:
            ways = signing.easy_deg, signing.spelling_deg, signing.hanging_deg
            arms["signing_arms"] = [*ways, *signing.starts_deg]
        for field, postures in arms.items():
            if any(len(posture) != count for posture in postures):
                raise self._bad(f"{field}: expected an angle for each of the arm's {count} joints")

    def _bad(self, message: str) -> DescriptionError:
        return DescriptionError("bad_robot", f"{self._path}: {message}")


def find_mesh(folder: Path, name: str) -> Path | None:
    """Where a mesh file is, or None.

    Args:
        folder: Of the URDF.
        name: As `Humanoid.mesh_path` has it.
    """
    if not name.startswith("package://"):
        return path if (path := folder / name).is_file() else None
    below = name.removeprefix("package://")
    return next((path for above in folder.parents if (path := above / below).is_file()), None)


def robot_folders() -> tuple[Path, ...]:
    """Where robots are looked for, one's own first."""
    base = os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share"
    return Path(base) / "teo" / "robots", _own_folder()


@cache
def _own_folder() -> Path:
    """Looked for once: every entry of a table asks for its robot."""
    return package_path("teo_description", "robots")


def available_robots() -> tuple[str, ...]:
    """Names of the robots that there are, sorted."""
    folders = (folder for folder in robot_folders() if folder.is_dir())
    return tuple(sorted({path.parent.name for folder in folders for path in folder.glob("*/robot.yaml")}))


def load_humanoid(name: str = DEFAULT_ROBOT) -> Humanoid:
    """The humanoid of a name, read once.

    Raises:
        DescriptionError: ``unknown_robot``, ``bad_robot``, ``robot_package_missing``, ``urdf_missing``.
    """
    for folder in robot_folders():
        if (folder / name / "robot.yaml").is_file():
            return _humanoid(folder / name)
    expected = ", ".join(available_robots())
    raise DescriptionError("unknown_robot", f"expected a robot among {expected}; got {name!r}")


def _has(robot: str, joints: Iterable[str]) -> bool:
    """Whether a robot has all of some joints, as far as it can be read here."""
    try:
        return set(joints) <= set(load_humanoid(robot).all_joints)
    except DescriptionError:
        return False


@cache
def _humanoid(folder: Path) -> Humanoid:
    return Humanoid(folder)
