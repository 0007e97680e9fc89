# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Back end of the pointer: asks the model once for each sentence, and completes what it says."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from teo_sign_translator.morphology import Morphology
from teo_sign_translator.output.output_words import PAUSE, OutputWord
from teo_sign_translator.pipeline.agreement import Agreement
from teo_sign_translator.pipeline.back_end import TranslatedSentence
from teo_sign_translator.pipeline.completeness import Completeness, CompleteTranslation
from teo_sign_translator.pipeline.given_sentences import GivenSentence, GivenSentences
from teo_sign_translator.pipeline.gloss_output import gloss_output_words
from teo_sign_translator.pointer import Hypothesis, OutputGloss, SentenceModel
from teo_sign_translator.text.reading import Clause
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.sentence_type import SentenceType
from teo_sign_translator.text.source_words import SourceWord, words_of_clauses

#: Translations that the model weighs against each other: a second one is there where the first loses a word;
#: four find no more right ones among 900 held-out sentences than two.
DEFAULT_BEAM_WIDTH = 2

#: Words that are translated together; the model has seen no longer sentences, and its time grows with their
#: number.
MOST_WORDS = 40


class _Unit(NamedTuple):
    """A sentence before it is translated.

    Attributes:
        clauses: At least one.
        parts: Its words, divided if they are too many.
        given: Its translation, if it is given.
    """

    clauses: Sequence[Clause]
    parts: Sequence[Sequence[SourceWord]]
    given: GivenSentence | None


class PointerBackEnd:
    """Translates each sentence with a model that reads words with their readings."""

    def __init__(
        self,
        model: SentenceModel,
        morphology: Morphology,
        completeness: Completeness,
        given: GivenSentences,
        agreement: Agreement,
        *,
        beam_width: int = DEFAULT_BEAM_WIDTH,
    ) -> None:
        """Put the parts together.

        Args:
            model: Says glosses, each with the words that it stands for.
            morphology: Gives the words' readings.
            completeness: Puts back what the model leaves out.
            given: Sentences whose translation is given.
            agreement: Gives the form of signs that agree.
            beam_width: Translations that the model weighs against each other, at least 1.
        """
        self._model = model
        self._morphology = morphology
        self._rules = TextRules.load(morphology.folder)
        self._completeness = completeness
        self._given = given
        self._agreement = agreement
        self._beam_width = beam_width

    @property
    def name(self) -> str:
        """Of the model."""
        return self._model.name

    def translate(self, texts: Sequence[Sequence[Clause]]) -> list[list[TranslatedSentence]]:
        """See `BackEnd`; the model is asked once, for all sentences of all texts together."""
        units = [self._units(clauses) for clauses in texts]
        asked = [part for text in units for unit in text for part in unit.parts]
        said = iter(self._model.translate_all(asked, beam=self._beam_width))
        return [[self._assembled(unit, [next(said) for _ in unit.parts]) for unit in text] for text in units]

    def _units(self, clauses: Sequence[Clause]) -> list[_Unit]:
        """The sentences of a text; two that are given as one are one."""
        sentences = _by_sentence(clauses)
        result: list[_Unit] = []
        while sentences:
            both = [clause for sentence in sentences[:2] for clause in sentence]
            own = both if self._given.find(both) else sentences[0]
            del sentences[: 2 if own is both else 1]
            words = words_of_clauses(own, self._morphology)
            result.append(_Unit(own, divided(words), self._given.find(own)))
        return result

    def _assembled(self, unit: _Unit, answers: Sequence[Sequence[Hypothesis]]) -> TranslatedSentence:
        """A sentence from what the model says for each of its parts."""
        output_words: list[OutputWord] = []
        recognised = unit.given.type if unit.given else None
        for words, hypotheses in zip(unit.parts, answers, strict=True):
            if output_words:
                output_words.append(PAUSE)
            said = _as_given(hypotheses, unit.given) or self._completeness.complete(words, hypotheses)
            output_words += gloss_output_words(words, said, self._agreement, self._rules.glosses)
            if not unit.given and _asks(words, said.glosses):
                recognised = SentenceType.WH_QUESTION
        return TranslatedSentence(unit.clauses, output_words, recognised)


def divided(words: Sequence[SourceWord]) -> list[Sequence[SourceWord]]:
    """A sentence as it is; one that is too long in parts, divided at marks if it can. None is marks alone."""
    result: list[Sequence[SourceWord]] = []
    rest = words
    while len(rest) > MOST_WORDS:
        marks = [place for place in range(1, MOST_WORDS) if rest[place].is_mark]
        size = marks[-1] + 1 if marks else MOST_WORDS
        result.append(rest[:size])
        rest = rest[size:]
    result.append(rest)
    return [part for part in result if not all(word.is_mark for word in part)]


def _by_sentence(clauses: Iterable[Clause]) -> list[list[Clause]]:
    sentences: list[list[Clause]] = [[]]
    for clause in clauses:
        sentences[-1].append(clause)
        if clause.closes:
            sentences.append([])
    return [sentence for sentence in sentences if sentence]


def _as_given(hypotheses: Iterable[Hypothesis], given: GivenSentence | None) -> CompleteTranslation | None:
    """The given translation, if the model says it."""
    for hypothesis in hypotheses:
        if given and tuple(gloss.gloss for gloss in hypothesis.glosses) == given.glosses:
            return CompleteTranslation(hypothesis.glosses, (False,) * len(hypothesis.glosses), given=True)
    return None


def _asks(words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> bool:
    """Whether a translation ends with a question word, as LSE asks."""
    return any(
        reading.tag.startswith("WH") for source in glosses[-1].sources for reading in words[source].readings
    )
