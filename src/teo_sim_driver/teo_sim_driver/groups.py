# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Groups of joints that can be commanded by themselves: the limbs, and the whole body."""

from __future__ import annotations

from typing import NamedTuple

from teo_description import COMMANDED_JOINTS
from teo_description.joints import HEAD, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, TRUNK


class JointGroup(NamedTuple):
    """Joints that one trajectory is about."""

    name: str
    """What its topic, its action and its status are found under; empty for the whole body."""
    joints: tuple[str, ...]

    @property
    def prefix(self) -> str:
        """What the names of its topic and action begin with."""
        return f"{self.name}/" if self.name else ""


WHOLE_BODY = JointGroup("", COMMANDED_JOINTS)

# As the real robot divides its control boards.
LIMBS = (
    JointGroup("head", HEAD),
    JointGroup("trunk", TRUNK),
    JointGroup("left_arm", LEFT_ARM),
    JointGroup("right_arm", RIGHT_ARM),
    JointGroup("left_hand", LEFT_HAND),
    JointGroup("right_hand", RIGHT_HAND),
)
