# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Names, limits and postures of TEO, for tests and measurements of what TEO does."""

from __future__ import annotations

from teo_description.humanoid import load_humanoid

_TEO = load_humanoid("teo")

HEAD, TRUNK = _TEO.head, _TEO.trunk
LEFT_ARM, RIGHT_ARM = _TEO.arm("left"), _TEO.arm("right")
LEFT_HAND, RIGHT_HAND = _TEO.hand("left"), _TEO.hand("right")
BODY_JOINTS = _TEO.body_joints
COMMANDED_JOINTS = _TEO.commanded_joints
LEG_JOINTS = _TEO.standing
ALL_JOINTS = _TEO.all_joints
HOME = _TEO.home

mirrored_name = _TEO.mirrored_name
joint_limits = _TEO.limits
urdf_text = _TEO.urdf_text
urdf_path = _TEO.urdf_path


def description_hash() -> str:
    """Names TEO in its signs."""
    return _TEO.description_hash
