# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Mends what a model says: a translation loses no word of its sentence and invents none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from teo_sign_translator.data_files import data_file
from teo_sign_translator.morphology import Reading
from teo_sign_translator.pipeline.coverage import Coverage
from teo_sign_translator.pipeline.gloss_evidence import GlossEvidence
from teo_sign_translator.pipeline.long_sentences import Piece
from teo_sign_translator.pointer import Hypothesis, OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_words import SourceWord

#: Of a gloss that was put back: its word is right, its place a guess.
REPAIRED_CONFIDENCE = 0.2

# Tags of words that LSE signs last.
_LAST = ("WH",)


@dataclass(frozen=True, slots=True)
class Repaired:
    """Glosses that leave no word out.

    Attributes:
        glosses: In signing order.
        repaired: For each whether the model had left its word out and it was put back.
        drafted: Whether they are a draft (`drafted`), not the model's.
    """

    glosses: tuple[OutputGloss, ...]
    repaired: tuple[bool, ...]
    drafted: bool = False


class Candidate(NamedTuple):
    """The best of a model's translations.

    Attributes:
        glosses: What it says; no gloss twice in a row where the sentence has one word for it.
        faults: Words that it loses and glosses that it invents.
    """

    glosses: tuple[OutputGloss, ...]
    faults: int


def as_said(glosses: tuple[OutputGloss, ...]) -> Repaired:
    """A translation as the model says it."""
    return Repaired(glosses, (False,) * len(glosses))


@dataclass(frozen=True, slots=True)
class HypothesisRepair:
    """Chooses among a model's translations, and mends the one it chooses: no word lost, no gloss invented.

    Attributes:
        coverage: Finds lost words.
        evidence: Finds invented glosses.
    """

    coverage: Coverage
    evidence: GlossEvidence

    @classmethod
    def load(cls, folder: Path | None = None) -> HypothesisRepair:
        """With a language's data.

        Args:
            folder: The language's text folder; by default that of the default language.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        folder = folder or data_file("")
        return cls(Coverage.load(folder), GlossEvidence.load(folder / "gloss_evidence.tsv", folder))

    def best(self, words: Sequence[SourceWord], hypotheses: Sequence[Hypothesis]) -> Candidate:
        """The first translation without a fault, else that with the fewest.

        Args:
            words: Of the sentence; one at least is no mark.
            hypotheses: Its translations, best first.
        """
        candidates: list[Candidate] = []
        for hypothesis in hypotheses:
            glosses = self._said_once(words, hypothesis.glosses)
            candidates.append(Candidate(glosses, self._faults(words, glosses)))
            if glosses and not candidates[-1].faults:
                return candidates[-1]
        return min(candidates, key=lambda candidate: candidate.faults)

    def repair(self, words: Sequence[SourceWord], hypotheses: Sequence[Hypothesis]) -> Repaired:
        """The best translation, mended; see `best` and `mend`."""
        return self.mend(words, self.best(words, hypotheses))

    def mend(self, words: Sequence[SourceWord], candidate: Candidate) -> Repaired:
        """A translation that loses no word and invents no gloss.

        What it invents is left out, a sign that nobody said misleads; what it loses is put back. A word put
        back stands beside the gloss of the nearest word that has one, a question word last. A sentence of
        nothing but function words has each of them signed, since it would be empty otherwise.

        Args:
            words: Of the sentence; one at least is no mark.
            candidate: The best of its translations.
        """
        best = candidate.glosses
        if best and not candidate.faults:
            return as_said(best)
        invented = self.evidence.invented(words, best)
        best = tuple(gloss for place, gloss in enumerate(best) if place not in invented)
        missing = {place: self._meant(words[place]) for place in self.coverage.lost(words, best)}
        if not best and not missing:
            missing = {place: word.readings[0] for place, word in enumerate(words) if not word.is_mark}
        glosses = list(best)
        repaired = [False] * len(best)
        for place, reading in missing.items():
            index = len(glosses)
            if not reading.tag.startswith(_LAST):
                index = self._beside(place, words, glosses)
            gloss = OutputGloss(copied_gloss(reading), (place,), REPAIRED_CONFIDENCE, copied=True)
            glosses.insert(index, gloss)
            repaired.insert(index, True)
        return Repaired(tuple(glosses), tuple(repaired))

    def join(self, words: Sequence[SourceWord], translated: Sequence[tuple[Piece, Repaired]]) -> Repaired:
        """The translation of a sentence from those of its pieces, one after the other.

        A conjunction that has a meaning of its own is signed between them, as far from certain as a word that
        was put back.

        Args:
            words: Of the whole sentence.
            translated: Its pieces in their order, each with its translation.
        """
        glosses: list[OutputGloss] = []
        repaired: list[bool] = []
        for piece, said in translated:
            joint = piece.joint
            if joint is not None and not self.coverage.function_words.may_be_left_out(words[joint]):
                gloss = copied_gloss(words[joint].readings[0])
                glosses.append(OutputGloss(gloss, (joint,), REPAIRED_CONFIDENCE, copied=True))
                repaired.append(False)
            glosses += (
                replace(each, sources=tuple(source + piece.start for source in each.sources))
                for each in said.glosses
            )
            repaired += said.repaired
        return Repaired(tuple(glosses), tuple(repaired))

    def _said_once(
        self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]
    ) -> tuple[OutputGloss, ...]:
        """Glosses without those said twice in a row for one word: no noun is doubled for its plural.

        Counted in LSE-RADIS: CERDO TRES, LOS-TRES, TODO and pointing say the plural.
        """
        result: list[OutputGloss] = []
        for gloss in glosses:
            again = (
                bool(result)
                and result[-1].gloss == gloss.gloss
                and not self.evidence.says_every(gloss, words)
            )
            if again and sum(_may_be(word, gloss.gloss) for word in words) <= 1:
                sources = tuple(sorted({*result[-1].sources, *gloss.sources}))
                result[-1] = replace(result[-1], sources=sources)
            else:
                result.append(gloss)
        return tuple(result)

    def _faults(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> int:
        return len(self.coverage.lost(words, glosses)) + len(self.evidence.invented(words, glosses))

    def _meant(self, word: SourceWord) -> Reading:
        """The likeliest reading of a word that was left out: a name where a capital says so."""
        names = (reading for reading in word.readings if word.capital and reading.tag.startswith("NAME"))
        others = (each for each in word.readings if not self.coverage.function_words.lists(each))
        return next(names, None) or next(others, None) or word.readings[0]

    def _beside(self, word: int, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> int:
        """Where the gloss of a word belongs: beside that of the nearest word, of two the one before."""
        best, index = float("inf"), len(glosses)
        for place, said in enumerate(self.coverage.said(words, glosses)):
            for source in said:
                distance = 2 * abs(source - word) - (source < word)
                if distance < best or (distance == best and source < word):
                    best, index = distance, place + (source < word)
        return index


def _may_be(word: SourceWord, gloss: str) -> bool:
    return any(copied_gloss(reading) == gloss for reading in word.readings)
