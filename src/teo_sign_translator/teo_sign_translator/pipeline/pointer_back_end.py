# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Back end of the pointer: translates any sentence; no word of it is lost and no gloss invented."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple

from teo_sign_translator.morphology import Morphology, Reading
from teo_sign_translator.output.output_words import PAUSE, OutputWord
from teo_sign_translator.pipeline.agreement import Agreement
from teo_sign_translator.pipeline.back_end import TranslatedSentence
from teo_sign_translator.pipeline.drafting.drafter import Drafter
from teo_sign_translator.pipeline.gloss_output import gloss_output_words
from teo_sign_translator.pipeline.hypothesis_repair import HypothesisRepair, Repaired, as_said
from teo_sign_translator.pipeline.long_sentences import parts, pieces
from teo_sign_translator.pipeline.trust import is_trusted
from teo_sign_translator.pointer import Hypothesis, OutputGloss, SentenceModel
from teo_sign_translator.taught.aligned_pairs import NAME, SLOTS
from teo_sign_translator.taught.phrasebook import Match, Pattern, Phrasebook
from teo_sign_translator.text.reading import Clause
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.sentence_type import SentenceType
from teo_sign_translator.text.source_words import SourceWord, words_of_clauses

#: Translations that the model weighs against each other: a second one is there where the first loses a word;
#: four find no more right ones among 900 held-out sentences than two.
DEFAULT_BEAM_WIDTH = 2
#: Likewise for a sentence that was taught and is typed so that another comes first ("cuantos anos tienes").
_TAUGHT_BEAM_WIDTH = 16


class _Sentence(NamedTuple):
    """A sentence before it is translated.

    Attributes:
        clauses: At least one.
        parts: Its words, divided if they are too many.
        taught: The pattern that it is; None if it was not taught.
    """

    clauses: Sequence[Clause]
    parts: Sequence[Sequence[SourceWord]]
    taught: Pattern | None


class _Part(NamedTuple):
    """Words that are translated together, and the pattern that they are, if they were taught."""

    words: Sequence[SourceWord]
    taught: Pattern | None


