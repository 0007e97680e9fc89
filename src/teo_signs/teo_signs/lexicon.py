# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From tokens to signs: look a token up, spell what the table lacks, and put numbers together."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from teo_common.text_folding import without_accents
from teo_sign_languages import DEFAULT_LANGUAGE, Numbers, load_language
from teo_signs.errors import LutError, PlanError
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_schema import STANDINGS, Standing
from teo_signs.tokens import Kind, Token, check_tokens

#: Digits of the largest number that has a name: 999,999.
_LONGEST_NUMBER = 6

_HUNDRED, _THOUSAND = 100, 1000


def number_glosses(digits: str, numbers: Numbers, has: Callable[[str], bool]) -> tuple[str, ...]:
    """The signs of a number, in order.

    A number below a million is how many there are of a magnitude, then the language's gloss for hundred or
    thousand, in falling order. Tens and units have one sign where the table has it; else they are their
    digits side by side, the tens first. What is no such number is read out digit by digit: longer ones
    (telephone numbers), codes, which have a zero in front, and those of a magnitude without a gloss.

    Args:
        digits: The number, 0 to 9 only.
        numbers: How the language puts numbers together.
        has: Whether a gloss has a sign of its own that may be used; not asked for single digits, which
            nothing could stand for.

    Returns:
        Glosses of the signs. The digits of the number if it is too long, begins with a zero, or there is no
        sign for a hundred or a thousand in it: half a number would be read as another one.
    """
    if len(digits) == 1 or has(digits):
        return (digits,)
    spelled = tuple(digits)
    if len(digits) > _LONGEST_NUMBER or digits.startswith("0"):
        return spelled
    thousands, rest = divmod(int(digits), _THOUSAND)
    made = (*_how_many(thousands, numbers, has), numbers.thousand) if thousands else ()
    made += _below_thousand(rest, numbers, has)
    operators = {numbers.hundred, numbers.thousand} & set(made)
    return made if all(gloss and has(gloss) for gloss in operators) else spelled


def _how_many(count: int, numbers: Numbers, has: Callable[[str], bool]) -> tuple[str, ...]:
    """The signs before a hundred or a thousand."""
    return _below_thousand(count, numbers, has) if count > 1 or numbers.one_before else ()


def _below_thousand(value: int, numbers: Numbers, has: Callable[[str], bool]) -> tuple[str, ...]:
    """The signs of a part below a thousand; none for 0."""
    if value == 0:
        return ()
    if has(str(value)):
        return (str(value),)
    hundreds, rest = divmod(value, _HUNDRED)
    if hundreds:
        return (*_how_many(hundreds, numbers, has), numbers.hundred, *_below_thousand(rest, numbers, has))
    return tuple(str(rest))


_SIGN_KIND = {Kind.LEXICAL: "lexical", Kind.LETTER: "letter", Kind.NUMBER: "number"}
_TOKEN_KIND = {sign: token for token, sign in _SIGN_KIND.items()}

# Lowest standing (evidence of the form) with which a lexical sign is used; with a lower one it is spelled. A
# sketch has no source: whoever knows LSE would read something else, or nothing, where letters tell the word.
DEFAULT_STANDING: Standing = "described"

# Signs that can spell have names this short: "A", "CH". Longer entries are not read when spelling.
_LONGEST_SPELLER = 2


@dataclass(frozen=True, kw_only=True)
class SignedToken:
    """A token and the sign that makes it; `sign` is None for a pause."""

    token: Token
    sign: Sign | None


