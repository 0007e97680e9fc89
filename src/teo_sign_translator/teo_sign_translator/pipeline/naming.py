# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What somebody is called: "se llama Ana" is NOMBRE and the name, wherever it stands in a sentence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from teo_sign_translator.pipeline.completeness import CompleteTranslation, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_word import CLITICS, NOUNS, OBJECT, SourceWord


class Naming:
    """Reads what somebody is called."""

    def __init__(self, language: PipelineWords, topics: Topics, name: str) -> None:
        """Take how a language calls and points at persons, who may do things, and its gloss of "name"."""
        self._calling, self._pointing = language.subjects.calling, language.subjects.pointing
        self._topics, self._name = topics, name

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which the sign for "name" stands before a name.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        for verb in range(1, len(words) - 1):
            name, pronoun = words[verb + 1], words[verb - 1].tag
            calls = words[verb].readings[0].lemma in self._calling and pronoun.startswith(CLITICS)
            if not calls or not name.capital or not name.tag.startswith(NOUNS):
                continue
            says = {self._name, copied_gloss(words[verb].readings[0])}
            behind = [gloss.gloss not in says and verb + 1 in gloss.sources for gloss in said.glosses]
            calling = [gloss.gloss in says and verb in gloss.sources for gloss in said.glosses]
            if not any(behind) or not any(calling):
                continue
            if pronoun in ("PRON:refl", f"{OBJECT}{words[verb].person}"):
                said = self._named(said, calling.index(True), behind.index(True))
            elif not any(self._topics.may_act(words, at) for at in range(verb)):
                said = self._called(words, said, verb, (calling.index(True), behind.index(True)))
        return said

    def _named(self, said: CompleteTranslation, calling: int, name: int) -> CompleteTranslation:
        """The same with the sign for "name" before the name: "la niña que vive arriba se llama Ana"."""
        naming = replace(said.glosses[calling], gloss=self._name)
        return said.without([calling]).with_glosses(name - (calling < name), naming)

    def _called(
        self, words: Sequence[SourceWord], said: CompleteTranslation, verb: int, places: tuple[int, int]
    ) -> CompleteTranslation:
        """The same with who calls before whom: "ayer me llamó Ana" is never MI NOMBRE ANA."""
        calling, name = (said.glosses[at] for at in places)
        whom = self._pointing.get(words[verb - 1].tag.removeprefix(OBJECT), "")
        if calling.gloss != self._name or not whom:
            return said
        pronoun = {verb - 1}
        spoken = (
            at for at, gloss in enumerate(said.glosses) if pronoun <= {*gloss.sources} <= {*pronoun, verb}
        )
        own = {*spoken, *places}
        call = replace(calling, gloss=copied_gloss(words[verb].readings[0]))
        return said.without(own).with_glosses(min(own), name, read_gloss(whom, verb - 1), call)
