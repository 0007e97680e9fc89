"""Output words before they are numbered: signs, spelled words, numbers, pauses, words that go along."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from teo_sign_translator.output.spelling import DIGITS, letters
from teo_sign_translator.output.translation import Kind, Origin, Token


@dataclass(frozen=True, slots=True, kw_only=True)
class Draft:
    """One output word.

    Attributes:
        signs: Its glosses: one, or the letters or digits of one word; none for a word that has no sign of its
            own.
        kind: Of all its signs.
        confidence: 0 to 1.
        words: Words of the text, as typed, that it stands for.
        origin: Where it comes from.
        is_name: Whether its one gloss is somebody's name, spelled unless it has a sign.
        said: What a word without a sign of its own says; spelled if nothing else of its sentence is signed.
    """

    signs: tuple[str, ...]
    kind: Kind
    confidence: float
    words: tuple[str, ...]
    origin: Origin
    is_name: bool = False
    said: str = ""


#: Hands held still between two clauses.
PAUSE = Draft(signs=("",), kind=Kind.PAUSE, confidence=1.0, words=(), origin=Origin.PAUSE)


def carried(word: str, typed: tuple[str, ...]) -> Draft:
    """A word that goes with the next draft that is signed."""
    return Draft(signs=(), kind=Kind.LEXICAL, confidence=1.0, words=typed, origin=Origin.WORD_LIST, said=word)


def spelled(word: str, typed: tuple[str, ...], confidence: float) -> list[Draft]:
    """A word in letters of the manual alphabet; digits in it ("UC3M") as numbers.

    Args:
        word: What is spelled.
        typed: Words of the text that it stands for.
        confidence: 0 to 1.
    """
    result: list[Draft] = []
    for is_number, run in groupby(word, key=lambda character: character in DIGITS):
        text = "".join(run)
        signs = tuple(text) if is_number else letters(text)
        if signs:
            kind = Kind.NUMBER if is_number else Kind.LETTER
            result.append(
                Draft(signs=signs, kind=kind, confidence=confidence, words=typed, origin=Origin.SPELLED)
            )
    return result


def name(gloss: str, typed: tuple[str, ...], confidence: float) -> Draft:
    """Somebody's name; its letters if it has no sign."""
    return Draft(
        signs=(gloss,),
        kind=Kind.LEXICAL,
        confidence=confidence,
        words=typed,
        origin=Origin.MODEL,
        is_name=True,
    )


def hand_over(drafts: Sequence[Draft], confidence: float) -> list[Draft]:
    """Give the words of drafts without signs to the next one that is signed, or to the last.

    Args:
        drafts: Of one sentence. If none of them is signed, their words are spelled.
        confidence: Of words that are spelled for that reason.
    """
    if not any(draft.signs and draft.kind is not Kind.PAUSE for draft in drafts):
        return [each for draft in drafts for each in spelled(draft.said, draft.words, confidence)]
    result: list[Draft] = []
    waiting: list[str] = []
    for draft in drafts:
        if not draft.signs:
            waiting += draft.words
        elif draft.kind is Kind.PAUSE:
            # One pause between two words, none at the ends, however many marks were typed.
            if result and result[-1].kind is not Kind.PAUSE:
                result.append(draft)
        else:
            result.append(replace(draft, words=(*waiting, *draft.words)))
            waiting = []
    if result[-1].kind is Kind.PAUSE:
        result.pop()
    result[-1] = replace(result[-1], words=(*result[-1].words, *waiting))
    return result


def number_tokens(drafts: Iterable[Draft]) -> tuple[Token, ...]:
    """Turn drafts into tokens, counting the output words."""
    return tuple(
        Token(
            gloss=sign,
            kind=draft.kind,
            confidence=draft.confidence,
            word_index=index,
            source_words=draft.words,
            origin=draft.origin,
        )
        for index, draft in enumerate(drafts)
        for sign in draft.signs
    )


def divide(drafts: Sequence[Draft], most: int) -> list[list[Draft]]:
    """Divide drafts into parts of at most `most` signs, between words unless one word is longer than that."""
    parts: list[list[Draft]] = [[]]
    room = most
    for draft in drafts:
        rest = draft
        while len(rest.signs) > room:
            if room == most or (len(rest.signs) > most and room > 0):
                parts[-1].append(replace(rest, signs=rest.signs[:room]))
                rest = replace(rest, signs=rest.signs[room:])
            parts.append([])
            room = most
        parts[-1].append(rest)
        room -= len(rest.signs)
    return parts
