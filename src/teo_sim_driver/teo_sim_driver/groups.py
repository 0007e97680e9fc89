# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Groups of joints that can be commanded by themselves: the limbs, and the whole body."""

from __future__ import annotations

from typing import NamedTuple

from teo_description.humanoid import Humanoid


class JointGroup(NamedTuple):
    """Joints that one trajectory is about."""

    name: str
    """What its topic, its action and its status are found under; empty for the whole body."""
    joints: tuple[str, ...]

    @property
    def prefix(self) -> str:
        """What the names of its topic and action begin with."""
        return f"{self.name}/" if self.name else ""


def joint_groups(humanoid: Humanoid) -> tuple[JointGroup, ...]:
    """The whole body, then each limb that has joints."""
    limbs = (JointGroup(name, joints) for name, joints in humanoid.limbs.items() if joints)
    return JointGroup("", humanoid.commanded_joints), *limbs
