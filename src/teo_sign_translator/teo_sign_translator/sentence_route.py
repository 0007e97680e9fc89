"""Translating with a sentence model: any sentence, known or not, and no word of it lost."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from teo_sign_translator.drafts import PAUSE, Draft, name
from teo_sign_translator.faithful import Faithful, as_said, faithful
from teo_sign_translator.function_words import FunctionWords
from teo_sign_translator.morphology import Morphology, Reading
from teo_sign_translator.neural import Hypothesis, OutputGloss, SentenceModel
from teo_sign_translator.neural.lexis import copied_gloss
from teo_sign_translator.number_signs import number
from teo_sign_translator.phrasebook import Match, Pattern, Phrasebook
from teo_sign_translator.reading import Clause
from teo_sign_translator.route import DraftedSentence
from teo_sign_translator.sentence_type import SentenceType
from teo_sign_translator.spanish_words import SourceWord, words_of_clauses
from teo_sign_translator.translation import Kind, Origin

#: Translations that the model weighs against each other.
DEFAULT_BEAM_WIDTH = 4

#: Words of a sentence that are translated together; a longer one is divided. The model has seen no longer
#: ones, and its time grows with their number.
MOST_WORDS = 40

# Tags of people's names; names of places have signs, or are spelled like any other word.
_PEOPLE = ("NAME", "NAME:m", "NAME:f")

# Behind it stands a name: "me llamo rosa" is MI NOMBRE R-O-S-A.
_NAME_GLOSS = "NOMBRE"


class _Sentence(NamedTuple):
    """Clauses that are translated together, and the pattern that they are, if they were taught."""

    clauses: Sequence[Clause]
    taught: Pattern | None


class SentenceRoute:
    """Translates each sentence with a model that reads words with their readings."""

    def __init__(
        self,
        model: SentenceModel,
        morphology: Morphology,
        function_words: FunctionWords,
        taught: Phrasebook,
        *,
        beam_width: int = DEFAULT_BEAM_WIDTH,
    ) -> None:
        """Put the parts together.

        Args:
            model: Says glosses, each with the words that it stands for.
            morphology: Gives the words' readings.
            function_words: What a translation may leave out.
            taught: Sentences whose translation is given, the paper's among them: what that leaves out is no
                loss, and a name that it signs is not spelled.
            beam_width: Translations that the model weighs against each other, at least 1.
        """
        self._model = model
        self._morphology = morphology
        self._function_words = function_words
        self._taught = taught
        self._beam_width = beam_width

    @property
    def name(self) -> str:
        """Of the model."""
        return self._model.name

    def translate(self, texts: Sequence[Sequence[Clause]]) -> list[list[DraftedSentence]]:
        """See `Route`; all sentences of all texts are given to the model together."""
        sentences = [self._sentences(clauses) for clauses in texts]
        parts = [
            _parts(words_of_clauses(sentence.clauses, self._morphology))
            for text in sentences
            for sentence in text
        ]
        answers = iter(
            self._model.translate_all([part for own in parts for part in own], beam=self._beam_width)
        )
        own_parts = iter(parts)
        return [
            [self._drafted(sentence, next(own_parts), answers) for sentence in text] for text in sentences
        ]

    def _sentences(self, clauses: Sequence[Clause]) -> list[_Sentence]:
        """The sentences of a text; two that were taught as one are one."""
        single = _by_sentence(clauses)
        result: list[_Sentence] = []
        while single:
            both = [*single[0], *single[1]] if len(single) > 1 else []
            match = self._match(both) if both else None
            if match is not None:
                result.append(_Sentence(both, match.pattern))
                del single[:2]
            else:
                match = self._match(single[0])
                result.append(_Sentence(single.pop(0), match.pattern if match else None))
        return result

    def _match(self, clauses: Sequence[Clause]) -> Match | None:
        return self._taught.match(
            [word for clause in clauses for word in clause.words],
            crosses_stop=any(clause.closes for clause in clauses[:-1]),
            crosses_pause=len(clauses) > 1,
        )

    def _drafted(
        self,
        sentence: _Sentence,
        parts: Sequence[Sequence[SourceWord]],
        answers: Iterator[tuple[Hypothesis, ...]],
    ) -> DraftedSentence:
        drafts: list[Draft] = []
        recognised = sentence.taught.type if sentence.taught else None
        for part, hypotheses in zip(parts, answers, strict=False):  # the answers go on to other sentences
            if sentence.taught and hypotheses[0].glosses:
                said = as_said(hypotheses[0])
            else:
                said = faithful(part, hypotheses, self._function_words)
            if drafts:
                drafts.append(PAUSE)
            drafts += _drafts(part, said, sentence.taught.glosses if sentence.taught else ())
            if not sentence.taught and _asks(part, said.glosses):
                recognised = SentenceType.WH_QUESTION
        return DraftedSentence(sentence.clauses, drafts, recognised)


def _by_sentence(clauses: Iterable[Clause]) -> list[list[Clause]]:
    sentences: list[list[Clause]] = [[]]
    for clause in clauses:
        sentences[-1].append(clause)
        if clause.closes:
            sentences.append([])
    return [sentence for sentence in sentences if sentence]


def _parts(words: Sequence[SourceWord]) -> list[Sequence[SourceWord]]:
    """A sentence as it is, or divided, at marks where there are any; no part is marks alone."""
    parts: list[Sequence[SourceWord]] = []
    rest = words
    while len(rest) > MOST_WORDS:
        marks = [place for place in range(1, MOST_WORDS) if rest[place].is_mark]
        size = marks[-1] + 1 if marks else MOST_WORDS
        parts.append(rest[:size])
        rest = rest[size:]
    parts.append(rest)
    return [part for part in parts if not all(word.is_mark for word in part)]


def _drafts(words: Sequence[SourceWord], said: Faithful, signed: Collection[str]) -> list[Draft]:
    """Glosses as drafts; words that none stands for go with the next one, marks between them are pauses.

    Args:
        words: Of the sentence.
        said: Its translation.
        signed: Glosses that are no names whatever their words.
    """
    typed = _typed(words, [gloss.sources for gloss in said.glosses])
    pauses = _pauses(words, said.glosses)
    result: list[Draft] = []
    for place, (gloss, repaired, own) in enumerate(zip(said.glosses, said.repaired, typed, strict=True)):
        named = place > 0 and said.glosses[place - 1].gloss == _NAME_GLOSS
        origin = Origin.REPAIRED if repaired else Origin.MODEL
        draft = _draft(words, gloss, origin, own, named=named)
        result += [replace(each, is_name=False) for each in draft] if gloss.gloss in signed else draft
        if place in pauses:
            result.append(PAUSE)
    return result


def _draft(
    words: Sequence[SourceWord],
    gloss: OutputGloss,
    origin: Origin,
    typed: tuple[str, ...],
    *,
    named: bool,
) -> list[Draft]:
    """A gloss as a sign, a name or a number.

    Args:
        words: Of the sentence.
        gloss: What is said.
        origin: How it came about.
        typed: The words that it stands for.
        named: Whether it follows the sign for "name".
    """
    readings = [reading for source in gloss.sources for reading in words[source].readings]
    meant = [reading for reading in readings if copied_gloss(reading) == gloss.gloss]
    if gloss.gloss[0].isdigit():
        return number(gloss.gloss, typed, gloss.probability)
    if _is_name([words[source] for source in gloss.sources], meant, named=named):
        return [name(gloss.gloss, typed, gloss.probability)]
    return [
        Draft(
            signs=(gloss.gloss,),
            kind=Kind.LEXICAL,
            confidence=gloss.probability,
            words=typed,
            origin=origin,
        )
    ]


def _is_name(words: Sequence[SourceWord], meant: Sequence[Reading], *, named: bool) -> bool:
    """Whether a gloss is somebody's name.

    Args:
        words: That it stands for.
        meant: Their readings that have this gloss, the likeliest first.
        named: Whether it follows the sign for "name"; then any word that may be a name is one.
    """
    if named and any(reading.tag in (*_PEOPLE, "X") for reading in meant):
        return True
    if not any(reading.tag in _PEOPLE for reading in meant):
        return False
    return meant[0].tag in _PEOPLE or any(word.capital for word in words)


def _typed(words: Sequence[SourceWord], sources: Sequence[tuple[int, ...]]) -> list[tuple[str, ...]]:
    """For each gloss the words it stands for, as typed, and those that go with it."""
    own = [set(places) for places in sources]
    owner = {place: gloss for gloss, places in reversed(list(enumerate(sources))) for place in places}
    following = owner[max(owner)] if owner else len(sources) - 1
    for place in reversed(range(len(words))):
        following = owner.get(place, following)
        if place not in owner and not words[place].is_mark:
            own[following].add(place)
    return [_texts(words, sorted(places)) for places in own]


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


def _asks(words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> bool:
    """Whether a translation ends with a question word, as LSE asks."""
    return any(
        reading.tag.startswith("WH") for source in glosses[-1].sources for reading in words[source].readings
    )
