"""The pose in which TEO parks, and in which every sentence begins and ends."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from teo_description import tables
from teo_description.joints import ALL_JOINTS


def _home() -> Mapping[str, float]:
    rows = {
        row.name: row
        for row in (*tables.body_joints(), *tables.hand_joints("Left"), *tables.hand_joints("Right"))
    }
    # 0 where the joint can reach it, else the nearest it can: the fingers rest at their most extended, 7 deg.
    return MappingProxyType({name: min(max(0.0, rows[name].lower), rows[name].upper) for name in ALL_JOINTS})


# From the tables and not from the URDF, so that this package can be imported to build a missing URDF.
HOME: Mapping[str, float] = _home()
"""TEO's park pose [rad], all 40 joints: fingers at their lower limit of 7 deg, all others at 0."""
