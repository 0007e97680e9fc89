# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Numbers of two and three digits: 11 to 20, the tens and 100.

11 to 14 have a form of their own, seen on the clips of VozVisible (MIT): 11 is a 1 whose wrist shakes, 12 to
14 are 2 to 4 with hooked fingers that flick open. For the others no source was found: 15 to 19 are written
after the pattern of 12 to 14 and the tens and 100 as their digits, and all are `sketched`, so that a sentence
has their digits instead unless it is told to sign sketches.
"""

from __future__ import annotations

import datetime
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from teo_common.arrays import Array
from teo_description import COMMANDED_JOINTS, HOME, RIGHT_HAND
from teo_description.robot import Robot
from teo_sign_capture.retarget.quality_figures import clearance_mm, limit_margin_deg
from teo_signs.sign import Sign
from teo_signs.sign_schema import Standing

_FLICKED = {"12": "2", "13": "3", "14": "4", "15": "5", "16": "6", "17": "7", "18": "8", "19": "9"}
_SEEN = ("11", "12", "13", "14")
_WRITTEN_OUT = ("20", "30", "40", "50", "60", "70", "80", "90", "100")

# [rad] Flexion of a hooked finger, as of the scores' `hook`.
_HOOKED = np.radians(45.0)
# [s] Hooked before the flick, and the flick; TEO's fingers need longer.
_HELD_HOOKED, _FLICK = 0.2, 0.2
# [rad], times and [s] of each half: a shake of the wrist that is "small" and yet moves the tip by 3 cm.
_SHAKE, _SHAKES, _SHAKE_TIME = np.radians(10.0), 2, 0.15
# [s] From digit to digit, and half of the way aside between two equal ones.
_BETWEEN = 0.35
# [rad] How far the elbow opens between two equal digits.
_ASIDE = np.radians(8.0)


def higher_number_signs(robot: Robot, digits: Mapping[str, Sign]) -> list[Sign]:
    """The numbers 11 to 20, 30 to 90 by tens and 100.

    Args:
        robot: TEO.
        digits: The numbers 0 to 9, by gloss.
    """
    made = [_shaken("11", digits["1"])]
    made += [_flicked(number, digits[digit]) for number, digit in _FLICKED.items()]
    made += [_in_order(number, [digits[digit] for digit in number]) for number in _WRITTEN_OUT]
    return [_finished(robot, sign) for sign in made]


def _shaken(gloss: str, digit: Sign) -> Sign:
    wrist = digit.joints.index("FrontalRightWrist")
    bent = digit.knots[0].copy()
    bent[wrist] -= _SHAKE
    knots, times = [digit.knots[0]], [0.0]
    for _ in range(_SHAKES):
        for pose in (bent, digit.knots[0]):
            knots.append(pose)
            times.append(times[-1] + _SHAKE_TIME)
    return _held(
        replace(digit, gloss=gloss, times=np.array(times), knots=np.array(knots)), digit.duration / 2.0
    )


def _flicked(gloss: str, digit: Sign) -> Sign:
    """A digit whose straight fingers are hooked first; on the right hand, which counts."""
    hooked = digit.knots[0].copy()
    for finger in RIGHT_HAND[2:]:
        column = digit.joints.index(finger)
        hooked[column] = max(hooked[column], _HOOKED)
    knots = np.array([hooked, hooked, digit.knots[0]])
    times = np.array([0.0, _HELD_HOOKED, _HELD_HOOKED + _FLICK])
    return _held(replace(digit, gloss=gloss, times=times, knots=knots), digit.duration / 2.0)


def _in_order(gloss: str, parts: Sequence[Sign]) -> Sign:
    """Digits one after the other; a left hand that the next one does not need goes home."""
    used = {joint for part in parts for joint in part.joints}
    joints = tuple(joint for joint in COMMANDED_JOINTS if joint in used)
    knots: list[Array] = []
    times: list[float] = []
    for part in parts:
        own = dict(zip(part.joints, part.knots[0].tolist(), strict=True))
        pose = np.array([own.get(joint, HOME[joint]) for joint in joints])
        if knots and np.array_equal(knots[-1], pose):
            aside = pose.copy()
            aside[joints.index("FrontalRightElbow")] += _ASIDE
            knots.append(aside)
            times.append(times[-1] + _BETWEEN)
        knots += [pose, pose]
        start = times[-1] + _BETWEEN if times else 0.0
        times += [start, start + part.duration]
    both = any(part.handedness == "both" for part in parts)
    return replace(
        parts[0],
        gloss=gloss,
        handedness="both" if both else "right",
        joints=joints,
        times=np.array(times),
        knots=np.array(knots),
    )


def _held(sign: Sign, hold: float) -> Sign:
    """The sign with its last posture held [s]."""
    return replace(
        sign,
        times=np.append(sign.times, sign.times[-1] + hold),
        knots=np.vstack([sign.knots, sign.knots[-1:]]),
    )


def _finished(robot: Robot, sign: Sign) -> Sign:
    """With what is to be said of it, and its figures."""
    source = "none for its form"
    if sign.gloss in _SEEN:
        source = f"clips of GungorUmit/VozVisible, number {sign.gloss}, in words"
        notes = "What the hand does was described, not measured."
    elif sign.gloss in _WRITTEN_OUT:
        notes = "Its digits, one after the other."
    else:
        notes = "After the pattern of 12 to 14: hooked fingers that flick open."
    errors = {name: value for name, value in sign.quality.items() if "_error_" in name}
    standing: Standing = "described" if sign.gloss in _SEEN else "sketched"
    about = {
        "standing": standing,
        "source": source,
        "method": "from the digits (capture_numbers)",
        "created": datetime.date.today().isoformat(),
        "licence": "facts",
        "notes": notes,
    }
    return replace(
        sign,
        provenance=sign.provenance.model_copy(update=about),
        quality={
            **errors,
            "clearance_mm": clearance_mm(robot, sign.joints, sign.knots),
            "limit_margin_deg": limit_margin_deg(sign.joints, sign.knots),
        },
    )
