# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What ``robot.yaml`` says of the URDF: where it is, and what replaces and completes it."""

from __future__ import annotations

import sys
from typing import Annotated

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
