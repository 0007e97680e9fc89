# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Back end of the published model: known sentences from the model, everything else word by word."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_sign_training.corpus.paper_pairs import SLOTS
from teo_sign_training.lstm256.phrasebook import Match, Phrasebook
from teo_sign_training.lstm256.seq2seq import MARKS, LstmModel, Prediction, load_model
from teo_sign_training.lstm256.word_by_word import GlossList, word_by_word
from teo_sign_translator.output.output_words import PAUSE, OutputWord, carried, lexical, number, spelled
from teo_sign_translator.pipeline.back_end import TranslatedSentence
from teo_sign_translator.text.reading import Clause, SentenceType, Word, WordKind

# Clauses that are tried as one sentence of the training data; "Venga, levántate, que tienes que ir al
# colegio" has three.
_MOST_CLAUSES = 4

# Probability below which a token of the model is not believed, and the sentence is signed word by word
# instead: the model would rather say something else.
_MIN_PROBABILITY = 0.5


@dataclass(frozen=True, slots=True)
class _Unit:
    """Clauses that are translated together, and their translation.

    Attributes:
        clauses: One, or several that are one sentence of the training data.
        output_words: Their output words.
        known: Type of the sentence of the training data that ends the unit; None if it is none.
    """

    clauses: Sequence[Clause]
    output_words: list[OutputWord]
    known: SentenceType | None


class LstmBackEnd:
    """Translates with a model that has learned sentences by heart, and word by word where it must not.

    A sentence of the training data is left to the model, also behind a greeting. Whatever is left is signed
    word by word: listed words by their gloss, numbers by digits, all others spelled.
    """

    def __init__(self, model: LstmModel, phrasebook: Phrasebook, glosses: GlossList, *, name: str) -> None:
        """Put the parts together.

        Args:
            model: Reads and writes the tokens of the phrasebook's sentences.
            phrasebook: The sentences that the model was trained on.
            glosses: Words with a sign of their own.
            name: Of the model, for the record.
        """
        self._model = model
        self._phrasebook = phrasebook
        self._glosses = glosses
        self.name = name

    def translate(self, texts: Sequence[Sequence[Clause]]) -> list[list[TranslatedSentence]]:
        """See `BackEnd`."""
        return [[_assembled(units) for units in self._by_sentence(clauses)] for clauses in texts]

    def _by_sentence(self, clauses: Sequence[Clause]) -> list[list[_Unit]]:
        """Translate the clauses of a text, grouped by sentence."""
        sentences: list[list[_Unit]] = [[]]
        index = 0
        while index < len(clauses):
            unit = self._known_run(clauses, index) or self._unit(clauses[index])
            sentences[-1].append(unit)
            index += len(unit.clauses)
            if unit.clauses[-1].closes:
                sentences.append([])
        return [units for units in sentences if units]

    def _known_run(self, clauses: Sequence[Clause], start: int) -> _Unit | None:
        """The longest run of clauses from a place on that is one sentence of the training data."""
        for size in range(min(_MOST_CLAUSES, len(clauses) - start), 1, -1):
            run = clauses[start : start + size]
            words = [word for clause in run for word in clause.words]
            if len(words) > self._phrasebook.longest:
                continue
            stops = any(clause.closes for clause in run[:-1])
            match = self._phrasebook.match(words, crosses_stop=stops, crosses_pause=True)
            output_words = self._known(match, run) if match else None
            if match and output_words:
                return _Unit(run, output_words, match.pattern.type)
        return None

    def _unit(self, clause: Clause) -> _Unit:
        """Translate one clause."""
        known: SentenceType | None = None
        output_words: list[OutputWord] = []
        for piece in self._known_pieces(clause.words) or [clause.words]:
            if isinstance(piece, Match):
                words = [word for group in piece.words for word in group]
                known = piece.pattern.type
                translated = self._known(piece, [clause])
            else:
                words, translated = list(piece), None
            output_words += translated or word_by_word(words, self._glosses)
        return _Unit([clause], output_words, known)

    def _known_pieces(self, words: Sequence[Word]) -> list[Match | Sequence[Word]]:
        """A sentence of the training data, alone or behind a greeting without a comma; empty if neither."""
        before: list[Match | Sequence[Word]] = []
        while words:
            match = self._phrasebook.match(words)
            if match:
                return [*before, match]
            found = self._glosses.find_longest([word.lower for word in words[: self._glosses.longest]])
            if not found or not found[0].interjection:
                return []
            before.append(words[: found[1]])
            words = words[found[1] :]
        return []

    def _known(self, match: Match, clauses: Sequence[Clause]) -> list[OutputWord] | None:
        """Translate a sentence of the training data; the marks of its clauses go to the model with it.

        Returns:
            Its output words, or None if the model is not sure or says something else than it was taught.
        """
        left = list(match.pattern.tokens)
        tokens: list[str] = []
        for clause in clauses:
            # Only a sentence that is one clause has slots; in all others each token is one word.
            size = len(left) if clause is clauses[-1] else len(clause.words)
            tokens += left[:size] + self._mark(clause.end)
            del left[:size]
        prediction = self._believed(tokens)
        if prediction is None or prediction.tokens != match.pattern.glosses:
            return None
        return _output_words(prediction, match.pattern.sources, match.words)

    def _believed(self, tokens: Sequence[str]) -> Prediction | None:
        """The model's answer, if it is one and the model is sure of it."""
        if not all(token in self._model.inputs for token in tokens):
            return None
        prediction = self._model.predict(tokens)
        sure = prediction.complete and all(p >= _MIN_PROBABILITY for p in prediction.probabilities)
        return prediction if sure and prediction.tokens else None

    def _mark(self, end: str) -> list[str]:
        return [end] if end in MARKS and end in self._model.inputs else []


