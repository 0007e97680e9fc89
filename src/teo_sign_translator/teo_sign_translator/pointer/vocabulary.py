# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The vocabulary of a model: closed lists of the forms, lemmas, tags and glosses that it knows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from teo_common.text_folding import fold
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import MAX_READINGS, Reading, gloss_name
from teo_sign_translator.text.source_word import SourceWord

#: Readings of a word that a model looks at: all that there are.
READINGS = MAX_READINGS

#: First entries of the lists. ROOT stands before the sentence: what no word says is aligned with it. BLANK
#: stands behind it in the equal-length layout, where glosses that outnumber the words find room.
UNKNOWN, ROOT, BLANK = "<unknown>", "<root>", "<blank>"
#: Tag key of a word of which nothing is known; in every list of tags.
UNKNOWN_TAG = "X:guessed"
#: Place of "no reading" in the lists of lemmas and tags.
NONE = "<none>"
#: First glosses of every closed list of glosses.
END, START = "<end>", "<start>"
END_INDEX, START_INDEX = 0, 1

_FORMS = (UNKNOWN, ROOT, BLANK)
_LEMMAS = (NONE, UNKNOWN)
_TAGS = (NONE,)
_GLOSSES = (END, START)


class WordFeatures(NamedTuple):
    """What a model reads of one word, as places in the lists of its `Vocabulary`.

    Attributes:
        form: Of its folded form.
        capital: 1 if typed with a capital inside the sentence, else 0.
        lemmas: Of its readings' lemmas; `READINGS` of them, filled up with 0.
        tags: Of its readings' tag keys, likewise; -1 for a key that is not in the list.
        tag_keys: The readings' tag keys.
        copies: The readings' lemmas as glosses.
    """

    form: int
    capital: int
    lemmas: tuple[int, ...]
    tags: tuple[int, ...]
    tag_keys: tuple[str, ...]
    copies: tuple[str, ...]


def copied_gloss(reading: Reading) -> str:
    """The gloss that carries a reading over: its lemma in capitals, `_` for spaces."""
    return gloss_name(reading.lemma)


def tag_key(reading: Reading) -> str:
    """Tag, clitics and whether accents were guessed, e.g. `V:imp:2s:+me:+lo` or `WH:guessed`."""
    clitics = "".join(f":+{clitic}" for clitic in reading.clitics)
    return f"{reading.tag}{clitics}{'' if reading.exact else ':guessed'}"


def tag_parts(key: str) -> tuple[str, ...]:
    """The features that a tag key is made of; none for `NONE`."""
    return () if key == NONE else tuple(key.split(":"))


@dataclass(frozen=True)
class Vocabulary:
    """The closed lists of a model, each with its fixed first entries.

    Attributes:
        forms: Folded forms of words.
        lemmas: Lemmas of readings.
        tags: Tag keys; one that is missing is read by its parts alone.
        parts: Parts of tag keys.
        glosses: Glosses that the model can say without copying.
    """

    forms: tuple[str, ...]
    lemmas: tuple[str, ...]
    tags: tuple[str, ...]
    parts: tuple[str, ...]
    glosses: tuple[str, ...]

    @classmethod
    def of(
        cls, forms: Sequence[str], lemmas: Sequence[str], tags: Sequence[str], glosses: Sequence[str]
    ) -> Vocabulary:
        """Lists with the fixed entries first; the parts are those of the tags."""
        tags = list(dict.fromkeys((*tags, UNKNOWN_TAG)))
        parts = sorted({part for key in tags for part in tag_parts(key)})
        return cls(
            (*_FORMS, *forms), (*_LEMMAS, *lemmas), (*_TAGS, *tags), tuple(parts), (*_GLOSSES, *glosses)
        )

    @classmethod
    def from_dict(cls, lists: Mapping[str, Any]) -> Vocabulary:
        """The lists of a card.

        Raises:
            TranslationError: "invalid_model" if they are not what `as_dict` gives.
        """
        names = ("forms", "lemmas", "tags", "parts", "glosses")
        for name, first in zip(names, (_FORMS, _LEMMAS, _TAGS, (), _GLOSSES), strict=True):
            entries = lists.get(name)
            if (
                not isinstance(entries, list)
                or not all(isinstance(entry, str) for entry in entries)
                or len(set(entries)) != len(entries)
                or tuple(entries[: len(first)]) != first
            ):
                raise TranslationError(
                    "invalid_model", f"expected a list '{name}' of different words that begins with {first}"
                )
        return cls(**{name: tuple(lists[name]) for name in names})

    def as_dict(self) -> dict[str, list[str]]:
        """The lists by name, for a card."""
        return {name: list(getattr(self, name)) for name in ("forms", "lemmas", "tags", "parts", "glosses")}

    def features(self, word: SourceWord) -> WordFeatures:
        """The features of a word, also of one that no list has."""
        readings = word.readings[:READINGS]
        keys = tuple(map(tag_key, readings))
        room = (0,) * (READINGS - len(readings))
        unknown = _LEMMAS.index(UNKNOWN)
        return WordFeatures(
            form=self.form_index.get(fold(word.form), 0),
            capital=int(word.capital),
            lemmas=(*(self.lemma_index.get(reading.lemma, unknown) for reading in readings), *room),
            tags=(*(self.tag_index.get(key, -1) for key in keys), *room),
            tag_keys=keys,
            copies=tuple(map(copied_gloss, readings)),
        )

    @cached_property
    def form_index(self) -> dict[str, int]:
        """Places of the forms."""
        return {form: index for index, form in enumerate(self.forms)}

    @cached_property
    def lemma_index(self) -> dict[str, int]:
        """Places of the lemmas."""
        return {lemma: index for index, lemma in enumerate(self.lemmas)}

    @cached_property
    def tag_index(self) -> dict[str, int]:
        """Places of the tag keys."""
        return {tag: index for index, tag in enumerate(self.tags)}

    @cached_property
    def gloss_index(self) -> dict[str, int]:
        """Places of the glosses."""
        return {gloss: index for index, gloss in enumerate(self.glosses)}