class PointerBackEnd:
    """Translates each sentence with a model that reads words with their readings."""

    def __init__(
        self,
        model: SentenceModel,
        morphology: Morphology,
        repair: HypothesisRepair,
        drafter: Drafter | None,
        taught: Phrasebook,
        agreement: Agreement,
        *,
        beam_width: int = DEFAULT_BEAM_WIDTH,
    ) -> None:
        """Put the parts together.

        Args:
            model: Says glosses, each with the words that it stands for.
            morphology: Gives the words' readings.
            repair: Chooses among the model's translations and mends the one it chooses.
            drafter: Translates by rule what the model is not to be trusted with; None for a language without
                such rules: then the model's own translation is mended.
            taught: Sentences whose translation is given, the paper's among them: what that leaves out is no
                loss, and a name that it signs is not spelled.
            agreement: Gives the form of signs that agree.
            beam_width: Translations that the model weighs against each other, at least 1.
        """
        self._model = model
        self._morphology = morphology
        self._rules = TextRules.load(morphology.folder)
        self._repair = repair
        self._drafter = drafter
        self._taught = taught
        self._agreement = agreement
        self._beam_width = beam_width

    @property
    def name(self) -> str:
        """Of the model."""
        return self._model.name

    def translate(self, texts: Sequence[Sequence[Clause]]) -> list[list[TranslatedSentence]]:
        """See `BackEnd`; all sentences of all texts are given to the model together."""
        sentences = [self._sentences(clauses) for clauses in texts]
        every = [
            _Part(words, sentence.taught)
            for text in sentences
            for sentence in text
            for words in sentence.parts
        ]
        said = iter(self._say(every))
        return [
            [self._assembled(sentence, [next(said) for _ in sentence.parts]) for sentence in text]
            for text in sentences
        ]

    def _say(self, every: Sequence[_Part]) -> list[Repaired]:
        """Translate parts; drafts of those that the model is not to be trusted with.

        Of the others those that lose words are translated piece by piece, if that loses fewer.
        """
        answers = self._model.translate_all([part.words for part in every], beam=self._beam_width)
        result = [
            self._as_taught(part, hypotheses) or self._trusted(part.words, hypotheses)
            for part, hypotheses in zip(every, answers, strict=True)
        ]
        lossy = [index for index, said in enumerate(result) if any(said.repaired)]
        divided = {
            index: own
            for index in lossy
            if len(own := pieces(every[index].words, self._rules.sentences.joints)) > 1
        }
        asked = [
            every[index].words[piece.start : piece.stop] for index, own in divided.items() for piece in own
        ]
        again = zip(asked, self._model.translate_all(asked, beam=self._beam_width), strict=True)
        for index, own in divided.items():
            translated = [(piece, self._repair.repair(*next(again))) for piece in own]
            together = self._repair.join(every[index].words, translated)
            if sum(together.repaired) < sum(result[index].repaired):
                result[index] = together
        return result

    def _trusted(self, words: Sequence[SourceWord], hypotheses: Sequence[Hypothesis]) -> Repaired:
        """The best hypothesis, mended, or a draft where that is better."""
        best = self._repair.best(words, hypotheses)
        if self._drafter is None:
            return self._repair.mend(words, best)
        draft = self._drafter.draft(words)
        count = sum(not word.is_mark for word in words)
        if is_trusted(best.glosses, draft, faults=best.faults, words=count):
            return self._repair.mend(words, best)
        return Repaired(draft, (False,) * len(draft), drafted=True)

    def _as_taught(self, part: _Part, hypotheses: Sequence[Hypothesis]) -> Repaired | None:
        """The translation that was taught; if it is not among the first, looked for among more."""
        if part.taught is None:
            return None
        found = _as_taught(hypotheses, part.taught)
        if found is None and self._beam_width < _TAUGHT_BEAM_WIDTH:
            more = self._model.translate_all([part.words], beam=_TAUGHT_BEAM_WIDTH)
            found = _as_taught(more[0], part.taught)
        return found

    def _sentences(self, clauses: Sequence[Clause]) -> list[_Sentence]:
        """The sentences of a text; two that were taught as one are one."""
        single = _by_sentence(clauses)
        result: list[_Sentence] = []
        while single:
            both = [*single[0], *single[1]] if len(single) > 1 else []
            match = self._match(both) if both else None
            own = both if match else single[0]
            del single[: 2 if match else 1]
            match = match or self._match(own)
            words = words_of_clauses(own, self._morphology)
            if match and NAME in match.pattern.tokens:
                words = _with_names(words, match)
            result.append(_Sentence(own, parts(words), match.pattern if match else None))
        return result

    def _assembled(self, sentence: _Sentence, translated: Sequence[Repaired]) -> TranslatedSentence:
        """A sentence from the translations of its parts."""
        output_words: list[OutputWord] = []
        recognised = sentence.taught.type if sentence.taught else None
        for words, said in zip(sentence.parts, translated, strict=True):
            if output_words:
                output_words.append(PAUSE)
            signed = sentence.taught.glosses if sentence.taught else ()
            output_words += gloss_output_words(words, said, signed, self._agreement, self._rules.glosses)
            if not sentence.taught and _asks(words, said.glosses):
                recognised = SentenceType.WH_QUESTION
        return TranslatedSentence(sentence.clauses, output_words, recognised)

    def _match(self, clauses: Sequence[Clause]) -> Match | None:
        return self._taught.match(
            [word for clause in clauses for word in clause.words],
            crosses_stop=any(clause.closes for clause in clauses[:-1]),
            crosses_pause=len(clauses) > 1,
        )


def _by_sentence(clauses: Iterable[Clause]) -> list[list[Clause]]:
    sentences: list[list[Clause]] = [[]]
    for clause in clauses:
        sentences[-1].append(clause)
        if clause.closes:
            sentences.append([])
    return [sentence for sentence in sentences if sentence]


def _as_taught(hypotheses: Sequence[Hypothesis], taught: Pattern) -> Repaired | None:
    """The translation that was taught, if the model thinks of it: what it leaves out is no loss."""
    for hypothesis in hypotheses:
        if len(hypothesis.glosses) == len(taught.glosses) and all(
            gloss.gloss == expected or expected in SLOTS
            for gloss, expected in zip(hypothesis.glosses, taught.glosses, strict=True)
        ):
            return as_said(hypothesis.glosses)
    return None


def _with_names(words: Sequence[SourceWord], match: Match) -> tuple[SourceWord, ...]:
    """The words of a taught sentence; those at the place of a name have the reading NAME alone."""
    result = list(words)
    place = 0
    for token, own in zip(match.pattern.tokens, match.words, strict=True):
        for index in range(place, place + len(own)):
            if token == NAME:
                result[index] = replace(result[index], readings=(Reading(result[index].text, "NAME"),))
        place += len(own)
    return tuple(result)


def _asks(words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> bool:
    """Whether a translation ends with a question word, as LSE asks."""
    return any(
        reading.tag.startswith("WH") for source in glosses[-1].sources for reading in words[source].readings
    )
