# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which words of a sentence its glosses say, and which are lost."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_common.text_folding import fold
from teo_sign_translator.data_files import data_file, read_listed
from teo_sign_translator.morphology import TAGS, Reading
from teo_sign_translator.pipeline.language_words import CoverageWords, PipelineWords
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_words import SourceWord

_ANY = "*"


class FunctionWords:
    """Tells function words from words with a meaning of their own."""

    def __init__(self, lemmas: dict[str, frozenset[str]]) -> None:
        """Take lemmas by the beginning of the tag that they must have; `*` among them stands for all."""
        self._lemmas = dict(lemmas)
        self._by_tag: dict[str, frozenset[str]] = {}

    @classmethod
    def load(cls, path: Path | None = None) -> FunctionWords:
        """Read the list.

        Args:
            path: The file; by default the package's `text/function_words.tsv`, which explains its columns.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        path = path or data_file("function_words.tsv")
        return cls(
            read_listed(
                path, lambda tag: any(_begins(known, tag) for known in TAGS), "the beginning of a tag"
            )
        )

    def may_be_left_out(self, word: SourceWord) -> bool:
        """Whether one of a word's readings is a function word, or it is a mark.

        Who types accents means them: "quién" is not "quien"; "esta" may be "está".
        """
        plain = word.form == fold(word.form)
        return word.is_mark or any(self.lists(reading) for reading in word.readings if plain or reading.exact)

    def lists(self, reading: Reading) -> bool:
        """Whether this reading is that of a function word."""
        found = self._by_tag.get(reading.tag)
        if found is None:
            listed = [lemmas for tag, lemmas in self._lemmas.items() if _begins(reading.tag, tag)]
            found = self._by_tag[reading.tag] = frozenset[str]().union(*listed)
        return _ANY in found or reading.lemma in found


@dataclass(frozen=True, slots=True)
class Coverage:
    """Finds lost words.

    Attributes:
        function_words: What may be left out.
        gloss_words: For each gloss the lemmas that it says though they are not its own.
        words: Of the language.
    """

    function_words: FunctionWords
    gloss_words: Mapping[str, frozenset[str]]
    words: CoverageWords

    @classmethod
    def load(cls, folder: Path | None = None) -> Coverage:
        """With a language's `function_words.tsv` and `gloss_words.tsv`.

        Args:
            folder: The language's text folder; by default that of the default language.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        folder = folder or data_file("")
        return cls(
            FunctionWords.load(folder / "function_words.tsv"),
            read_gloss_words(folder / "gloss_words.tsv"),
            PipelineWords.load(folder).coverage,
        )

    def lost(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> list[int]:
        """Places of the words that must not be left out and that no gloss says."""
        said = {place for places in self.said(words, glosses) for place in places}
        exclaims = bool(words) and words[-1].form == "!"
        return [
            place
            for place, word in enumerate(words)
            if place not in said
            and not self._may_be_left_out(words, place)
            and not self._says_only_the_future(words, place)
            and not (exclaims and word.readings[0].tag.startswith("WH"))  # "¡Qué bonito!" asks nothing
        ]

    def _may_be_left_out(self, words: Sequence[SourceWord], place: int) -> bool:
        """Whether a word has no meaning of its own; "hacer" has, unless what one does follows it."""
        if not self.function_words.may_be_left_out(words[place]):
            return False
        does = any(
            reading.tag == "V:inf" and reading.lemma == self.words.does for reading in words[place].readings
        )
        return not does or not all(map(self.function_words.may_be_left_out, words[place + 1 :]))

    def said(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> list[list[int]]:
        """For each gloss the places of the words that it says.

        A gloss says one word that has it as its dictionary form, and those that the list names; of several
        those that it stands for and that no gloss before it says, and their neighbours ("qué tal"); NADA the
        "no" before it, as Spanish says both; LENGUA_DE_SIGNOS all that are listed. What else the model has
        looked at is not said by it.
        """
        result: list[list[int]] = []
        taken: set[int] = set()
        own_places, lemma_places = _places(words)
        for gloss in glosses:
            own = sorted(
                own_places.get(gloss.gloss, ()),
                key=lambda place: (
                    place in taken,
                    place not in gloss.sources,
                    self._says_only_the_future(words, place),
                ),
            )
            lemmas = self.gloss_words.get(gloss.gloss, frozenset())
            listed = sorted({place for lemma in lemmas for place in lemma_places.get(lemma, ())})
            meant = {place for place in listed if place in gloss.sources or "_" in gloss.gloss}
            meant |= {place for place in listed if meant & {place - 1, place + 1}}
            meant |= {
                place for place in listed if own and place < own[0] and words[place].form == self.words.denial
            }
            result.append([*own[:1], *(sorted(meant) or ([] if own else listed))])
            taken.update(own[:1])
        return result

    def _says_only_the_future(self, words: Sequence[SourceWord], place: int) -> bool:
        """Whether a word is "voy" of "voy a comer", which a word of time may replace."""
        following = words[place + 1 : place + 3]
        return (
            any(reading.lemma == self.words.goes for reading in words[place].readings)
            and len(following) == 2
            and following[0].form == self.words.goes_to
            and any(reading.tag == "V:inf" for reading in following[1].readings)
        )


def read_gloss_words(path: Path | None = None) -> dict[str, frozenset[str]]:
    """For each gloss the lemmas that it says though they are not its own.

    Args:
        path: The file; by default the package's `text/gloss_words.tsv`, which explains its columns.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    path = path or data_file("gloss_words.tsv")
    return read_listed(path, lambda gloss: gloss == gloss.upper(), "a gloss in capitals")


def _places(words: Sequence[SourceWord]) -> tuple[dict[str, list[int]], dict[str, list[int]]]:
    """Places of words by the glosses that they would be copied as, and by their lemmas."""
    by_gloss: dict[str, list[int]] = defaultdict(list)
    by_lemma: dict[str, list[int]] = defaultdict(list)
    for place, word in enumerate(words):
        if not word.is_mark:
            for lemma in {reading.lemma for reading in word.readings}:
                by_lemma[lemma].append(place)
            for gloss in {copied_gloss(reading) for reading in word.readings}:
                by_gloss[gloss].append(place)
    return by_gloss, by_lemma


def _begins(tag: str, beginning: str) -> bool:
    return tag == beginning or tag.startswith(f"{beginning}:")
