# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What ``robot.yaml`` says of the hands."""

from __future__ import annotations

from typing import Literal

import msgspec

from teo_description.schema.urdf import Finite, Positive, Vector

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


class HandDriveSpeeds(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How fast a drive moves the axes of a hand."""

    abductor_deg: Positive
    thumb_deg: Positive
    finger_deg: Positive


class HandDrives(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Drives that the hands are built with, where there are several."""

    default: str
    drives: dict[str, HandDriveSpeeds]

    def __post_init__(self) -> None:
        """Refuse a default that is none of the drives."""
        if self.default not in self.drives:
            raise ValueError(f"default: expected one of {', '.join(self.drives)}, got {self.default!r}")
