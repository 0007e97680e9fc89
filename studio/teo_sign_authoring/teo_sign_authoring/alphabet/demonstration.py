# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs that TEO itself has made in public, from the poses of that demonstration.

roboticslab-uc3m/teo-demos-misc, 20191023-ttd-congress.py: position moves of arms in degrees and of hands in
the units of their motors, each with its duration, and pauses of 0.5 s.
"""

from __future__ import annotations

import datetime
from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_setpoints import setpoint_axes
from teo_description.humanoid import Humanoid, load_humanoid
from teo_description.robot import Robot
from teo_sign_capture.retarget.knots import clearance_mm, limit_margin_deg
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.sign import Sign
from teo_signs.sign_schema import Handedness, Provenance

_PAUSE = 0.5  # [s], after each sign of the demonstration
# Every motor at rest, tendons slack: the thumb stands out from the straight fingers.
_OPEN_HAND = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
# [rad] The poses are published to a tenth of a degree: a joint beyond its limit by half of that is on it.
_ROUNDING = np.radians(0.05)


@dataclass(frozen=True, kw_only=True)
class _Demonstrated:
    gloss: str
    handedness: Handedness
    right_arm: tuple[tuple[float, ...], ...]
    """Poses [deg], in order."""
    move_times: tuple[float, ...]
    """Duration of the moves from each pose to the next [s]."""
    left_arm: tuple[float, ...] | None
    """Pose held meanwhile [deg]; None where the left arm takes no part."""
    hands: tuple[float, ...] | None
    """Abductor [deg], thumb, index, middle, ring, little finger [mm of tendon]; None for open hands."""
    notes: str


_SIGNS = (
    _Demonstrated(
        gloss="HOLA",
        handedness="right",
        right_arm=((-56.0, 9.9, 21.8, -99.6, 33.5, -26.1), (-59.6, 9.9, 21.8, -83.6, 33.5, -17.6)),
        move_times=(0.75,),
        left_arm=None,
        hands=None,
        notes="Hand open: the demonstration sends it nothing. The elbow begins on its limit, as published.",
    ),
    _Demonstrated(
        gloss="MI",
        handedness="right",
        right_arm=((-55.0, -5.0, 57.0, -99.6, -56.5, 6.7),),
        move_times=(),
        left_arm=None,
        hands=None,
        notes=(
            "Hand open. Elbow and axial shoulder are on their limits, as published. The left arm, which the "
            "demonstration raises meanwhile to be ready for NOMBRE, is left out: it has no part in the sign."
        ),
    ),
    _Demonstrated(
        gloss="NOMBRE",
        handedness="both",
        right_arm=((-65.0, 0.0, 50.0, -99.6, -20.0, 6.7), (-51.0, 2.0, 50.0, -80.0, -30.0, 15.0)),
        move_times=(1.75,),
        left_arm=(-35.0, 7.0, -35.0, -85.0, 0.0, 0.0),
        hands=(40.0, 2.0, 0.0, 0.0, 18.0, 18.0),
        notes="The elbow begins on its limit, as published.",
    ),
)


def flexions(motors: tuple[float, ...]) -> Array:
    """Hand motor positions as flexions.

    Args:
        motors: Abductor [deg], thumb and four fingers [mm].

    Returns:
        The six axes of a hand [rad]. Shape (6,).
    """
    axes = setpoint_axes(load_humanoid("teo"), "right")  # both hands count alike
    return np.array([axis.angle(motor) for axis, motor in zip(axes, motors, strict=True)])


def demonstrated_signs(robot: Robot) -> list[Sign]:
    """HOLA, MI and NOMBRE as TEO has made them."""
    return [_sign(robot, demonstrated) for demonstrated in _SIGNS]


def _sign(robot: Robot, demonstrated: _Demonstrated) -> Sign:
    humanoid = robot.humanoid
    joints = humanoid.arm("right") + humanoid.hand("right")
    right_hand = _hand(demonstrated.hands)
    rows = [np.concatenate([np.radians(pose), right_hand]) for pose in demonstrated.right_arm]
    if demonstrated.left_arm is not None:
        joints += humanoid.arm("left") + humanoid.hand("left")
        left = np.concatenate([np.radians(demonstrated.left_arm), _hand(demonstrated.hands)])
        rows = [np.concatenate([row, left]) for row in rows]
    times = np.cumsum([0.0, *demonstrated.move_times, _PAUSE])
    knots = _on_limits(humanoid, joints, np.stack([*rows, rows[-1]]), demonstrated.gloss)
    return Sign(
        gloss=demonstrated.gloss,
        language=DEFAULT_LANGUAGE,
        robot=humanoid.name,
        kind="lexical",
        handedness=demonstrated.handedness,
        joints=joints,
        times=times,
        knots=knots,
        provenance=Provenance(
            standing="recorded",
            source="roboticslab-uc3m/teo-demos-misc, 20191023-ttd-congress.py",
            method=(
                "published poses and move times of the robot, hand motors to flexion by 7 deg + 78 deg * "
                "tendon / 20 mm (thumb -90 deg + 180 deg * tendon / 10 mm); its pause of 0.5 s as hold at "
                "the end"
            ),
            recorded="2019-10-23",
            created=datetime.date.today().isoformat(),
            licence="facts: joint positions read in a published program that names no licence",
            description_hash=humanoid.description_hash,
            notes=demonstrated.notes,
        ),
        quality={
            "clearance_mm": clearance_mm(robot, joints, knots),
            "limit_margin_deg": limit_margin_deg(humanoid, joints, knots),
        },
    )


def _hand(motors: tuple[float, ...] | None) -> Array:
    return flexions(_OPEN_HAND if motors is None else motors)


def _on_limits(humanoid: Humanoid, joints: tuple[str, ...], knots: Array, gloss: str) -> Array:
    """Put what is beyond a limit by the publication's rounding onto it; refuse what is farther.

    Raises:
        LutError: A pose is outside the limits ("outside_limits").
    """
    limits = humanoid.limits(joints)
    beyond = np.maximum(limits.lower - knots, knots - limits.upper).max()
    if beyond > _ROUNDING:
        raise LutError(
            "outside_limits",
            f"{gloss}: expected published poses within TEO's limits, got {beyond:.4f} rad beyond",
        )
    return np.clip(knots, limits.lower, limits.upper)
