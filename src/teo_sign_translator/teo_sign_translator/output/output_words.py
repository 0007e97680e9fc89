# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Output words, before they are numbered tokens: signs, spelled words, numbers, pauses, carried words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import groupby

from teo_common.text_folding import strip_marks, without_accents
from teo_sign_languages import DEFAULT_LANGUAGE, Language, load_language
from teo_sign_translator.output.translation import Kind, Origin, Token
from teo_sign_translator.text.rules import TextRules

#: Signs of numbers, which may stand in a word ("UC3M").
DIGITS = frozenset("0123456789")


class Spelling:
    """Spells words; of a sign of several letters (CH) before its first letter alone."""

    def __init__(self, language: Language) -> None:
        """Take a language's alphabet."""
        self.name = language.names.short
        self.alphabet = frozenset(language.alphabet.letters)
        self._transcription = str.maketrans(language.alphabet.transcriptions)
        self._longest = max(map(len, self.alphabet))

    @classmethod
    @cache
    def load(cls) -> Spelling:
        """That of the default language."""
        return cls(load_language(DEFAULT_LANGUAGE))

    def letters(self, word: str) -> tuple[str, ...]:
        """The signs that spell a word, e.g. `"Guillermo"` gives G U I LL E R M O in LSE.

        Characters that no sign exists for are left out; `unsignable` names them beforehand.
        """
        plain = self._plain(word)
        result: list[str] = []
        index = 0
        while index < len(plain):
            sizes = range(self._longest, 1, -1)
            size = next((size for size in sizes if plain[index : index + size] in self.alphabet), 1)
            if plain[index : index + size] in self.alphabet:
                result.append(plain[index : index + size])
            index += size
        return tuple(result)

    def unsignable(self, word: str) -> tuple[str, ...]:
        """Characters of a word that neither letters nor numbers can spell, in order, without repetition.

        An apostrophe is no letter, and is not missed.
        """
        known = self.alphabet | DIGITS | {"'"}
        return tuple(dict.fromkeys(c for c in word if any(p not in known for p in self._plain(c))))

    def _plain(self, word: str) -> str:
        """A word in capitals of the alphabet, without accents; what has no such form stays as it is."""
        plain = without_accents(word.upper()).translate(self._transcription)
        return "".join(c if c in self.alphabet else strip_marks(c).upper() for c in plain)


#: Of a word that is spelled since it has no sign: spelling Spanish is the last resort.
SPELLED_CONFIDENCE = 0.3

# Digits of the largest number that is one token: 999,999.
_LONGEST_NUMBER = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputWord:
    """One output word.

    Attributes:
        signs: Its glosses: one, or the letters or digits of one word; none for a word that has no sign of its
            own.
        kind: Of all its signs.
        confidence: 0 to 1.
        words: Words of the text, as typed, that it stands for.
        origin: Where it comes from.
        is_name: Whether its one gloss is somebody's name, spelled unless it has a sign.
        inflection: Form of its one sign: "2>1" from the addressee to the signer; empty for the citation form.
        meant: The gloss that it shows, if that is not its own; empty for a gloss's own sign and for names.
        said: What a word without a sign of its own says; spelled if nothing else of its sentence is signed.
    """

    signs: tuple[str, ...]
    kind: Kind
    confidence: float
    words: tuple[str, ...]
    origin: Origin
    is_name: bool = False
    inflection: str = ""
    meant: str = ""
    said: str = ""


#: Hands held still between two clauses.
PAUSE = OutputWord(signs=("",), kind=Kind.PAUSE, confidence=1.0, words=(), origin=Origin.PAUSE)


def carried(word: str, typed: tuple[str, ...]) -> OutputWord:
    """A word without a sign of its own: LSE says it otherwise, or not at all."""
    return OutputWord(
        signs=(), kind=Kind.LEXICAL, confidence=1.0, words=typed, origin=Origin.WORD_LIST, said=word
    )


def spelled(
    word: str, typed: tuple[str, ...], confidence: float, spelling: Spelling | None = None
) -> list[OutputWord]:
    """A word in letters of the manual alphabet; digits in it ("UC3M") as numbers.

    Args:
        word: What is spelled.
        typed: Words of the text that it stands for.
        confidence: 0 to 1.
        spelling: Of the language; by default the default language's.
    """
    spelling = spelling or Spelling.load()
    result: list[OutputWord] = []
    for is_number, run in groupby(word, key=lambda character: character in DIGITS):
        text = "".join(run)
        signs = tuple(text) if is_number else spelling.letters(text)
        if signs:
            kind = Kind.NUMBER if is_number else Kind.LETTER
            result.append(
                OutputWord(signs=signs, kind=kind, confidence=confidence, words=typed, origin=Origin.SPELLED)
            )
    return result


