# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Back end of the published model: known sentences from the model, everything else word by word."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_sign_training.lstm256.known_sentences import KnownSentences
from teo_sign_training.lstm256.phrasebook import Match, Phrasebook
from teo_sign_training.lstm256.seq2seq import LstmModel, load_model
from teo_sign_training.lstm256.word_by_word import GlossList, word_by_word
from teo_sign_translator.output.output_words import PAUSE, OutputWord
from teo_sign_translator.pipeline.back_end import TranslatedSentence
from teo_sign_translator.text.reading import Clause, SentenceType, Word

# Clauses that are tried as one sentence of the training data; "Venga, levántate, que tienes que ir al
# colegio" has three.
_MOST_CLAUSES = 4


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
        self._sentences = KnownSentences(model)
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
            output_words = self._sentences.translate(match, run) if match else None
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
                translated = self._sentences.translate(piece, [clause])
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


def _assembled(units: Sequence[_Unit]) -> TranslatedSentence:
    output_words: list[OutputWord] = []
    for unit in units:
        output_words += [*([PAUSE] if output_words else []), *unit.output_words]
    return TranslatedSentence(
        [clause for unit in units for clause in unit.clauses], output_words, units[-1].known
    )


def load_back_end(name: str, directory: Path, text: Path) -> LstmBackEnd:
    """Load the published model: see `teo_sign_translator.pipeline.back_end.load_other_back_end`."""
    return LstmBackEnd(load_model(name, directory), Phrasebook.load(text), GlossList.load(), name=name)
