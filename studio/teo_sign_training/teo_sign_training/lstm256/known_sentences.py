# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Asks the published model, and takes its answer only if the sentence accounts for it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from teo_sign_training.corpus.paper_pairs import SLOTS
from teo_sign_training.lstm256.phrasebook import Match
from teo_sign_training.lstm256.seq2seq import MARKS, LstmModel, Prediction
from teo_sign_translator.output.output_words import OutputWord, carried, lexical, number, spelled, unclaimed
from teo_sign_translator.text.reading import Clause, Word, WordKind

#: Probability below which a token of the model is not believed, and the sentence is signed word by word
#: instead: the model would rather say something else.
MIN_PROBABILITY = 0.5


class KnownSentences:
    """Translates sentences of the training data with the model."""

    def __init__(self, model: LstmModel) -> None:
        """Take the model."""
        self._model = model

    def translate(self, match: Match, clauses: Sequence[Clause]) -> list[OutputWord] | None:
        """Translate a sentence of the training data.

        Args:
            match: The sentence.
            clauses: Where it was found; their marks go to the model with it.

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
        sure = prediction.complete and all(p >= MIN_PROBABILITY for p in prediction.probabilities)
        return prediction if sure and prediction.tokens else None

    def _mark(self, end: str) -> list[str]:
        return [end] if end in MARKS and end in self._model.inputs else []


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
    extras = unclaimed(sources, range(len(words)))
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
