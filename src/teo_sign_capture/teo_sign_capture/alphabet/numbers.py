# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The digits of Spanish Sign Language from measured handshapes.

1 shows the palm to the viewer, 2 to 5 count upwards, 6 to 10 take two hands: the left open, the right counts
on. What the fingers do was measured on the clips of VozVisible (MIT); the clips themselves are not used, and
they have no 0, which is written from the common form (a closed O). In every one of them each finger is either
straight or folded, so that is all that is taken over, with the side of the palm that is seen.
"""

from __future__ import annotations

import datetime
from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, description_hash, joint_limits
from teo_description.robot import Robot
from teo_sign_capture.alphabet.spelling_arm import ArmFit, fit_arm
from teo_sign_capture.retarget.arm_bounds import mirrored
from teo_sign_capture.retarget.quality_figures import clearance_mm, limit_margin_deg
from teo_signs.sign import Sign
from teo_signs.sign_schema import Provenance

# Straight fingers by digit (index, middle, ring, little), palm side, whether the left hand is there: from
# GungorUmit/VozVisible, clips "uno" to "diez", medians of joint angles: straight ones bend 2 to 29 deg in all
# joints together, folded ones 178 to 251 deg.
_STRAIGHT = {
    "1": "1000",
    "2": "1100",
    "3": "1110",
    "4": "1111",
    "5": "1111",
    "6": "1000",
    "7": "1100",
    "8": "1110",
    "9": "1111",
    "10": "1111",
}
_PALM_OUT = ("1", "5")
_TWO_HANDED = ("6", "7", "8", "9", "10")
_OPEN_THUMB = ("5", "10")

# [s] Median of the strokes of the letters of the manual alphabet: the numbers' own are not measured.
_HOLD = 0.64

# [rad] Flexion of a folded finger: total 240 deg, as measured; 5 deg from the limit.
_FOLDED = np.radians(80.0)
# Abductor and thumb [deg]: spread from the open hand; else as far over the palm as it goes without touching
# what is folded there, by how many fingers are straight.
_THUMB_SPREAD = (0.0, -60.0)
_THUMB_OVER_PALM = {1: (45.0, -15.0), 2: (70.0, -15.0), 3: (80.0, -15.0), 4: (80.0, -15.0)}
# [rad] Fingers bent to the opposed thumb: least sum of the distances of the tips without overlap.
_ZERO_HAND = np.radians([80.0, -54.0, 40.0, 38.0, 42.0, 42.0])


@dataclass(frozen=True, kw_only=True)
class _Palm:
    """Where and how a right palm is: direction of the hand, of the palm, place in ``base_link`` [m]."""

    along: tuple[float, float, float]
    out: tuple[float, float, float]
    place: tuple[float, float, float]

    def axes(self) -> Array:
        along = np.array(self.along) / np.linalg.norm(self.along)
        out = np.array(self.out) - (np.array(self.out) @ along) * along
        out /= np.linalg.norm(out)
        return np.column_stack([along, np.cross(out, along), out])


# Beside the face, where TEO spells: palm to the viewer as in its own E, palm to the side as in its own O (the
# ring shows); palm to the signer at the shoulder; both hands side by side before the chest.
_OUT = _Palm(along=(0.33, 0.15, 0.93), out=(0.90, 0.26, -0.36), place=(0.44, -0.25, 0.70))
_SIDE = _Palm(along=(0.33, 0.25, 0.91), out=(0.18, 0.93, -0.32), place=(0.43, -0.25, 0.70))
_IN = _Palm(along=(0.35, 0.35, 0.87), out=(-0.85, 0.50, 0.15), place=(0.42, -0.27, 0.62))
_BEFORE_CHEST = _Palm(along=(0.25, 0.35, 0.90), out=(-0.90, 0.40, 0.10), place=(0.40, -0.17, 0.50))


def digit_signs(robot: Robot) -> list[Sign]:
    """The numbers 0 to 10 as TEO makes them."""
    return [_number(robot, digit) for digit in ("0", *_STRAIGHT)]


def _number(robot: Robot, digit: str) -> Sign:
    two_handed = digit in _TWO_HANDED
    palm = _BEFORE_CHEST if two_handed else _OUT if digit in _PALM_OUT else _SIDE if digit == "0" else _IN
    arm = fit_arm(robot, palm.axes(), np.array(palm.place), both_sides=two_handed)
    joints, pose = RIGHT_ARM + RIGHT_HAND, np.concatenate([arm.positions, _hand(digit)])
    if two_handed:
        joints += LEFT_ARM + LEFT_HAND
        pose = np.concatenate([pose, mirrored(arm.positions), _hand("5")])
    knots = np.stack([pose, pose])
    return Sign(
        gloss=digit,
        language="lse",
        kind="number",
        handedness="both" if two_handed else "right",
        joints=joints,
        times=np.array([0.0, _HOLD]),
        knots=knots,
        provenance=Provenance(
            standing="sketched" if digit == "0" else "measured",
            source=(
                "common form"
                if digit == "0"
                else f"measurements on the clips of GungorUmit/VozVisible, number {digit}"
            ),
            method="straight and folded fingers, palm side; arm by inverse kinematics (capture_numbers)",
            recorded=None,
            created=datetime.date.today().isoformat(),
            licence="facts" if digit == "0" else "facts measured on clips under MIT",
            description_hash=description_hash(),
            notes=_notes(digit),
        ),
        quality=_quality(robot, joints, knots, arm),
    )


def _hand(digit: str) -> Array:
    if digit == "0":
        return _ZERO_HAND
    straight = joint_limits(RIGHT_HAND).lower[2:]
    fingers = np.where([finger == "1" for finger in _STRAIGHT[digit]], straight, _FOLDED)
    count = _STRAIGHT[digit].count("1")
    thumb = _THUMB_SPREAD if digit in _OPEN_THUMB else _THUMB_OVER_PALM[count]
    return np.concatenate([np.radians(thumb), fingers])


def _notes(digit: str) -> str:
    if digit == "0":
        return "No recording of 0 was found; the form is the common closed O, seen from its side. Doubtful."
    two = " Left hand open, palm in; right hand beside it." if digit in _TWO_HANDED else ""
    return f"Held still; the recording's small movements are not taken over.{two}"


def _quality(robot: Robot, joints: tuple[str, ...], knots: Array, arm: ArmFit) -> dict[str, float]:
    return {
        "palm_angle_error_deg": round(float(np.degrees(arm.angle_error)), 1),
        "place_error_mm": round(1000.0 * arm.place_error, 1),
        "clearance_mm": clearance_mm(robot, joints, knots),
        "limit_margin_deg": limit_margin_deg(joints, knots),
    }
