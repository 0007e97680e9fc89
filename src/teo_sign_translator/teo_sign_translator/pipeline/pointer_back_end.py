# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Back end of the pointer: asks the model once for each sentence, and makes output words of its answer.

What the model leaves out is put back. The paper's sentences have their translations given, which leave out
what they like and hold for themselves alone. Glosses become signs, names and numbers, with a pause where a
mark falls between them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from teo_sign_translator.data_files import read_rows
from teo_sign_translator.morphology import Morphology, Reading, gloss_name
from teo_sign_translator.output.output_words import PAUSE, OutputWord, carried, lexical, number
from teo_sign_translator.output.translation import Kind, Origin
from teo_sign_translator.pipeline.agreement import Agreement
from teo_sign_translator.pipeline.back_end import TranslatedSentence
from teo_sign_translator.pipeline.comparisons import Comparisons
from teo_sign_translator.pipeline.completeness import Completeness, CompleteTranslation
from teo_sign_translator.pipeline.connectives import Connectives
from teo_sign_translator.pipeline.counts import Counts
from teo_sign_translator.pipeline.denials import Denials
from teo_sign_translator.pipeline.doers import Doers
from teo_sign_translator.pipeline.naming import Naming
from teo_sign_translator.pipeline.objects import Objects
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.reliability import features, reliability
from teo_sign_translator.pipeline.subjects import Subjects
from teo_sign_translator.pipeline.topic import Topic, Topics
from teo_sign_translator.pipeline.wishes import Wishes
from teo_sign_translator.pointer import Hypothesis, OutputGloss, SentenceModel
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.cleaning import clean
from teo_sign_translator.text.reading import Clause, SentenceType, read, sentence_type
from teo_sign_translator.text.rules import GlossNames, TextRules
from teo_sign_translator.text.source_word import SourceWord
from teo_sign_translator.text.source_words import is_persons_name, words_of_clauses

#: Translations that the model weighs against each other: a second one is there where the first loses a word;
#: four find no more right ones among 900 held-out sentences than two.
DEFAULT_BEAM_WIDTH = 2

#: Words that are translated together; the model has seen no longer sentences, and its time grows with their
#: number.
MOST_WORDS = 40

# Where a language keeps its given sentences: sentence, and glosses separated by "/".
_GIVEN_SENTENCES = "paper_pairs.tsv"
# Digits of a price behind the comma.
_CENT_DIGITS = 2


@dataclass(frozen=True, slots=True)
class GivenSentence:
    """A sentence's given translation.

    Attributes:
        glosses: In signing order.
        type: Of the sentence, by its own marks.
    """

    glosses: tuple[str, ...]
    type: SentenceType


#: Given sentences by their words: capitals, accents and marks do not count.
GivenSentences = Mapping[tuple[str, ...], GivenSentence]


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
        self._topics = Topics(morphology.folder)
        language = PipelineWords.load(morphology.folder)
        self._meaning = (
            Naming(language, self._topics, self._rules.glosses.name),
            Connectives(morphology.folder),
            Counts(language),
            Comparisons(language, self._topics),
            Denials(language),
            Subjects(language, self._topics),
            Wishes(language, self._topics),
            Objects(language, self._topics),
            Doers(language, self._topics),
        )
        self._weights = language.reliability

    @property
    def name(self) -> str:
        """Of the model."""
        return self._model.name

    def translate(self, texts: Sequence[Sequence[Clause]]) -> list[list[TranslatedSentence]]:
        """See `BackEnd`; the model is asked once, for all sentences of all texts together."""
        units = [self._units(clauses) for clauses in texts]
        asked = [part for text in units for unit in text for part in unit.parts]
        unsaid = self._completeness.without_words
        said = iter(self._model.translate_all(asked, beam=self._beam_width, unsaid=unsaid))
        return [self._of_text(text, said) for text in units]

    def _of_text(
        self, units: Sequence[_Unit], said: Iterator[Sequence[Hypothesis]]
    ) -> list[TranslatedSentence]:
        topic = Topic(self._topics)
        return [self._assembled(unit, [next(said) for _ in unit.parts], topic) for unit in units]

    def _units(self, clauses: Sequence[Clause]) -> list[_Unit]:
        """The sentences of a text; two that are given as one are one."""
        sentences = _by_sentence(clauses)
        result: list[_Unit] = []
        while sentences:
            both = [clause for sentence in sentences[:2] for clause in sentence]
            own = both if _key(both) in self._given else sentences[0]
            del sentences[: 2 if own is both else 1]
            words = words_of_clauses(own, self._morphology)
            result.append(_Unit(own, divided(words), self._given.get(_key(own))))
        return result

    def _assembled(
        self, unit: _Unit, answers: Sequence[Sequence[Hypothesis]], topic: Topic
    ) -> TranslatedSentence:
        """A sentence from what the model says for each of its parts."""
        output_words: list[OutputWord] = []
        recognised = unit.given.type if unit.given else None
        for words, hypotheses in zip(unit.parts, answers, strict=True):
            if output_words:
                output_words.append(PAUSE)
            said = _as_given(hypotheses, unit.given) or self._completeness.complete(words, hypotheses)
            if not unit.given:
                for rule in self._meaning:
                    said = rule.read(words, said)
                said = said.without(self._topics.repeated(words, said.glosses))
            unsaid = topic.unsaid(words, said.glosses)
            if not unit.given:
                said = said.without(unsaid)
            output_words += _gloss_output_words(words, said, self._agreement, self._rules.glosses)
            if not unit.given and _asks(words, said.glosses):
                recognised = SentenceType.WH_QUESTION
        sure = [word.confidence for word in output_words if word.kind is not Kind.PAUSE and word.signs]
        every = [word for words in unit.parts for word in words]
        likely = reliability(features(every, sure), self._weights) if sure and not unit.given else None
        return TranslatedSentence(unit.clauses, output_words, recognised, likely)


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


