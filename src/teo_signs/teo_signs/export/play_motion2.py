# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs as parameters of play_motion2 (pal-robotics/play_motion2, README and motion_loader.cpp).

`motions.<key>.joints`, `.positions` (a row for each time, rows one after the other), `.times_from_start` and
`.meta.name`, `.usage`, `.description`. Numbers all carry a decimal point, for ROS takes a list of numbers
without one for integers and play_motion2 refuses those. Texts and keys are quoted: without quotes `NO`
and `Y` are truth values in YAML, and `7` is a number.
"""

from __future__ import annotations

import json
from collections.abc import Iterable

from teo_signs.export.sign_motion import SignMotion

# A nanoradian: what is written stays within the limits that it stands on.
_DECIMALS = 9


def play_motion2_parameters(motions: Iterable[SignMotion]) -> str:
    """The text of a parameter file: motions by gloss, joints in radians."""
    lines = ["play_motion2:", "  ros__parameters:", "    motions:"]
    for motion in motions:
        sign = motion.sign
        rows = [", ".join(map(_number, row)) for row in motion.positions.tolist()]
        lines += [
            f"      {_text(sign.gloss)}:",
            f"        joints: [{', '.join(map(_text, motion.joints))}]",
            "        positions: [",
            *(f"          {row}," for row in rows[:-1]),
            f"          {rows[-1]}]",
            f"        times_from_start: [{', '.join(map(_number, motion.times.tolist()))}]",
            "        meta:",
            f"          name: {_text(sign.gloss)}",
            f"          usage: {_text('sign')}",
            f"          description: {_text(motion.description)}",
        ]
    return "\n".join(lines) + "\n"


def _number(value: float) -> str:
    return f"{round(value, _DECIMALS) + 0.0:.{_DECIMALS}f}"


def _text(value: str) -> str:
    """A JSON string is a double-quoted YAML scalar."""
    return json.dumps(value, ensure_ascii=False)
