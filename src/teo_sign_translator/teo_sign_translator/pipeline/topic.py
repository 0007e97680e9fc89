# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who a text goes on about, so that he is not pointed at in each of its sentences.

Spanish says the subject in the verb's ending each time; signers leave out who is known from the sentence
before (in the LSE-RADIS narratives 55 of 330 sentences are a verb alone).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.morphology.lexicon import nouns
from teo_sign_translator.pipeline.completeness import PipelineWords
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.source_words import SourceWord

#: Classes of nouns that may do what a verb says, so that they could be taken for its subject.
_DOERS = frozenset({"person", "family", "profession", "animal", "group"})
_PERSONS = ("PRON", "NAME")


class Topics:
    """What a language needs to know of who does things."""

    def __init__(self, folder: Path) -> None:
        """Read a language's text folder.

        Raises:
            TranslationError: "invalid_data" naming file and field.
        """
        self.subjects = frozenset(map(gloss_name, PipelineWords.load(folder).persons.subjects))
        self._doers = frozenset(noun.lemma for noun in nouns(folder) if not _DOERS.isdisjoint(noun.classes))

    def may_do(self, word: SourceWord) -> bool:
        """Whether a word names or points at somebody."""
        return any(
            reading.tag.startswith(_PERSONS)
            or (reading.tag.startswith("N:") and reading.lemma in self._doers)
            for reading in word.readings
        )


class Topic:
    """Whom the sentences of one text are about, as far as they have been read."""

    def __init__(self, topics: Topics) -> None:
        """Begin a text."""
        self._topics = topics
        self._subject = ""

    def unsaid(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> int | None:
        """The place of the gloss that the sentence before has said already, if one need not be said again.

        It is the only person of both sentences, no one asks, and only the verb's ending says it here: who is
        typed ("yo pago") is meant to be seen.

        Args:
            words: Of the next sentence.
            glosses: Its translation.
        """
        before, self._subject = self._subject, ""
        said = [place for place, gloss in enumerate(glosses) if gloss.gloss in self._topics.subjects]
        typed = {place for place, word in enumerate(words) if self._topics.may_do(word)}
        if len(said) != 1 or any(word.form == "?" for word in words):
            return None
        subject = glosses[said[0]]
        if not typed.issubset(subject.sources):
            return None
        self._subject = subject.gloss
        return said[0] if not typed and subject.gloss == before and len(glosses) > 1 else None
