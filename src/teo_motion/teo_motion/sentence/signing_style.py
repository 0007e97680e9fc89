# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the robot signs: times of holds, pauses and transitions, sizes, and the posture in which it waits."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from enum import StrEnum

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_signs.errors import PlanError


@dataclass(frozen=True, kw_only=True)
class SigningStyle:
    """The dials of a sentence's rhythm. Times are at a duration scale of 1.

    "Measured" below is LSE-Health-UVigo: 15,098 annotated signs and 1,029 spelled words of 10 signers of LSE,
    transitions left out of the intervals.
    """

    # Nominal time between two signs [s]: the measured median gap is 0.125 s. At 50 deg/s TEO mostly needs
    # longer, so this is a lower bound that short moves keep.
    transition: float = 0.125

    # Time for which a letter or number stands still in its last posture [s], however long its recording does:
    # single letters are recorded held for 0.5 to 0.9 s. Of the words that signers spell and read (measured)
    # the quickest tenth give a letter 0.18 s with its transition; deaf readers follow sentences at 6 letters
    # a second with hardly an error, and at 12 they still understand half (Reed and others 1990, J. Speech
    # Hear. Res. 33). A hold of 0.2 s alone is more. Learners understand more from holds than from transitions
    # (Geer and Keane 2014, LREC), and without any hold deaf testers of animations could not tell letters
    # (spoken-to-signed-translation, pull request 42).
    letter_hold: float = 0.2

    # The last letter of a word stands still so many times as long [1], 0.3 s: it marks the end of the word.
    # Tools of the field double theirs, and nobody has measured what readers need; what follows a spelled word
    # is a `word_pause` later besides.
    last_letter_hold: float = 1.5

    # Time for which the hands stay still between a spelled word and what follows it [s]: one gap more.
    word_pause: float = 0.125

    # Time of a pause token [s]: deaf users ask for about half a second at a full stop.
    pause: float = 0.5

    # Time for which a sign of a single posture is held [s]: the measured median duration of a sign is 0.44 s.
    posture_hold: float = 0.44

    # Time for which the last sign of a sentence is held before the hands go down [s]: signers lengthen the
    # last sign of a clause (Huenerfauth 2009), and without a hold its end is lost in the way down.
    final_hold: float = 0.25

    # The same for a yes/no question [s]: signers of LSE hold its last sign for an answer. Nobody has measured
    # for how long; twice the other hold is told from it.
    question_hold: float = 0.5

    # How far the elbow opens, and closes again, between two equal postures [rad]: 10 deg move TEO's hand by
    # about 6 cm, half a hand length, as signers bounce a doubled letter.
    repeat_angle: float = math.radians(10.0)

    # Nominal time of each half of that move [s]; at 50 deg/s 10 deg take a little longer.
    repeat_time: float = 0.2

    # An idle arm goes to rest only if it can stay there for this long before it is needed again [s]. Less
    # than about a second down would look like a sign of its own, and wear the arm for nothing.
    arm_rest: float = 1.0

    # Smallest size of a sign that is too slow as large as its source has it [1]: below 0.6 a circle of 20 cm
    # is one of 10, and the path is not told from a hold. 1 makes every sign as large as its entry.
    least_size: float = 0.6

    # Size of the head's gestures, which tell question, negation and exclamation [1]: 1 makes them as large as
    # `neck_paths` says and why, 0 leaves them away. On by default: without them a yes/no question in LSE is a
    # statement.
    head_motion: float = 1.0

    def __post_init__(self) -> None:
        """Check that every dial is finite and 0 or more, and `head_motion` and `least_size` at most 1.

        Raises:
            PlanError: "bad_style".
        """
        for field in fields(self):
            value = getattr(self, field.name)
            if not (math.isfinite(value) and value >= 0.0):
                raise PlanError(
                    "bad_style", f"{field.name}: expected a finite number, 0 or more, got {value}"
                )
        for name, value in (("head_motion", self.head_motion), ("least_size", self.least_size)):
            if value > 1.0:
                raise PlanError("bad_style", f"{name}: expected 0 to 1, got {value}")

    def for_form(self, form: SentenceForm) -> SigningStyle:
        """The rhythm of a sentence of some type."""
        if form.type != SentenceType.YES_NO_QUESTION:
            return self
        return replace(self, final_hold=max(self.final_hold, self.question_hold))


class RestPosture(StrEnum):
    """Names of the postures."""

    HANGING = "hanging"
    """Arms hang; out of the way of every sign."""
    READY = "ready"
    """Forearms level, hands low before the body and half closed, as signers wait for their turn."""

    def of(self, humanoid: Humanoid) -> Array:
        """Positions of the commanded joints [rad]. Shape (joints,), read-only."""
        return humanoid.hanging if self is RestPosture.HANGING else humanoid.ready


# Ready, because a sentence takes 1.5 s less than from hanging arms and back, and because that is how signers
# wait when more is to come.
DEFAULT_REST = RestPosture.READY
