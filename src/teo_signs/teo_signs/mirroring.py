# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The table as a left-handed signer makes it: every sign as its mirror image.

What the right hand does the left one does, and the other way round; head and trunk turn to the other side.
The limits of a robot's arms need not be mirror images: TEO's left upper arm turns in 5.4 deg less than the
right one, its wrist turns out 4 deg less. A posture that lies beyond is replaced by the one within the limits
that brings the hand nearest to its mirror image, and the sign says how far off that is (`mirror_error_mm`,
`mirror_error_deg` in its quality): by 23 mm and 8 deg at most in TEO's table. What is beyond a limit
elsewhere stays so, and a planner refuses it by name.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
from msgspec.structs import replace as changed

from teo_common.arrays import Array
from teo_description.humanoid import SIDES, Side
from teo_description.robot import Robot
from teo_signs.sign import Sign, with_alternatives
from teo_signs.sign_file import LIMIT_TOLERANCE
from teo_signs.sign_schema import Handedness

_OTHER_HAND: dict[Handedness, Handedness] = {"right": "left", "left": "right", "both": "both"}

# Weight of the hand's place against its orientation [rad/m]: 2 cm count as much as 9 deg of the palm.
_PLACE = 8.0

# Weights of the distance from the posture clipped to the limits [1], tried in turn: the first chooses among
# equally good postures, the others keep the arm nearer to the clipped posture if it would touch something.
_NEAR = (0.03, 0.3, 1.0, 3.0)

# Distance that parts of the robot keep in a posture [m]: the planner's curves between knots close less.
_CLEAR = 0.005


class MirroredSigns(Mapping[str, Sign]):
    """A table whose signs are mirrored when they are asked for; what changes there is seen here."""

    def __init__(self, signs: Mapping[str, Sign], robot: Robot) -> None:
        """Mirror a table.

        Args:
            signs: The table; signs keep their names.
            robot: Whose signs they are.
        """
        self._signs = signs
        self._robot = robot
        self._known: dict[str, tuple[Sign, Sign]] = {}

    def __getitem__(self, gloss: str) -> Sign:
        """The mirror image of a sign, made once.

        Raises:
            LutError: As of the table.
            KeyError: As of the table.
        """
        sign = self._signs[gloss]
        known = self._known.get(gloss)
        if known is None or known[0] is not sign:
            known = self._known[gloss] = sign, mirrored_sign(self._robot, sign)
        return known[1]

    def __contains__(self, gloss: object) -> bool:
        """Whether the table holds a gloss."""
        return gloss in self._signs

    def __iter__(self) -> Iterator[str]:
        """Glosses as the table gives them."""
        return iter(self._signs)

    def __len__(self) -> int:
        """How many signs there are."""
        return len(self._signs)


def mirrored_sign(robot: Robot, sign: Sign) -> Sign:
    """The mirror image of a sign, within the limits."""
    joints = tuple(map(robot.humanoid.mirrored_name, sign.joints))
    errors = np.zeros(2)

    def mirror(knots: Array) -> Array:
        rows, off = _mirrored_knots(robot, sign.joints, joints, knots)
        np.maximum(errors, off, out=errors)
        return rows

    knots = mirror(sign.knots)
    forms = {inflection: replace(form, knots=mirror(form.knots)) for inflection, form in sign.forms.items()}
    alternatives = tuple(mirror(other) for other in sign.alternatives)
    place, turn = errors.tolist()
    figures = {"mirror_error_mm": round(1000.0 * place, 1), "mirror_error_deg": round(math.degrees(turn), 1)}
    notes = f"{sign.provenance.notes} Mirrored for a left-handed signer.".strip()
    mirrored = replace(
        sign,
        handedness=_OTHER_HAND[sign.handedness],
        joints=joints,
        knots=knots,
        provenance=changed(sign.provenance, notes=notes),
        quality={**sign.quality, **figures} if turn else sign.quality,
        forms=forms,
    )
    return with_alternatives(mirrored, alternatives)


def _mirrored_knots(
    robot: Robot, joints: tuple[str, ...], mirrored: tuple[str, ...], knots: Array
) -> tuple[Array, Array]:
    """Mirrored knots within the limits [rad], and how far off a palm is at most [m], [rad].

    Args:
        robot: The robot.
        joints: What the knots' columns are.
        mirrored: What they are in the mirror.
        knots: Shape (n, joints).
    """
    mirror: Array = knots * robot.humanoid.mirror_signs(joints)
    errors = np.zeros(2)
    for side in SIDES:
        arm = robot.humanoid.arm(side)
        if not set(arm) <= set(mirrored):
            continue
        columns = [mirrored.index(name) for name in arm]
        limits = robot.humanoid.limits(arm)
        for row in mirror:
            within = np.clip(row[columns], limits.lower, limits.upper)
            # An entry keeps six decimals: what is beyond by less is on the limit.
            if np.abs(within - row[columns]).max() > LIMIT_TOLERANCE:
                wanted = row[columns]
                for near in _NEAR:
                    row[columns], found = _nearest(robot, side, wanted, within, near)
                    if _is_clear(robot, mirrored, row):
                        break
                errors = np.maximum(errors, found)
    return mirror, errors


def _is_clear(robot: Robot, joints: tuple[str, ...], row: Array) -> bool:
    pose = dict(zip(joints, row.tolist(), strict=True))
    return robot.clearance(robot.configuration(pose)).distance >= _CLEAR


def _nearest(
    robot: Robot, side: Side, wanted: Array, start: Array, near: float
) -> tuple[Array, tuple[float, float]]:
    """The arm within its limits that brings the hand nearest to where another arm would.

    Args:
        robot: The robot.
        side: Which arm.
        wanted: The arm beyond its limits [rad]. Shape (joints,).
        start: The same within them. Shape (joints,).
        near: What a radian of way from the start costs.

    Returns:
        The arm, shape (joints,), and how far off its palm is [m] and [rad].
    """
    from scipy.optimize import least_squares  # here: 0.3 s that who signs with the right hand does without

    humanoid = robot.humanoid
    joints = humanoid.arm(side)
    limits = humanoid.limits(joints)
    palm_frame = (
        humanoid.file.hand.palm if side == "right" else humanoid.mirrored_name(humanoid.file.hand.palm)
    )

    def palm(arm: Array) -> Array:
        q = robot.configuration(dict(zip(joints, arm.tolist(), strict=True)))
        return robot.placement(q, palm_frame)

    goal = palm(wanted)

    def residuals(arm: Array) -> Array:
        placed = palm(arm)
        turned = (placed[:3, :3] - goal[:3, :3]).ravel() / np.sqrt(2.0)
        return np.concatenate([_PLACE * (placed[:3, 3] - goal[:3, 3]), turned, near * (arm - start)])

    inside = np.clip(start, limits.lower + 1e-6, limits.upper - 1e-6)
    fit = least_squares(residuals, inside, bounds=(limits.lower, limits.upper))
    found = np.clip(fit.x, limits.lower, limits.upper)
    placed = palm(found)
    cosine = (np.trace(placed[:3, :3].T @ goal[:3, :3]) - 1.0) / 2.0
    distance = float(np.linalg.norm(placed[:3, 3] - goal[:3, 3]))
    return found, (distance, math.acos(min(1.0, max(-1.0, cosine))))