class Lexicon:
    """Finds signs in a look-up table.

    A lexical gloss that the table lacks is spelled with the table's own letters, longest match first, so
    that CH, LL and RR are one sign where the table has them; digits in it become number signs and "_" a
    pause. Accents are dropped first, except on letters of their own (Ñ). So is a gloss whose sign is
    of too low a standing; letters and digits are always used, for nothing could stand for them.

    The tokens of one word that hold digits are one number, whose signs `number_glosses` chooses: 352 is
    3 100 5 2 in LSE, whose table has no sign for it. A token with an inflection is made with that form of
    its sign ("2>1": from the addressee to the signer), or with the citation form where the entry has no such
    form.
    """

    def __init__(
        self,
        signs: Mapping[str, Sign],
        least_standing: Standing = DEFAULT_STANDING,
        numbers: Numbers | None = None,
    ) -> None:
        """Use a table, which may change between two calls of `resolve`.

        Args:
            signs: The table.
            least_standing: The lowest standing that a lexical sign may have.
            numbers: How the table's language puts numbers together; None for the default language.
        """
        self._signs = signs
        self._numbers = load_language(DEFAULT_LANGUAGE).numbers if numbers is None else numbers
        self._good_enough = STANDINGS[: STANDINGS.index(least_standing) + 1]

    def resolve(self, tokens: Sequence[Token]) -> tuple[SignedToken, ...]:
        """Find a sign for every token.

        Returns:
            In order; a spelled gloss gives one entry for each sign that replaces it, with the token's word
            index, confidence and duration scale.

        Raises:
            PlanError: A token cannot be signed ("unknown_sign", "invalid_sign" or see `check_tokens`).
        """
        check_tokens(tokens)
        return tuple(signed for token in self._numbers_joined(tokens) for signed in self._resolve(token))

    def makes(self, sign: Sign) -> bool:
        """Whether a sign of the table is made; a lexical one of too low a standing is spelled instead."""
        must = sign.kind == "letter" or (sign.kind == "number" and len(sign.gloss) == 1)
        return must or sign.provenance.standing in self._good_enough

    @staticmethod
    def _numbers_joined(tokens: Sequence[Token]) -> Iterator[Token]:
        """Tokens, those that hold the digits of one word as one."""
        for (kind, _, _), run in groupby(
            tokens, key=lambda token: (token.kind, token.word_index, token.duration_scale)
        ):
            word = tuple(run)
            if kind == Kind.NUMBER and len(word) > 1:
                yield dataclasses.replace(word[0], gloss="".join(token.gloss.strip() for token in word))
            else:
                yield from word

    def _resolve(self, token: Token) -> list[SignedToken]:
        if token.kind == Kind.PAUSE:
            return [SignedToken(token=token, sign=None)]
        gloss = gloss_key(token.gloss.strip()).upper()
        if token.kind == Kind.NUMBER and gloss.isascii() and gloss.isdecimal():
            return self._number(token, gloss)
        sign = self._find(gloss, token.kind)
        if sign is not None:
            return [SignedToken(token=token, sign=sign.inflected(token.inflection))]
        if token.kind == Kind.LETTER:
            sign = self._find(self._plain(gloss), Kind.LETTER)
            if sign is None:
                raise PlanError("unknown_sign", f"expected a letter of the table, got {token.gloss!r}")
            return [SignedToken(token=token, sign=sign)]
        return self._spell(token, self._plain(gloss))

    def _plain(self, text: str) -> str:
        """A text without accents, but for those of letters of their own: Ñ in Spanish, Å in Swedish."""
        own = (c if c.isascii() or self._find(c, Kind.LETTER) else without_accents(c) for c in text)
        return "".join(own)

    def _number(self, token: Token, digits: str) -> list[SignedToken]:
        """The signs of a number, each with a token of its own."""
        signed: list[SignedToken] = []
        for gloss in number_glosses(digits, self._numbers, lambda gloss: self._part(gloss) is not None):
            sign = self._part(gloss)
            if sign is None:
                raise PlanError("unknown_sign", self._missing(token, gloss))
            kind = _TOKEN_KIND[sign.kind]
            signed.append(SignedToken(token=dataclasses.replace(token, gloss=gloss, kind=kind), sign=sign))
        return signed

    def _part(self, gloss: str) -> Sign | None:
        """The sign of a part of a number; what says hundred may be a letter or a word."""
        kinds = (Kind.NUMBER,) if gloss.isdecimal() else (Kind.LETTER, Kind.LEXICAL)
        return next(filter(None, (self._find(gloss, kind) for kind in kinds)), None)

    def _find(self, gloss: str, kind: Kind) -> Sign | None:
        if gloss not in self._signs:
            return None
        try:
            sign = self._signs[gloss]
        except LutError as error:
            raise PlanError("invalid_sign", f"the entry of {gloss!r} cannot be used: {error}") from error
        return sign if sign.kind == _SIGN_KIND[kind] and self.makes(sign) else None

    def _spell(self, token: Token, text: str) -> list[SignedToken]:
        signed: list[SignedToken] = []
        position = 0
        while position < len(text):
            if text[position] == "_" and token.kind == Kind.LEXICAL:
                pause = dataclasses.replace(token, gloss="", kind=Kind.PAUSE)
                signed.append(SignedToken(token=pause, sign=None))
                position += 1
                continue
            for length in range(_LONGEST_SPELLER, 0, -1):
                piece = text[position : position + length]
                kind = Kind.NUMBER if piece.isdecimal() else Kind.LETTER
                # Digits one by one: "1012" is not ten and twelve.
                if (kind == Kind.NUMBER and length > 1) or (token.kind == Kind.NUMBER != kind):
                    continue
                sign = self._find(piece, kind) if len(piece) == length else None
                if sign is not None:
                    letter = dataclasses.replace(token, gloss=piece, kind=kind)
                    signed.append(SignedToken(token=letter, sign=sign))
                    position += length
                    break
            else:
                raise PlanError("unknown_sign", self._missing(token, text[position]))
        return signed

    @staticmethod
    def _missing(token: Token, character: str) -> str:
        if token.kind == Kind.NUMBER:
            return f"expected a number of the table, got {token.gloss!r}: there is no sign for {character!r}"
        return (
            f"expected a gloss of the table or one that its letters can spell, got {token.gloss!r}: "
            f"there is neither a sign of that name nor a letter for {character!r}"
        )
