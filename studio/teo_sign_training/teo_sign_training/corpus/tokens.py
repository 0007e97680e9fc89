# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words and glosses while a sentence is made; which gloss stands for which word is kept from the start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from teo_sign_training.corpus.grammar import Shape
from teo_sign_training.corpus.words import ListedWord


@dataclass(slots=True, eq=False)
class SaidWord:
    """A word or mark.

    Attributes:
        text: As written inside a sentence.
        article: Whether it is a feminine singular that "el agua" changes.
    """

    text: str
    article: bool = False


@dataclass(slots=True, eq=False)
class Sign:
    """A gloss.

    Attributes:
        gloss: Upper case.
        sources: The words that it stands for.
        pending: What else will say it, once that is known: `patterns.VERB` or `CLITIC`.
        leads: Whether it governs an infinitive and stands at the front of its predicate.
    """

    gloss: str
    sources: list[SaidWord] = field(default_factory=list)
    pending: str = ""
    leads: bool = False


class VerbPhrase(NamedTuple):
    """A verb as said.

    Attributes:
        tokens: Words in order, clitics among them.
        finite: The word that shows person and tense.
        main: The word of the main verb.
        clitics: For each clitic, in the order given, the word that says it.
        parts: Words of auxiliaries and literals by lemma.
    """

    tokens: list[SaidWord]
    finite: SaidWord
    main: SaidWord
    clitics: list[SaidWord]
    parts: dict[str, SaidWord]


@dataclass(slots=True, eq=False)
class Phrase:
    """A part of a sentence in both languages.

    Attributes:
        features: Person, number, gender and the like.
        tokens: Words and marks.
        signs: Glosses.
        head: The word that stands for the whole.
        verb: Its first verb, which shows the tense.
    """

    features: dict[str, str]
    tokens: list[SaidWord]
    signs: list[Sign]
    head: SaidWord | None = None
    verb: SaidVerb | None = None

    def say(self, pending: str, token: SaidWord) -> None:
        """Make a word a source of the signs that are pending for it."""
        for sign in self.signs:
            if sign.pending == pending:
                sign.sources.append(token)
                sign.pending = ""

    def leave_out(self, pending: str) -> None:
        """Take away the signs that are pending for a word: another sign shows what they say."""
        self.signs = [sign for sign in self.signs if sign.pending != pending]


@dataclass(slots=True, eq=False)
class SaidVerb:
    """A verb that is chosen first and said when its place in the sentence comes.

    Attributes:
        word: The verb.
        shape: Its tense and auxiliaries.
        said: What it has become.
    """

    word: ListedWord
    shape: Shape
    said: VerbPhrase | None = None


def looked_up(value: str, features: Mapping[str, str], slots: Mapping[str, Phrase]) -> str:
    """A value as written, or the feature it names: `$V.object` of slot V, `$pol` handed down; "" for none."""
    if not value.startswith("$"):
        return value
    name, dot, key = value[1:].partition(".")
    return slots[name].features.get(key, "") if dot else features.get(name, "")
