"""Translating with a sentence model: any sentence, known or not, and no word of it lost."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from teo_sign_translator.drafts import PAUSE, Draft, name
from teo_sign_translator.faithful import Faithful, faithful
from teo_sign_translator.function_words import FunctionWords
from teo_sign_translator.morphology import Morphology, Reading
from teo_sign_translator.neural import OutputGloss, SentenceModel
from teo_sign_translator.neural.lexis import copied_gloss
from teo_sign_translator.number_signs import number
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


class SentenceRoute:
    """Translates each sentence with a model that reads words with their readings."""

    def __init__(
        self,
        model: SentenceModel,
        morphology: Morphology,
        function_words: FunctionWords,
        *,
        beam_width: int = DEFAULT_BEAM_WIDTH,
    ) -> None:
        """Put the parts together.

        Args:
            model: Says glosses, each with the words that it stands for.
            morphology: Gives the words' readings.
            function_words: What a translation may leave out.
            beam_width: Translations that the model weighs against each other, at least 1.
        """
        self._model = model
        self._morphology = morphology
        self._function_words = function_words
        self._beam_width = beam_width

    @property
    def name(self) -> str:
        """Of the model."""
        return self._model.name

    def translate(self, texts: Sequence[Sequence[Clause]]) -> list[list[DraftedSentence]]:
        """See `Route`; all sentences of all texts are given to the model together."""
        sentences = [_by_sentence(clauses) for clauses in texts]
        parts = [
            _parts(words_of_clauses(clauses, self._morphology)) for text in sentences for clauses in text
        ]
        answers = iter(
            self._model.translate_all([part for each in parts for part in each], beam=self._beam_width)
        )
        drafted: list[DraftedSentence] = []
        for clauses, own in zip((clauses for text in sentences for clauses in text), parts, strict=True):
            drafts: list[Draft] = []
            asks = False
            for part in own:
                said = faithful(part, next(answers), self._function_words)
                drafts += [*([PAUSE] if drafts else []), *_drafts(part, said)]
                asks = _asks(part, said.glosses)
            drafted.append(DraftedSentence(clauses, drafts, SentenceType.WH_QUESTION if asks else None))
        ordered = iter(drafted)
        return [[next(ordered) for _ in text] for text in sentences]


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


def _drafts(words: Sequence[SourceWord], said: Faithful) -> list[Draft]:
    """Glosses as drafts; words that none stands for go with the next one, marks between them are pauses."""
    typed = _typed(words, [gloss.sources for gloss in said.glosses])
    pauses = _pauses(words, said.glosses)
    result: list[Draft] = []
    for place, (gloss, repaired, own) in enumerate(zip(said.glosses, said.repaired, typed, strict=True)):
        result += _draft(words, gloss, Origin.REPAIRED if repaired else Origin.MODEL, own)
        if place in pauses:
            result.append(PAUSE)
    return result


def _draft(
    words: Sequence[SourceWord], gloss: OutputGloss, origin: Origin, typed: tuple[str, ...]
) -> list[Draft]:
    readings = [reading for source in gloss.sources for reading in words[source].readings]
    meant = [reading for reading in readings if copied_gloss(reading) == gloss.gloss]
    if gloss.gloss[0].isdigit():
        return number(gloss.gloss, typed, gloss.probability)
    if _is_name([words[source] for source in gloss.sources], meant):
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


def _is_name(words: Sequence[SourceWord], meant: Sequence[Reading]) -> bool:
    """Whether a gloss is somebody's name.

    Args:
        words: That it stands for.
        meant: Their readings that have this gloss, the likeliest first.
    """
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