def _as_given(hypotheses: Sequence[Hypothesis], given: GivenSentence | None) -> CompleteTranslation | None:
    """The given translation, each gloss with what the model says of it; None where none is given."""
    if given is None:
        return None
    for hypothesis in hypotheses:
        if tuple(gloss.gloss for gloss in hypothesis.glosses) == given.glosses:
            return CompleteTranslation(hypothesis.glosses, (False,) * len(given.glosses), given=True)
    said = {gloss.gloss: gloss for hypothesis in reversed(hypotheses) for gloss in hypothesis.glosses}
    glosses = tuple(said.get(name, OutputGloss(name, (), 1.0, copied=False)) for name in given.glosses)
    return CompleteTranslation(glosses, (False,) * len(glosses), given=True)


def _asks(words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> bool:
    """Whether a translation ends with a question word, as LSE asks."""
    return any(
        reading.tag.startswith("WH") for source in glosses[-1].sources for reading in words[source].readings
    )


def read_given_sentences(folder: Path) -> GivenSentences:
    """Those of a language; none if its text folder has no file of them.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    path = folder / _GIVEN_SENTENCES
    if not path.is_file():
        return {}
    rules = TextRules.load(folder)
    found: dict[tuple[str, ...], GivenSentence] = {}
    for _, (sentence, glosses) in read_rows(path, columns=2):
        clauses = read(clean(sentence).text, rules).clauses
        said = tuple(gloss_name(gloss.strip()) for gloss in glosses.split("/"))
        found[_key(clauses)] = GivenSentence(said, sentence_type(clauses, rules))
    return found


def _key(clauses: Sequence[Clause]) -> tuple[str, ...]:
    return tuple(word.key for clause in clauses for word in clause.words)


def _gloss_output_words(
    words: Sequence[SourceWord],
    said: CompleteTranslation,
    agreement: Agreement,
    names: GlossNames,
) -> list[OutputWord]:
    """Glosses as output words, those that none says behind them; marks between them are pauses.

    Args:
        words: Of the sentence.
        said: Its translation; the glosses of a given one are no names whatever their words.
        agreement: Gives the form of signs that agree.
        names: Of glosses, in the language.
    """
    typed = [_texts(words, sorted(gloss.sources)) for gloss in said.glosses]
    pauses = _pauses(words, said.glosses)
    result: list[OutputWord] = []
    for place, (gloss, put_back, own) in enumerate(zip(said.glosses, said.put_back, typed, strict=True)):
        # "me llamo rosa" is MI NOMBRE R-O-S-A
        named = place > 0 and said.glosses[place - 1].gloss == names.name
        origin = Origin.REPAIRED if put_back else Origin.MODEL
        neighbours = {each.gloss for each in said.glosses[max(0, place - 1) : place + 2]}
        if neighbours & names.currencies:  # "12,50 €" is said "doce cincuenta"
            gloss = replace(gloss, gloss=_price(gloss.gloss))
        form = agreement.inflection(gloss.gloss, gloss.sources, words)
        own_words = [
            replace(each, inflection=form)
            for each in _output_words(words, gloss, origin, own, names, named=named)
        ]
        result += [replace(each, is_name=False) for each in own_words] if said.given else own_words
        if place in pauses:
            result.append(PAUSE)
    claimed = {place for gloss in said.glosses for place in gloss.sources}
    left = [place for place, word in enumerate(words) if place not in claimed and not word.is_mark]
    return [*result, *(carried(words[place].form, (words[place].text,)) for place in left)]


def _price(gloss: str) -> str:
    """A price as its two numbers, written as hours and minutes are: 12,50 euros are 12 and 50, 12,5 too."""
    whole, comma, cents = gloss.partition(",")
    if not comma or not whole.isdecimal() or not 0 < len(cents) <= _CENT_DIGITS:
        return gloss
    return f"{whole}:{cents.ljust(_CENT_DIGITS, '0').removeprefix('0') or '0'}" if int(cents) else whole


def _output_words(
    words: Sequence[SourceWord],
    gloss: OutputGloss,
    origin: Origin,
    typed: tuple[str, ...],
    names: GlossNames,
    *,
    named: bool,
) -> list[OutputWord]:
    """A gloss as a sign, a name or a number.

    Args:
        words: Of the sentence.
        gloss: What is said.
        origin: How it came about.
        typed: The words that it stands for.
        names: Of glosses, in the language.
        named: Whether it follows the sign for "name".
    """
    readings = [reading for source in gloss.sources for reading in words[source].readings]
    meant = [reading for reading in readings if copied_gloss(reading) == gloss.gloss]
    if gloss.gloss[0].isdigit():
        return number(gloss.gloss, typed, gloss.probability, names.decimal)
    if meant and meant[0].tag == "NAME" and not names.symbols.keys().isdisjoint(gloss.gloss):
        return _address(gloss, typed, names)
    if _is_name([words[source] for source in gloss.sources], meant, named=named):
        return [lexical(gloss.gloss, typed, gloss.probability, is_name=True)]
    return [lexical(gloss.gloss, typed, gloss.probability, origin)]


def _address(gloss: OutputGloss, typed: tuple[str, ...], names: GlossNames) -> list[OutputWord]:
    """An address as people spell it: its words, and a sign for each symbol between them."""
    parts = re.split(f"([{re.escape(''.join(names.symbols))}])", gloss.gloss)
    return [
        lexical(names.symbols.get(part, part), typed, gloss.probability, is_name=part not in names.symbols)
        for part in parts
        if part
    ]


def _is_name(words: Sequence[SourceWord], meant: Sequence[Reading], *, named: bool) -> bool:
    """Whether a gloss is somebody's name.

    Args:
        words: That it stands for.
        meant: Their readings that have this gloss, the likeliest first.
        named: Whether it follows the sign for "name"; then any word that may be a name is one.
    """
    if named and any(is_persons_name(reading) or reading.tag == "X" for reading in meant):
        return True
    listed = any(is_persons_name(reading) and reading.exact for reading in meant)
    return bool(meant) and (is_persons_name(meant[0]) or (listed and any(word.capital for word in words)))


def _texts(words: Sequence[SourceWord], places: Sequence[int]) -> tuple[str, ...]:
    """What was typed at some places, a short form of several words once."""
    result: list[str] = []
    before: SourceWord | None = None
    for word in (words[place] for place in places if not words[place].is_mark):
        if before is None or word.text != before.text or word.form == before.form:
            result.append(word.text)
        before = word
    return tuple(result)


def _pauses(words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> set[int]:
    """Glosses behind which a mark of the sentence falls: all before it come from words before the mark."""
    result: set[int] = set()
    highest: list[int] = []
    lowest: list[int] = []
    for gloss in glosses:
        highest.append(max([*highest[-1:], *gloss.sources], default=-1))
    for gloss in reversed(glosses):
        lowest.insert(0, min([*lowest[:1], *gloss.sources], default=len(words)))
    for mark in (place for place, word in enumerate(words) if word.is_mark):
        for place in range(len(glosses) - 1):
            if highest[place] < mark < lowest[place + 1] and highest[place] >= 0:
                result.add(place)
                break
    return result
