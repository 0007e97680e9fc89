# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What "not" denies: one thing of two, and nothing again that "never" has denied already."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from teo_sign_translator.pipeline.completeness import CompleteTranslation, own_places, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.text.source_word import TELLING, SourceWord, clause_end

#: What begins the name of who is left out, and what is done by all.
_NAMED = ("DET:def", "DET:poss", "NAME", "PRON", "PREP")


class Denials:
    """Reads what a language denies."""

    def __init__(self, language: PipelineWords) -> None:
        """Take how a language denies, and says "only"."""
        self._said, self._only = language.denials, language.counts.only

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which "not" denies what is denied alone, and once.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        said = self._with_each_denial(words, self._with_one_denial(words, said))
        said = self._with_more(words, said)
        said = self._with_opposite(words, said)
        return self._with_exception(words, said)

    def _with_exception(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with who is left out of all behind them, and denied: "todos menos Luis aprobaron"."""
        for place in range(1, len(words) - 1):
            apart = words[place].form in self._said.apart and words[place + 1].tag.startswith(_NAMED)
            if not apart or not any(word.readings[0].lemma in self._said.all for word in words[:place]):
                continue
            behind = range(place + 1, len(words))
            ending = (at for at in behind if words[at].tag.startswith(TELLING) or words[at].is_mark)
            stop = next(ending, len(words))
            left = [own_places(words, gloss) for gloss in said.glosses]
            out = [at for at, own in enumerate(left) if own and own <= {*range(place + 1, stop)}]
            lead = [at for at, own in enumerate(left) if at not in out and own != {place}]
            negatives = {self._said.negation, *self._said.negatives}
            denied = any(gloss.gloss in negatives for gloss in said.glosses)
            if out and lead and not denied:
                kept = said.in_order([*lead, *out])
                return kept.with_glosses(len(kept.glosses), read_gloss(self._said.negation, place))
        return said

    def _with_one_denial(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same without "not" beside "never" or "nobody", which denies alone: "no friega nunca"."""
        denied = [at for at, gloss in enumerate(said.glosses) if gloss.gloss == self._said.negation]
        again = [at for at, gloss in enumerate(said.glosses) if gloss.gloss in self._said.negatives]
        no = [place for place, word in enumerate(words) if word.form == self._said.denying]
        if not len(denied) == len(again) == len(no) == 1 or said.glosses[denied[0]].sources != tuple(no):
            return said
        negative = said.glosses[again[0]]
        if max(negative.sources, default=-1) >= clause_end(words, no[0]):  # "no funciona y nadie sabe"
            return said
        glosses = list(said.glosses)
        glosses[again[0]] = replace(negative, sources=tuple(sorted({*negative.sources, *no})))
        return replace(said, glosses=tuple(glosses)).without(denied)

    def _with_each_denial(
        self, words: Sequence[SourceWord], said: CompleteTranslation
    ) -> CompleteTranslation:
        """The same with "not" in one clause beside "nobody" of the next: "no funciona y nadie lo sabe"."""
        names = [gloss.gloss for gloss in said.glosses]
        negatives = {
            at for gloss in said.glosses if gloss.gloss in self._said.negatives for at in gloss.sources
        }
        if self._said.negation in names or not negatives:
            return said
        for place, word in enumerate(words[:-1]):
            stop = clause_end(words, place)
            verb = next((at for at in range(place, stop) if words[at].tag.startswith(TELLING)), -1)
            if word.form != self._said.denying or verb < 0 or max(negatives) < stop:
                continue
            own = [at for at, gloss in enumerate(said.glosses) if verb in own_places(words, gloss)]
            if own:
                return said.with_glosses(own[-1] + 1, read_gloss(self._said.negation, place))
        return said

    def _with_more(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same without "not only", where something else follows: "no solo canta, también baila"."""
        for place, (word, only) in enumerate(pairwise(words)):
            follows = any(each.form in self._said.too for each in words[place + 2 :])
            if word.form != self._said.denying or only.form not in self._only or not follows:
                continue
            said_by = [own_places(words, gloss) for gloss in said.glosses]
            return said.without(
                [
                    at
                    for at, own in enumerate(said_by)
                    if own <= {place, place + 1} or said.glosses[at].gloss == self._said.but
                ]
            )
        return said

    def _with_opposite(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "not" behind what is denied alone: "no quiero café, sino té" is CAFÉ NO TÉ QUERER."""
        rather = next((place for place, word in enumerate(words) if word.form == self._said.rather), -1)
        kept = said.without([at for at, gloss in enumerate(said.glosses) if gloss.gloss == self._said.but])
        denied = [at for at, gloss in enumerate(kept.glosses) if gloss.gloss == self._said.negation]
        behind = (at for at, gloss in enumerate(kept.glosses) if max(gloss.sources, default=-1) > rather)
        opposite = next(behind, -1)
        if rather < 0 or not denied or opposite < 0:
            return said
        sources = {*kept.glosses[denied[-1]].sources, rather}
        negation = replace(kept.glosses[denied[-1]], sources=tuple(sorted(sources)))
        return kept.without(denied[-1:]).with_glosses(min(denied[-1], opposite), negation)
