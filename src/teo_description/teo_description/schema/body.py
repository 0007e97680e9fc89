# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What ``robot.yaml`` says of the body: its joints by limb, its places, and what must not touch."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from teo_description.schema.hand import HandAxes
from teo_description.schema.urdf import Finite, Positive, Solid, Vector

Turning = dict[Literal["yaw", "pitch", "roll"], str]
"""The joints that turn a part of the body, by the axis that they turn it about, from the trunk on."""

ArmJoints = Annotated[tuple[str, ...], msgspec.Meta(min_length=1)]
"""The joints of an arm from the shoulder on."""


class Groups(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The joints that a sign moves, by limb."""

    head: Turning
    trunk: Turning
    left_arm: ArmJoints
    right_arm: ArmJoints
    left_hand: HandAxes
    right_hand: HandAxes


class ArmLinks(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Links of the right arm from the shoulder on; those of the left one have the mirrored names."""

    shoulder: tuple[str, ...]
    upper_arm: tuple[str, ...]
    forearm: tuple[str, ...]
    hand: tuple[str, ...]
    """The first is on the forearm's side of the wrist and may touch it."""


class Collision(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Which parts must not touch."""

    torso: tuple[str, ...]
    """Links of trunk, head, pelvis and legs."""
    head: tuple[str, ...]
    """Those of `torso` that the head's joints move."""
    right_arm: ArmLinks
    allowed: tuple[tuple[str, str], ...] = ()
    """Pairs that touch at every pose because of how they are built."""
    shapes: dict[str, tuple[Solid, ...]] = {}
    """By link: what replaces the collision shapes of the URDF; on the other side their mirror images.

    Meshes are no shapes to keep a distance from: a link with nothing else has none.
    """


class PlaceOnBody(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A place of articulation, for the right hand, in ``base_link``."""

    point: Vector
    """[m]."""
    outward: Vector
    """Way out of the body there; any length."""
    body: bool = True
    """Whether it is on the body; else in the air."""


class Reach(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How far what moves can go; measured off the shapes and joints of the URDF where it is left out."""

    arm_boxes: dict[str, tuple[Vector, Vector]]
    """By joint of the right arm: opposite corners of a box, in its frame, that holds what it carries up to
    the next of these [m]; the left arm's are alike. The last holds the hand and all that fingers reach."""
    arm: Positive
    """From the shoulder to the farthest point of the hand [m]."""
    abductor: Positive
    """How far points go for each radian of the axis [m]."""
    thumb: Positive
    """The same, as all that follow."""
    finger: Positive
    head: Positive
    """For each radian of each joint of the head."""
    trunk: Positive


class CameraView(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A picture's view; see `pictures.camera.Camera`."""

    position: Vector
    target: Vector
    field_of_view_deg: Annotated[float, msgspec.Meta(gt=0.0, lt=180.0)]
    near: Positive = 0.05
    follows: str | None = None


class NaturalArm(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Bounds beyond which the right arm looks like no person's; in the order of the arm's joints."""

    lower_deg: tuple[Finite, ...]
    upper_deg: tuple[Finite, ...]


class SigningArms(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Postures of the right arm while it signs, in the order of its joints."""

    easy_deg: tuple[Finite, ...]
    """At ease: what a sign leaves open is drawn towards it."""
    spelling_deg: tuple[Finite, ...]
    """The same while it spells."""
    hanging_deg: tuple[Finite, ...]
    """The same for letters whose hand hangs, where the wrist does not bend so far."""
    starts_deg: tuple[tuple[Finite, ...], ...]
    """Where searches of an arm begin beside the first two."""


class Detour(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How arms are led round the body: the right arm's joints; the left one mirrors them."""

    sideways: dict[str, Finite]
    """Share by which each joint turns when the upper arm is lifted sideways [1]."""
    forward: dict[str, Finite]
    """... brought forward."""
    open: dict[str, Finite]
    """... when the elbow opens."""
    apart_deg: dict[str, Finite]
    """Both hands well before the shoulders, out of the way of everything."""


class Postures(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Postures with a name, of the joints named; others are at 0, or the limit nearest to it."""

    home_deg: dict[str, Finite] = {}
    """In which the robot is parked, arms hanging."""
    ready_deg: dict[str, Finite]
    """In which a signer waits: the right arm's joints; the left one mirrors them."""
