# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sign tokens: what a sentence is made of before it becomes motion. Mirrors `teo_sign_msgs/SignToken`."""

from __future__ import annotations

import enum
import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass

from teo_signs.errors import PlanError

# A pause in the printed form, written as a space inside a gloss is: the hands stay still.
PRINTED_PAUSE = "_"

# Least and greatest duration scale: beyond, a sign of half a second takes no time or a minute.
SCALES = (0.001, 100.0)

# A gloss and its inflection in the printed form.
_INFLECTED = re.compile(r"([^\[\]]+)\[([^\[\]]+)\]")

# Letters of the Spanish manual alphabet are one or two characters long (CH, LL, RR).
_LONGEST_LETTER = 2


class Kind(enum.IntEnum):
    """What a token is; the numbers are those of the message."""

    LEXICAL = 0
    LETTER = 1
    NUMBER = 2
    PAUSE = 3


@dataclass(frozen=True, kw_only=True)
class Token:
    """One sign to make.

    Attributes:
        gloss: Name in the look-up table; empty for a pause.
        kind: What the token is.
        confidence: How sure the translator is, 0 to 1; carried along, not used.
        duration_scale: Times the sign's recorded duration: 2.0 is half as fast.
        word_index: Counts the words of the sentence; letters of one spelled word share it.
        source_words: Words of the text that this token stands for.
        inflection: Form of the sign: "2>1" from the addressee to the signer, "CABEZA" at the head; empty for
            the citation form, which is also made where the entry has no such form.
        origin: How the translator came by it, a value of `teo_sign_msgs/SignToken`; carried along, not used.
            0 if that is not said.
    """

    gloss: str
    kind: Kind = Kind.LEXICAL
    confidence: float = 1.0
    duration_scale: float = 1.0
    word_index: int = 0
    source_words: tuple[str, ...] = ()
    inflection: str = ""
    origin: int = 0

    @property
    def spelled(self) -> bool:
        """Whether the token is one sign of a spelled word or of a number."""
        return self.kind in (Kind.LETTER, Kind.NUMBER)


def check_tokens(tokens: Sequence[Token]) -> None:
    """Refuse a sentence that is not one, before anything is looked up.

    Raises:
        PlanError: "empty_sentence", "bad_kind", "bad_scale" or "bad_gloss", naming the token.
    """
    if not tokens:
        raise PlanError("empty_sentence", "expected at least one token to sign, got none")
    for index, token in enumerate(tokens):
        where = f"token {index} ({token.gloss!r})"
        if token.kind not in tuple(Kind):
            names = ", ".join(f"{kind.value} {kind.name.lower()}" for kind in Kind)
            raise PlanError("bad_kind", f"{where}: expected a kind of {names}, got {token.kind}")
        least, most = SCALES
        if not least <= token.duration_scale <= most:
            message = (
                f"{where}: expected a duration scale of {least:g} to {most:g}, got {token.duration_scale}"
            )
            raise PlanError("bad_scale", message)
        if not token.gloss.strip() and token.kind != Kind.PAUSE:
            raise PlanError("bad_gloss", f"{where}: expected the name of a sign, got an empty one")


def parse_printed(text: str) -> tuple[Token, ...]:
    """Read a sentence in the printed form: glosses by spaces, a spelled word as `A-N-A`, digits as numbers.

    A word of one or two characters between hyphens is a letter or, of digits, a number; a word of digits is a
    number; `_` alone is a pause. Anything else is a gloss, hyphens included, behind which an inflection may
    stand: `AYUDAR[2>1]`.

    Raises:
        PlanError: Nothing to sign ("empty_sentence"), or a spelled word with a letter missing ("bad_gloss").
    """
    tokens: list[Token] = []
    for word_index, word in enumerate(unicodedata.normalize("NFC", text).split()):
        parts = word.split("-")
        if word == PRINTED_PAUSE:
            tokens.append(Token(gloss="", kind=Kind.PAUSE, word_index=word_index))
        elif word.isdecimal():
            tokens.append(Token(gloss=word, kind=Kind.NUMBER, word_index=word_index))
        elif len(parts) > 1 and all(len(part) <= _LONGEST_LETTER for part in parts):
            if not all(parts):
                message = f"{word!r}: expected a letter on either side of each hyphen, got nothing there"
                raise PlanError("bad_gloss", message)
            for part in parts:
                kind = Kind.NUMBER if part.isdecimal() else Kind.LETTER
                tokens.append(Token(gloss=part, kind=kind, word_index=word_index))
        else:
            inflected = _INFLECTED.fullmatch(word)
            gloss, inflection = inflected.groups() if inflected else (word, "")
            tokens.append(Token(gloss=gloss, word_index=word_index, inflection=inflection))
    check_tokens(tokens)
    return tuple(tokens)
