# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""``robot.yaml``: what a humanoid is to this project, as it is written. Angles are in degrees there."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import msgspec

from teo_common.checked_content import YamlError, read_checked_yaml
from teo_description.errors import DescriptionError
from teo_description.robot_schema import (
    CameraView,
    Collision,
    Controllers,
    Detour,
    Follow,
    Frame,
    Groups,
    Hand,
    HandDrives,
    Limit,
    MeshSource,
    NaturalArm,
    Origin,
    PlaceOnBody,
    Postures,
    Reach,
    SigningArms,
    UrdfSource,
)

# Places that scores name; where a robot has none, the nearest on its body or in its air.
PLACES = (
    *("head_top", "forehead", "temple", "eye", "nose", "ear"),
    *("cheek", "mouth", "mouth_corner", "chin", "throat"),
    *("shoulder", "other_shoulder", "upper_chest", "chest", "other_chest", "belly"),
    *("space", "low_space", "middle_space", "shoulder_space", "high_space", "face_space", "beside_head"),
    "spelling",
)

# Views that pictures are taken from: the upper body, the hand, both of a sign, and all of the robot.
CAMERAS = ("front", "hand", "sign", "sign_hand", "full")


class RobotFile(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A humanoid."""

    schema: Literal[1]
    title: str
    """What people call it."""
    source: str
    """Whence the figures are, and under what terms."""
    urdf: UrdfSource
    meshes: MeshSource | None = None
    mirror: Annotated[tuple[tuple[str, str], ...], msgspec.Meta(min_length=1)]
    """What stands in the name of a left joint, link or frame, and what in the right one's."""
    groups: Groups
    standing: tuple[str, ...] = ()
    """Joints that are in the state and never commanded, such as those of the legs."""
    limits: dict[str, Limit] = {}
    follows: dict[str, Follow] = {}
    origins: dict[str, Origin] = {}
    frames: dict[str, Frame] = {}
    hand: Hand
    hand_drives: HandDrives | None = None
    natural_arm: NaturalArm
    signing_arms: SigningArms | None = None
    """Without it an arm at ease is that of `Postures.ready_deg`, and searches begin all over its bounds."""
    postures: Postures
    detour: Detour
    controllers: Controllers | None = None
    reach: Reach | None = None
    places: dict[str, PlaceOnBody]
    collision: Collision
    cameras: dict[str, CameraView]

    def __post_init__(self) -> None:
        """Refuse a file that lacks a place or a view."""
        for field, names in (("places", PLACES), ("cameras", CAMERAS)):
            missing = [name for name in names if name not in getattr(self, field)]
            if missing:
                raise ValueError(f"{field}: expected {', '.join(missing)} too")


def read_robot_file(path: Path) -> RobotFile:
    """Read and check a ``robot.yaml``.

    Raises:
        DescriptionError: ``bad_robot``, naming the file and the field.
    """
    try:
        return read_checked_yaml(path, RobotFile)
    except YamlError as error:
        raise DescriptionError("bad_robot", str(error)) from error