def number(
    value: str, typed: tuple[str, ...], confidence: float, decimal_gloss: str | None = None
) -> list[OutputWord]:
    """A number as one token, which the executor composes signs for; a decimal comma is a word between two.

    Hours and minutes of a time of day are two numbers; no minutes are not said.

    Args:
        value: Digits, with one `,` if it has decimals, or one `:` in a time of day.
        typed: Words of the text that it stands for.
        confidence: 0 to 1.
        decimal_gloss: What is signed between whole and decimals; by default the default language's.
    """
    hours, _, minutes = value.partition(":")
    if minutes:
        said = [hours] if minutes == "00" else [hours, minutes]
        return [_digits(digits, typed, confidence) for digits in said]
    whole, _, decimals = value.partition(",")
    if not decimals:
        return [_digits(whole, typed, confidence)]
    comma = lexical(decimal_gloss or TextRules.load().glosses.decimal, typed, confidence, Origin.NUMBER)
    return [_digits(whole, typed, confidence), comma, _digits(decimals, typed, confidence)]


def _digits(digits: str, typed: tuple[str, ...], confidence: float) -> OutputWord:
    # Longer numbers have no name: they are read out digit by digit, and may be parted anywhere.
    signs = (digits,) if len(digits) <= _LONGEST_NUMBER else tuple(digits)
    return OutputWord(signs=signs, kind=Kind.NUMBER, confidence=confidence, words=typed, origin=Origin.NUMBER)


def lexical(
    gloss: str,
    typed: tuple[str, ...],
    confidence: float,
    origin: Origin = Origin.MODEL,
    *,
    is_name: bool = False,
) -> OutputWord:
    """A sign of its own; of a name that has none, its letters."""
    return OutputWord(
        signs=(gloss,), kind=Kind.LEXICAL, confidence=confidence, words=typed, origin=origin, is_name=is_name
    )


def without_carried(
    output_words: Sequence[OutputWord], spelling: Spelling
) -> tuple[list[OutputWord], tuple[str, ...]]:
    """Output words that are signed, and the typed words of those that are not, in the order of the text.

    Args:
        output_words: Of one sentence. If none of them is signed, their words are spelled.
        spelling: Of the language.

    Returns:
        One pause between two words, none at the ends, however many marks were typed; and what is dropped.
    """
    if not any(output_word.signs and output_word.kind is not Kind.PAUSE for output_word in output_words):
        spelt = [
            each
            for output_word in output_words
            for each in spelled(output_word.said, output_word.words, SPELLED_CONFIDENCE, spelling)
        ]
        return spelt, ()
    result: list[OutputWord] = []
    dropped: list[str] = []
    for output_word in output_words:
        if not output_word.signs:
            dropped += output_word.words
        elif output_word.kind is not Kind.PAUSE or (result and result[-1].kind is not Kind.PAUSE):
            result.append(output_word)
    if result[-1].kind is Kind.PAUSE:
        result.pop()
    return result, tuple(dropped)


def number_tokens(output_words: Iterable[OutputWord]) -> tuple[Token, ...]:
    """Turn output words into tokens, counting the output words."""
    return tuple(
        Token(
            gloss=sign,
            kind=output_word.kind,
            confidence=output_word.confidence,
            word_index=index,
            source_words=output_word.words,
            origin=output_word.origin,
            inflection=output_word.inflection,
            meant=output_word.meant,
        )
        for index, output_word in enumerate(output_words)
        for sign in output_word.signs
    )


def divide(output_words: Sequence[OutputWord], most: int) -> list[list[OutputWord]]:
    """Divide output words into parts of at most so many signs.

    Args:
        output_words: Of one sentence.
        most: Signs of a part; the division is between words unless one word has more.
    """
    parts: list[list[OutputWord]] = [[]]
    room = most
    for output_word in output_words:
        rest = output_word
        while len(rest.signs) > room:
            if room == most or (len(rest.signs) > most and room > 0):
                parts[-1].append(replace(rest, signs=rest.signs[:room]))
                rest = replace(rest, signs=rest.signs[room:])
            parts.append([])
            room = most
        parts[-1].append(rest)
        room -= len(rest.signs)
    return parts
