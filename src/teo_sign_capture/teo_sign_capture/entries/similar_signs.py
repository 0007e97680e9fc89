# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether a new sign is nearly one that the table has: said when it is captured, before both are confused."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from teo_description.robot import Robot
from teo_sign_capture.recognition.appearance import sign_appearance
from teo_sign_capture.recognition.sign_index import SignIndex
from teo_signs.errors import LutError
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut, user_lut_directory
from teo_signs.sign import Sign

# Signs whose largest difference is below two of those that are just seen are told apart only by who looks for
# it; no two words of the shipped table are below one.
_ALIKE = 2.0


@dataclass(frozen=True, kw_only=True)
class SimilarSign:
    """A sign of the table beside a new one.

    Attributes:
        gloss: Its name.
        seen: The largest difference of both [differences that are just seen]; 0 of one and the same motion.
    """

    gloss: str
    seen: float

    def warning(self, gloss: str) -> str | None:
        """What the teacher of a new sign should know; None where both are told apart."""
        if self.seen == 0.0:
            return f"{gloss} is the same motion as {self.gloss}."
        if self.seen < _ALIKE:
            return (
                f"{gloss} looks nearly like {self.gloss}: what differs most is {self.seen:.1f} times what is "
                "just seen."
            )
        return None


def similar_signs(robot: Robot, sign: Sign, table: Path) -> tuple[SimilarSign, ...]:
    """The signs of a table that look most like a new one, the most alike first.

    Args:
        robot: The robot.
        sign: The new sign; an entry of the same name is no other sign.
        table: Directory that it goes to; of the user's own, what the package's table holds counts as well.
    """
    others: dict[str, Sign] = {}
    try:
        name = robot.humanoid.name
        signs = Lut.open(None if table == user_lut_directory(robot=name) else table, robot=name)
    except LutError:  # a table that is made with its first sign
        return ()
    for gloss in signs.glosses():
        try:
            other = signs[gloss]
        except LutError:  # entries that are not valid are `lut validate`'s to tell
            continue
        if gloss != sign.gloss and other.kind == sign.kind:
            others[gloss] = other
    if not others:
        return ()
    found = []
    for match in SignIndex.of_signs(robot, others.values()).nearest(sign_appearance(robot, sign)):
        pairs = nearest_pairs(robot, [sign, others[match.gloss]])  # two names of one motion are no pair
        found.append(SimilarSign(gloss=match.gloss, seen=round(pairs[0].seen, 2) if pairs else 0.0))
    return tuple(sorted(found, key=lambda similar: similar.seen))
