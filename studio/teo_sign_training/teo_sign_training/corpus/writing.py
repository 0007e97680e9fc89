# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a language writes words that meet, and from words to a written sentence.

Words that meet make contractions ("al"), other forms before certain sounds ("el agua"), and verbs with clitic
pronouns.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology.spanish import unaccented

#: Persons in the order of `Clitics.reflexive`.
_PERSONS = ("1s", "2s", "3s", "1p", "2p", "3p")
_LIST = "@"


@dataclass(slots=True, eq=False)
class SaidWord:
    """A word or mark.

    Attributes:
        text: As written inside a sentence.
        article: Whether it is a feminine singular that "el agua" changes.
    """

    text: str
    article: bool = False


@dataclass(frozen=True, slots=True)
class Meeting:
    """What becomes of a word before another one.

    Attributes:
        written: What is written in its place.
        before: Matches the whole next word, in lower case without accents, or is None.
        words: Next words before which it changes, if it is a feminine singular that agrees ("el agua").
    """

    written: str
    before: re.Pattern[str] | None
    words: frozenset[str]


@dataclass(frozen=True, slots=True)
class Clitics:
    """Pronouns that hang on a verb or stand beside it; all empty in a language without any.

    Attributes:
        reflexive: Of each person.
        ranks: Place of each in a row of them; those that are not listed come last.
        accusative: Of things just spoken of, which no sign says.
        dative: Singular and plural.
        beside_accusative: What a dative becomes beside an accusative of the third person.
        pronominal: Ending of the infinitives of verbs that take a reflexive pronoun, as lists write them.
    """

    reflexive: Mapping[str, str]
    ranks: Mapping[str, int]
    accusative: frozenset[str]
    dative: tuple[str, ...]
    beside_accusative: str
    pronominal: str

    def bare(self, lemma: str) -> tuple[str, bool]:
        """A verb's infinitive without its pronoun, and whether it has one."""
        has = bool(self.pronominal) and lemma.endswith(self.pronominal)
        return (lemma.removesuffix(self.pronominal), True) if has else (lemma, False)


@dataclass(frozen=True, slots=True)
class Writing:
    """All of it; the section `writing` of a grammar.

    Attributes:
        contractions: What two words in a row are written as.
        meetings: By the word that changes.
        clitics: Pronouns at verbs.
    """

    contractions: Mapping[tuple[str, str], str]
    meetings: Mapping[str, tuple[Meeting, ...]]
    clitics: Clitics


def parse_writing(section: Mapping[str, Mapping[str, str]], lists: Mapping[str, tuple[str, ...]]) -> Writing:
    """Parse the section: `contractions: {al: a el}`, `meetings: {u: o h?o}`, `clitics`.

    A meeting is the word that changes and a pattern of how the next one begins, or `@` and the name of one
    of the grammar's lists.

    Args:
        section: By name; what is missing is empty.
        lists: Of the grammar.

    Raises:
        TranslationError: "invalid_grammar" naming the entry.
    """
    contractions: dict[tuple[str, str], str] = {}
    for written, words in section.get("contractions", {}).items():
        if len(words.split()) != 2:
            raise _refused("contractions", written, "two words", words)
        first, second = words.split()
        contractions[first, second] = written
    meetings: dict[str, tuple[Meeting, ...]] = {}
    for written, rule in section.get("meetings", {}).items():
        word, _, before = rule.partition(" ")
        if before.startswith(_LIST) and before[1:] in lists:
            meeting = Meeting(written, None, frozenset(lists[before[1:]]))
        elif before and not before.startswith(_LIST):
            meeting = Meeting(written, re.compile(f"(?:{before}).*"), frozenset())
        else:
            raise _refused("meetings", written, "a word and a pattern or @list", rule)
        meetings[word] = (*meetings.get(word, ()), meeting)
    return Writing(contractions, meetings, _clitics(section.get("clitics", {})))


def _clitics(body: Mapping[str, str]) -> Clitics:
    reflexive = body.get("reflexive", "").split()
    if len(reflexive) not in (0, len(_PERSONS)):
        raise _refused("clitics", "reflexive", f"a pronoun for each of {_PERSONS}", body["reflexive"])
    ranks = {
        word: rank for rank, group in enumerate(body.get("order", "").split()) for word in group.split(",")
    }
    return Clitics(
        dict(zip(_PERSONS, reflexive, strict=False)),
        ranks,
        frozenset(body.get("accusative", "").split()),
        tuple(body.get("dative", "").split()),
        body.get("beside_accusative", ""),
        body.get("pronominal", ""),
    )


def _refused(section: str, name: str, expected: str, got: str) -> TranslationError:
    return TranslationError(
        "invalid_grammar", f"writing: {section}: {name}: expected {expected}, got '{got}'"
    )


_OPENING = ("¿", "¡")
_CLOSING = (",", ".", "?", "!", ":")
#: What begins so hangs on the word before it: Ana's.
_HANGING = "'"


def write(
    tokens: Sequence[SaidWord], writing: Writing, contracts: Callable[[str], bool | None]
) -> tuple[str, dict[int, int]]:
    """Write a sentence.

    Args:
        tokens: Words and marks.
        writing: How the language writes words that meet.
        contracts: Of a contraction that a reader takes apart again, whether it is written this time; None of
            one that stays one word and is always written.

    Returns:
        The text, and for the identity of each token its index among the words and marks that
        `source_words` finds in the text.
    """
    pieces: list[str] = []
    places: dict[int, int] = {}
    words = 0
    previous: SaidWord | None = None
    glued = True
    for position, token in enumerate(tokens):
        text = token.text
        if text in _OPENING:
            pieces.append(text if glued else " " + text)
            glued = True
            previous = None
            continue
        places[id(token)] = words
        words += 1
        if text in _CLOSING:
            pieces.append(text)
            glued = False
            previous = None
            continue
        following = tokens[position + 1].text if position + 1 < len(tokens) else ""
        text = _meeting(token, following, writing)
        contracted = writing.contractions.get((previous.text, text)) if previous else None
        written = contracts(contracted) if contracted else False
        if previous and contracted and written is not False:
            pieces[-1] = pieces[-1][: -len(previous.text)] + contracted
            if written is None:
                words -= 1
                places[id(token)] = words - 1
        else:
            pieces.append(text if glued or text.startswith(_HANGING) else " " + text)
        glued = False
        previous = None if written else token
    return _capitalised("".join(pieces)), places


def _meeting(token: SaidWord, following: str, writing: Writing) -> str:
    sound = unaccented(following.lower())
    for meeting in writing.meetings.get(token.text, ()):
        if meeting.before is not None and meeting.before.fullmatch(sound):
            return meeting.written
        if token.article and following in meeting.words:
            return meeting.written
    return token.text


def _capitalised(text: str) -> str:
    for place, letter in enumerate(text):
        if letter.isalnum():
            return text[:place] + letter.upper() + text[place + 1 :]
    return text
