# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Names and groups of TEO's joints, in the order in which the whole project lists them."""

from __future__ import annotations

from collections.abc import Iterable

from teo_description.errors import DescriptionError

_ARM = (
    "Frontal{}Shoulder",
    "Sagittal{}Shoulder",
    "Axial{}Shoulder",
    "Frontal{}Elbow",
    "Axial{}Wrist",
    "Frontal{}Wrist",
)
_HAND = (
    "{}HandAbductor",
    "{}ThumbFinger",
    "{}IndexFinger",
    "{}MiddleFinger",
    "{}RingFinger",
    "{}PinkyFinger",
)
_LEG = ("Axial{}Hip", "Sagittal{}Hip", "Frontal{}Hip", "Frontal{}Knee", "Frontal{}Ankle", "Sagittal{}Ankle")


def _side(group: tuple[str, ...], side: str) -> tuple[str, ...]:
    return tuple(name.format(side) for name in group)


HEAD = ("AxialNeck", "FrontalNeck")
TRUNK = ("AxialTrunk", "FrontalTrunk")
LEFT_ARM, RIGHT_ARM = _side(_ARM, "Left"), _side(_ARM, "Right")
LEFT_HAND, RIGHT_HAND = _side(_HAND, "Left"), _side(_HAND, "Right")
LEFT_LEG, RIGHT_LEG = _side(_LEG, "Left"), _side(_LEG, "Right")

# The 16 upper-body joints without the hands.
BODY_JOINTS = HEAD + TRUNK + LEFT_ARM + RIGHT_ARM

# The 28 joints that a sign can move, in the order of every trajectory.
COMMANDED_JOINTS = BODY_JOINTS + LEFT_HAND + RIGHT_HAND

# The 12 joints that stand still while TEO signs.
LEG_JOINTS = LEFT_LEG + RIGHT_LEG

# The 40 joints of the joint state; the phalanges that follow a tendon are not among them.
ALL_JOINTS = COMMANDED_JOINTS + LEG_JOINTS


def check_joint_names(names: Iterable[str], where: str = "") -> None:
    """Refuse names that are not among `ALL_JOINTS`.

    Args:
        names: The names.
        where: What the message begins with: their source, a colon and a blank.

    Raises:
        DescriptionError: ``unknown_joint``.
    """
    unknown = [name for name in names if name not in ALL_JOINTS]
    if unknown:
        expected, got = ", ".join(ALL_JOINTS), ", ".join(map(repr, unknown))
        raise DescriptionError("unknown_joint", f"{where}expected joints among {expected}; got {got}")


def mirrored_name(name: str) -> str:
    """Return the same joint, link or frame of the other side; a name without a side comes back unchanged."""
    for one, other in (("Left", "Right"), ("Right", "Left"), ("left_", "right_"), ("right_", "left_")):
        if one in name:
            return name.replace(one, other)
    return name
