# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The pose in which TEO parks, and in which every sentence begins and ends."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from teo_description.joints import ALL_JOINTS
from teo_description.urdf import figures as tables

# The thumb's flexion at rest [rad]: it lies along the index, 22 mm off; at 0 its last phalanx would be in it.
THUMB_AT_REST = math.radians(-30.0)


def _home() -> Mapping[str, float]:
    rows = {
        row.name: row
        for row in (*tables.body_joints(), *tables.hand_joints("Left"), *tables.hand_joints("Right"))
    }
    # 0 where the joint can reach it, else the nearest it can: the fingers rest at their most extended, 7 deg.
    home = {name: min(max(0.0, rows[name].lower), rows[name].upper) for name in ALL_JOINTS}
    return MappingProxyType({**home, "LeftThumbFinger": THUMB_AT_REST, "RightThumbFinger": THUMB_AT_REST})


# From the tables and not from the URDF, so that this package can be imported to build a missing URDF.
# TEO's park pose [rad], 40 joints: fingers at their lower limit of 7 deg, thumbs at -30 deg, others at 0.
HOME: Mapping[str, float] = _home()
