# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What `language.yaml` holds, checked while it is read."""

from __future__ import annotations

import unicodedata
from pathlib import Path
from typing import Annotated, Literal

import msgspec

from teo_common.checked_content import YamlError, read_checked_yaml
from teo_common.errors import CodedError
from teo_common.text_folding import without_accents


class LanguageError(CodedError):
    """A language that is not there ("unknown_language") or cannot be used ("invalid_language")."""


HeadMove = Literal["forward", "back", "nod", "shake"]
Gloss = Annotated[str, msgspec.Meta(min_length=1)]


class HeadGrammar(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Which way the head moves over which signs of a sentence; not at all where nothing is said.

    Attributes:
        yes_no_question: Over a whole yes/no question.
        wh_question: Over the question words of a question; over all of it where it has none.
        exclamation: At the last sign of an exclamation that is not negated.
        negation: Over each negative sign and its neighbour; over the whole sentence where it has none.
        negated_neighbour: The sign that a negative sign negates: the one before it or the one after.
        question_words: Glosses that ask, as signs or, without accents, spelled; also as a part of a gloss
            (POR_QUÉ asks as QUÉ does).
        negative_signs: Glosses without accents that negate; also as a part of a gloss (NO_HAY).
        not_negative: Glosses without accents that hold a negative one and do not negate.
    """

    yes_no_question: HeadMove | None = None
    wh_question: HeadMove | None = None
    exclamation: HeadMove | None = None
    negation: HeadMove | None = None
    negated_neighbour: Literal["before", "after"] = "before"
    question_words: list[Gloss] = []
    negative_signs: list[Gloss] = []
    not_negative: list[Gloss] = []

    def asks(self, gloss: str, *, spelled: bool) -> bool:
        """Whether a gloss is a question word; CUÁNDO is one, CUANDO is none, and letters have no accents."""
        asking = [without_accents(word) for word in self.question_words] if spelled else self.question_words
        return not set(asking).isdisjoint(gloss.split("_"))

    def negates(self, gloss: str) -> bool:
        """Whether a gloss is a negative sign."""
        plain = without_accents(gloss)
        return plain not in self.not_negative and not set(self.negative_signs).isdisjoint(plain.split("_"))


#: Name of the file that makes a folder a language.
FILE = "language.yaml"

Code = Annotated[str, msgspec.Meta(pattern=r"^[a-z]{3}$")]
Text = Annotated[str, msgspec.Meta(min_length=1)]
# Subtags of letters and digits (RFC 5646, section 2.1), of which the first is the language.
Bcp47 = Annotated[str, msgspec.Meta(pattern=r"^[A-Za-z]{2,8}(-[A-Za-z0-9]{1,8})*$")]

Finger = Literal["index", "middle", "ring", "little"]
# 0 is straight; no robot's finger bends farther at one axis than a right angle.
Flexion = Annotated[float, msgspec.Meta(ge=0.0, le=90.0)]


class Names(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Names of a sign language.

    Attributes:
        en: In English: "Spanish Sign Language".
        own: In its country's spoken language: "lengua de signos española".
        short: What its signers call it: "LSE".
    """

    en: Text
    own: Text
    short: Text


class Spoken(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The language whose texts are translated.

    Attributes:
        code: Its BCP 47 tag: "es".
        name: In English: "Spanish".
    """

    code: Bcp47
    name: Text


class LetterClips(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Recordings of the letters, in the fingerspelling lexicon of the package `spoken-to-signed`.

    Attributes:
        collection: `signed_language` of their rows in its index: "ssp".
        place: Letters whose mean place in the recordings is put where a robot spells; all if empty.
        begins_as: Letters whose hand the recording shows too late, and the letter that they begin as.
        same_palm: Letters that a robot turns as another one where their own palm is out of its reach.
        same_thumb: Letters of the same hand as another one, whose thumb is fitted to that one's recording.
    """

    collection: Code
    place: list[Text] = []
    begins_as: dict[Text, Text] = {}
    same_palm: dict[Text, Text] = {}
    same_thumb: dict[Text, Text] = {}


class Alphabet(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The manual alphabet. A word is spelled in capitals, the longest letter first: "CH" before "C".

    Attributes:
        letters: Glosses of the letters' signs, in the alphabet's order; each spells the text that it is.
            Other letters lose their accents first.
        transcriptions: Capitals that are no letter with an accent, and the text that is spelled for each.
        frequencies: How often each letter is spelled, in shares of any unit; all alike if empty.
        clips: Recordings of the letters; None if there are none.
        flexions: Bends of single fingers [deg] where a robot's cannot do what a person's do: by robot,
            letter and finger.
        notes: What must be said of a robot's letters beside their numbers, by robot and letter.
    """

    letters: Annotated[list[Text], msgspec.Meta(min_length=1)]
    transcriptions: dict[Text, Text] = {}
    frequencies: dict[Text, Annotated[int, msgspec.Meta(ge=1)]] = {}
    clips: LetterClips | None = None
    flexions: dict[Text, dict[Text, dict[Finger, Flexion]]] = {}
    notes: dict[Text, dict[Text, Text]] = {}

    def __post_init__(self) -> None:
        """Refuse letters that could never be found."""
        for letter in self.letters:
            if letter != unicodedata.normalize("NFC", letter.upper()):
                raise ValueError(f"expected capitals in NFC, got {letter!r}")
        if len(set(self.letters)) < len(self.letters):
            raise ValueError("expected each letter once")
        for character, spelled in self.transcriptions.items():
            if len(character) != 1 or not set(spelled) <= set("".join(self.letters)):
                raise ValueError(
                    f"expected one character and letters of the alphabet, got {character!r}: {spelled!r}"
                )
        named = set(self.frequencies)
        named |= {letter for letters in self.flexions.values() for letter in letters}
        named |= {letter for letters in self.notes.values() for letter in letters}
        if self.clips is not None:
            pairs = (self.clips.begins_as, self.clips.same_palm, self.clips.same_thumb)
            named |= {
                *self.clips.place,
                *(letter for pair in pairs for both in pair.items() for letter in both),
            }
        unknown = sorted(named - set(self.letters))
        if unknown:
            raise ValueError(f"expected letters of the alphabet, got {', '.join(unknown)}")
        if self.frequencies and len(self.frequencies) < len(self.letters):
            raise ValueError("expected frequencies of all letters, or of none")


class Numbers(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How a number that has no sign of its own is put together: 352 is three hundreds, 5 and 2.

    Attributes:
        hundred: Gloss that stands behind how many hundreds; without one, they are read out digit by digit.
        thousand: The same of thousands.
        one_before: Whether a single hundred or thousand has its 1 before it, too.
    """

    hundred: str = ""
    thousand: str = ""
    one_before: bool = False


class LanguageFile(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A sign language as its file describes it.

    Attributes:
        code: ISO 639-3 code of the sign language: "ssp". Messages and tables carry it.
        bcp47: Its BCP 47 tag.
        formerly: Other names under which it may be asked for.
        names: Of the language.
        spoken: The language of the texts.
        alphabet: The manual alphabet.
        numbers: How numbers without a sign are put together.
        head: What the head says.
        sentences: Texts that try the language out: demonstrations and tests sign them.
    """

    code: Code
    bcp47: Bcp47
    formerly: list[Code] = []
    names: Names
    spoken: Spoken
    alphabet: Alphabet
    numbers: Numbers = Numbers()
    head: HeadGrammar = HeadGrammar()
    sentences: Annotated[list[Text], msgspec.Meta(min_length=1)]


def read_language_file(path: Path) -> LanguageFile:
    """Read and check a `language.yaml`.

    Raises:
        LanguageError: "invalid_language", with file and field.
    """
    try:
        return read_checked_yaml(path, LanguageFile)
    except YamlError as error:
        raise LanguageError("invalid_language", str(error)) from error
