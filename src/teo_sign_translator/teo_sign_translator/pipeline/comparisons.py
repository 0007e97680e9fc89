# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is compared with what: each by its noun, and what is liked less behind what is liked.

LSE names both and then the quality (X Y SUP, in the notation of the LSE-UVIGO corpus: X Y MÁS ALTO). A
pronoun that Spanish puts in place of the second noun, "el nuestro", would be read as the owner of the first.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from teo_sign_translator.pipeline.completeness import CompleteTranslation, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_word import SourceWord, clause_end

#: How many words before "que" may stand what compares: "más gente que", but "dice que ayer" compares nothing.
_NEAR = 3
_PRESENT = re.compile(r"V:ind:pres:.*")
_POSSESSIVES = ("DET:poss", "PRON:poss")


class Comparisons:
    """Reads what a language compares."""

    def __init__(self, language: PipelineWords, topics: Topics) -> None:
        """Take how a language compares and denies, and what are times."""
        self._topics = topics
        self._said = language.comparisons
        self._negation = language.denials.negation
        self._towards = language.persons.towards

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which both are named, and the one that is liked less is denied.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        return self._with_less_liked(words, self._with_now(words, self._with_compared(words, said)))

    def _with_now(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "now" behind the time it is compared with: "hay más gente que ayer"."""
        for than in range(1, len(words) - 1):
            behind = clause_end(words, than + 1)
            time = [at for at in range(than + 1, behind) if self._topics.is_time(words[at])]
            present = any(_PRESENT.fullmatch(word.tag) for word in words[:than])
            told = any(self._topics.is_time(word) for word in words[:than])
            compares = any(word.form in self._said.degrees for word in words[max(0, than - _NEAR) : than])
            if words[than].form != self._said.than or not compares or not time or told or not present:
                continue
            own = [at for at, gloss in enumerate(said.glosses) if min(gloss.sources, default=-1) > than]
            rest = [gloss.gloss for gloss in said.glosses[len(own) :]]
            if own and own == list(range(len(own))) and rest[:1] != [self._said.now]:
                return said.with_glosses(len(own), read_gloss(self._said.now, than))
        return said

    def _with_compared(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with what is compared named twice: "que el nuestro", "que las de ayer"."""
        for than in range(1, len(words) - 2):
            article, other = words[than + 1].tag, words[than + 2]
            before = other.readings[0].lemma in self._said.before
            belongs = before or other.form == self._said.of or other.tag.startswith(_POSSESSIVES)
            compares = words[than].form == self._said.than and article.startswith("DET:def") and belongs
            if not compares or any(gloss.sources == (than,) for gloss in said.glosses):
                continue
            noun = next((at for at in range(than) if words[at].tag.startswith("N:")), -1)
            own = (each.gloss for each in said.glosses if noun in each.sources and _names(words[noun], each))
            behind = (at for at, each in enumerate(said.glosses) if min(each.sources, default=0) > than)
            name, place = next(own, ""), next(behind, -1)
            if name and place >= 0:
                at = place + 1 if before else place  # PASADO SEMANA, but COCHE TU
                return said.with_glosses(at, read_gloss(name, than + 1))
        return said

    def _with_less_liked(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "not" behind what is liked less: PREFERIR LEER SALIR NO."""
        liking = [at for at, word in enumerate(words) if word.readings[0].lemma in self._said.preferring]
        than = self._than(words, liking[0]) if liking and words[-1].form != "?" else 0
        said_behind = ({*gloss.sources} - {*liking} for gloss in said.glosses)
        less = [at for at, sources in enumerate(said_behind) if sources and min(sources) > than]
        if not than or not less or len(less) == len(said.glosses):
            return said
        order = [*(at for at in range(len(said.glosses)) if at not in less), *less]
        return said.in_order(order).with_glosses(len(order), read_gloss(self._negation, than))

    def _than(self, words: Sequence[SourceWord], liking: int) -> int:
        """Place of the word before what is liked less: "leer que salir", "el té al café"; 0 for none."""
        than = next((at for at, word in enumerate(words) if word.form == self._said.than), 0)
        if than > liking + 1:
            return than
        if than or liking + 2 >= len(words):
            return 0
        if words[liking + 1].tag.startswith("V:inf"):  # "quedarme en casa a salir", but "ir a casa a comer"
            rest = range(liking + 3, len(words) - 1)
            to = next(
                (at for at in rest if words[at].form in self._towards and words[at + 1].tag == "V:inf"), 0
            )
            goes = words[liking + 1].readings[0].lemma in self._said.going
            return to if not goes or words[to - 1].tag.startswith("V:ger") else 0
        if not words[liking + 1].tag.startswith("DET"):
            return 0
        behind = (at for at in range(liking + 2, len(words)) if words[at].form in self._towards)
        to = next(behind, 0)
        between = [word.tag for word in words[liking + 2 : to]]
        return to if to and all(tag.startswith(("N:", "A:")) for tag in between) else 0


def _names(noun: SourceWord, gloss: OutputGloss) -> bool:
    """Whether a gloss is that of a noun."""
    return gloss.copied or gloss.gloss == copied_gloss(noun.readings[0])
