# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What ``robot.yaml`` says of how arms are held and led."""

from __future__ import annotations

import msgspec

from teo_description.schema.numbers import Finite


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