def _assembled(units: Sequence[_Unit]) -> TranslatedSentence:
    output_words: list[OutputWord] = []
    for unit in units:
        output_words += [*([PAUSE] if output_words else []), *unit.output_words]
    return TranslatedSentence(
        [clause for unit in units for clause in unit.clauses], output_words, units[-1].known
    )


def _output_words(
    prediction: Prediction,
    sources: Sequence[tuple[int, ...]],
    words: Sequence[tuple[Word, ...]],
) -> list[OutputWord]:
    """Output words of a prediction; words that no gloss stands for go with the next one that has a gloss.

    Args:
        prediction: Glosses and slots.
        sources: For each of them the places in `words` that it stands for.
        words: The words of the sentence, several in one place for a name.
    """
    extras = _unclaimed(sources, range(len(words)))
    result: list[OutputWord] = []
    for token, probability, own, extra in zip(
        prediction.tokens, prediction.probabilities, sources, extras, strict=True
    ):
        if token not in SLOTS:
            said = _typed(words, sorted((*own, *extra)))
            result.append(lexical(token, said, probability))
            continue
        result += [carried(word.lower, word.parts) for place in extra for word in words[place]]
        for word in (word for place in own for word in words[place]):
            if word.kind is WordKind.NUMBER:
                result += number(word.value, word.parts, probability)
            else:
                result += spelled(word.lower, word.parts, probability)
    return result


def _typed(words: Sequence[tuple[Word, ...]], places: Iterable[int]) -> tuple[str, ...]:
    return tuple(part for place in places for word in words[place] for part in word.parts)


def _unclaimed(sources: Sequence[tuple[int, ...]], places: Iterable[int]) -> list[list[int]]:
    """For each gloss the places of words without a gloss that go with it: with the gloss of the next word."""
    owner: dict[int, int] = {}
    for index, own in enumerate(sources):
        for place in own:
            owner.setdefault(place, index)
    result: list[list[int]] = [[] for _ in sources]
    for place in places:
        if place not in owner:
            neighbour = min((p for p in owner if p > place), default=max(owner, default=-1))
            result[owner.get(neighbour, len(sources) - 1)].append(place)
    return result


def load_back_end(name: str, directory: Path, text: Path) -> LstmBackEnd:
    """Load the published model: see `teo_sign_translator.pipeline.back_end.load_other_back_end`."""
    return LstmBackEnd(load_model(name, directory), Phrasebook.load(text), GlossList.load(), name=name)
