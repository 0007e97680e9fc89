# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The fields of ``robot.yaml``: URDF, hands, body and controllers of a humanoid. Angles are in degrees."""

from __future__ import annotations

import sys
from typing import Annotated, Literal

import msgspec

# NaN is within no bounds, and infinity beyond the greatest number.
_MOST = sys.float_info.max

Finite = Annotated[float, msgspec.Meta(ge=-_MOST, le=_MOST)]
Positive = Annotated[float, msgspec.Meta(gt=0.0, le=_MOST)]
Vector = tuple[Finite, Finite, Finite]


class UrdfSource(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where the URDF is: a file beside ``robot.yaml``, or one in an installed Python package."""

    file: str
    """Path below the folder of ``robot.yaml``, or below the one that packages are installed in."""
    package: str | None = None
    """Name of the Python package that it comes with, as ``pip`` knows it."""
    install: str | None = None
    """The command that installs the package."""


class MeshSource(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where a URDF beside ``robot.yaml`` finds its meshes: pictures are drawn of shapes without them."""

    folder: str
    """What the names of mesh files begin from, below the folder that packages are installed in."""
    package: str
    install: str


class Limit(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What replaces or completes the limits of the URDF for a joint."""

    lower_deg: Finite | None = None
    upper_deg: Finite | None = None
    velocity_deg: Positive | None = None
    effort: Positive | None = None
    """[N m]."""


class Follow(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A joint that is not commanded: it goes with another, at ``multiplier * other + offset``."""

    joint: str
    multiplier: Finite = 1.0
    offset_deg: Finite = 0.0


class Origin(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What replaces the place of a joint in its parent link, where the URDF's is wrong."""

    xyz: Vector
    """[m]."""
    rpy_deg: Vector = (0.0, 0.0, 0.0)


class Frame(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A frame that the URDF lacks, fixed to a link.

    That of the other side comes by itself where it is not given: as the mirror image with all joints at zero.
    """

    link: str
    xyz: Vector = (0.0, 0.0, 0.0)
    """[m]."""
    rpy_deg: Vector = (0.0, 0.0, 0.0)


class Solid(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A collision shape of a link: a box by its edges, a cylinder along z by radius and length, a sphere."""

    xyz: Vector = (0.0, 0.0, 0.0)
    """Its middle in the link's frame [m]."""
    rpy_deg: Vector = (0.0, 0.0, 0.0)
    box: tuple[Positive, Positive, Positive] | None = None
    """[m]."""
    cylinder: tuple[Positive, Positive] | None = None
    """[m]."""
    sphere: Positive | None = None
    """[m]."""

    def __post_init__(self) -> None:
        """Refuse no shape, and more than one."""
        shapes = ("box", "cylinder", "sphere")
        given = [shape for shape in shapes if getattr(self, shape) is not None]
        if len(given) != 1:
            raise ValueError(f"expected one of {', '.join(shapes)}, got {', '.join(given) or 'none'}")


AXES = ("abductor", "thumb", "index", "middle", "ring", "pinky")
FINGERS = AXES[2:]


class HandAxes(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The commanded axes of a hand; null where the hand has no such finger."""

    abductor: str | None
    thumb: str | None
    index: str | None
    middle: str | None
    ring: str | None
    pinky: str | None


class PalmBox(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where the palm is to the thumb, in the palm's frame, the thumb's radius added [m]."""

    start: Finite
    end: Finite
    half_width: Positive
    front: Finite


class Hand(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Frames and measures of the right hand; the left one is its mirror image.

    Palm: x along the straight fingers, y to the little finger's side, z out of the palm. A frame is no mirror
    image of itself: y of the left palm points to the thumb's side.
    """

    palm: str
    fingers: dict[Literal["index", "middle", "ring", "pinky"], tuple[str, str, str, str]]
    """Frames of knuckle, middle joint, last joint and tip of each finger that there is.

    Where a finger has two phalanges, a frame in `RobotFile.frames` parts the last one in two.
    """
    thumb: tuple[str, str, str]
    """Frames of knuckle, joint and tip."""
    finger_radii: tuple[Positive, Positive, Positive]
    """Of the phalanges from the knuckle on [m]."""
    thumb_radii: tuple[Positive, Positive]
    palm_box: PalmBox
    palm_middle: Vector
    """Middle of the palm in its frame [m]."""
    heel: Vector
    """Where the hand ends at the wrist, in the palm's frame [m]."""

    def __post_init__(self) -> None:
        """Put the fingers in the order of the hand, from the index on."""
        ordered = {name: self.fingers[name] for name in FINGERS if name in self.fingers}
        msgspec.structs.force_setattr(self, "fingers", ordered)

    @property
    def frames(self) -> tuple[str, ...]:
        """Palm, the fingers' frames and the thumb's."""
        return self.palm, *(frame for row in self.fingers.values() for frame in row), *self.thumb


class HandDriveSpeeds(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How fast a drive moves the axes of a hand, and how fast it gets there.

    Attributes:
        abductor_deg, thumb_deg, finger_deg: Greatest speeds of the axes [deg/s].
        quickness: Greatest acceleration and jerk of the axes over those of the body's joints [1].
    """

    abductor_deg: Positive
    thumb_deg: Positive
    finger_deg: Positive
    quickness: Positive = 1.0


class HandDrives(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Drives that the hands are built with, where there are several."""

    default: str
    drives: dict[str, HandDriveSpeeds]

    def __post_init__(self) -> None:
        """Refuse a default that is none of the drives."""
        if self.default not in self.drives:
            raise ValueError(f"default: expected one of {', '.join(self.drives)}, got {self.default!r}")


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
    """How arms get out of the way: the right arm's joints; the left one mirrors them."""

    sideways: dict[str, Finite]
    """Share by which each joint turns when the upper arm is lifted sideways [1]."""
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


class Setpoint(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the controller of a hand's axis counts in: a straight line of the joint's angle."""

    unit: Literal["deg", "mm"]
    """Degrees of a servo, or millimetres of a tendon."""
    travel: Positive
    """Greatest set-point, in that unit; the least is 0."""
    low_deg: Finite
    """Joint angle at set-point 0."""
    high_deg: Finite
    """Joint angle at the greatest set-point."""


class HandSetpoints(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The axes of either hand as their controllers count them."""

    abductor: Setpoint
    thumb: Setpoint
    finger: Setpoint


class Servo(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The drive of a joint, seen from the joint."""

    torque: Positive
    """The most that it gives, without losses [N m]."""
    inertia: Positive
    """Of the motor's rotor [kg m^2]."""


class Servos(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The drives of the commanded joints."""

    body: dict[str, Servo]
    """By joint of head, trunk and arms."""
    hand: Servo
    """Of every axis of a hand."""


class Controllers(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What is published of the robot's own controllers; nobody needs it to have the robot sign."""

    boards: dict[str, str]
    """Names of the control boards, by limb: head, trunk, left_arm, right_arm, left_hand, right_hand."""
    hands: HandSetpoints
    servos: Servos

    def __post_init__(self) -> None:
        """Refuse boards of other limbs than there are."""
        limbs = set(Groups.__struct_fields__)
        if set(self.boards) != limbs:
            raise ValueError(f"boards: expected {', '.join(sorted(limbs))}, got {', '.join(self.boards)}")
