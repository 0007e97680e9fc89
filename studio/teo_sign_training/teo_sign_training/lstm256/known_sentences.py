# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Asks the published model, and takes its answer only if the sentence accounts for it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from teo_common.text_folding import strip_marks
from teo_sign_training.corpus.paper_pairs import NAME, NUMBER, SLOTS
from teo_sign_training.lstm256.phrasebook import Match, Phrasebook
from teo_sign_training.lstm256.seq2seq import MARKS, LstmModel, Prediction
from teo_sign_training.lstm256.word_by_word import GlossList
from teo_sign_translator.output.output_words import OutputWord, carried, lexical, number, spelled, unclaimed
from teo_sign_translator.text.reading import Clause, Word, WordKind

#: Confidence in an answer to a sentence outside the training data, times the model's probability: a model
#: that has learned a few sentences by heart is as sure of its mistakes as of them.
UNSEEN_FACTOR = 0.7

#: Probability below which a token of the model is not believed, and the sentence is signed word by word
#: instead: the model would rather say something else.
MIN_PROBABILITY = 0.5


class KnownSentences:
    """Translates sentences of the training data, and others of the same words, with the model."""

    def __init__(self, model: LstmModel, phrasebook: Phrasebook, glosses: GlossList) -> None:
        """Take the parts together.

        Args:
            model: Whose words are those of the phrasebook's sentences.
            phrasebook: Which words a gloss can stand for.
            glosses: Which words have no sign of their own.
        """
        self._model = model
        self._phrasebook = phrasebook
        self._glosses = glosses
        self._inputs = {strip_marks(token): token for token in model.inputs.tokens if token not in SLOTS}

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
        return _output_words(prediction, match.pattern.sources, match.words, factor=1.0)

    def translate_similar(self, words: Sequence[Word], end: str) -> list[OutputWord] | None:
        """Translate a sentence that the model was not trained on, if its answer can be accounted for.

        Args:
            words: The sentence.
            end: Its closing mark.

        Returns:
            Its output words, or None if the model lacks a word, is not sure, says a gloss that no word stands
            for, or leaves out a word that has a sign of its own.
        """
        groups = self._encode(words) if len(words) <= self._phrasebook.longest else None
        if groups is None:
            return None
        prediction = self._believed([token for token, _ in groups if token] + self._mark(end))
        if prediction is None:
            return None
        sources = self._account(prediction.tokens, groups)
        if sources is None:
            return None
        return _output_words(prediction, sources, [group for _, group in groups], factor=UNSEEN_FACTOR)

    def _believed(self, tokens: Sequence[str]) -> Prediction | None:
        """The model's answer, if it is one and the model is sure of it."""
        if not all(token in self._model.inputs for token in tokens):
            return None
        prediction = self._model.predict(tokens)
        sure = prediction.complete and all(p >= MIN_PROBABILITY for p in prediction.probabilities)
        return prediction if sure and prediction.tokens else None

    def _mark(self, end: str) -> list[str]:
        return [end] if end in MARKS and end in self._model.inputs else []

    def _encode(self, words: Sequence[Word]) -> list[tuple[str, tuple[Word, ...]]] | None:
        """Input tokens and the words behind each; the token is empty for a word that the model is not shown.

        None if a word has a sign of its own that the model does not know, or if the model knows no word at
        all.
        """
        groups: list[tuple[str, tuple[Word, ...]]] = []
        for word in words:
            token = self._token(word)
            if token is None or (token and token not in self._model.inputs):
                return None
            if token == NAME and groups and groups[-1][0] == NAME:
                groups[-1] = (NAME, (*groups[-1][1], word))
            else:
                groups.append((token, (word,)))
        return groups if any(token and token not in SLOTS for token, _ in groups) else None

    def _token(self, word: Word) -> str | None:
        if word.kind is WordKind.NUMBER:
            return NUMBER
        known = self._inputs.get(word.key)
        if known is not None:
            return known
        entry = self._glosses.find(word.lower)
        if entry is None:
            return NAME if word.kind is WordKind.LETTERS else None
        return "" if entry.function else None

    def _account(
        self, glosses: Sequence[str], groups: Sequence[tuple[str, tuple[Word, ...]]]
    ) -> list[tuple[int, ...]] | None:
        """For each gloss the places of its groups; None if glosses and words do not fit together."""
        slots = [i for i, (token, _) in enumerate(groups) if token in SLOTS]
        if [groups[i][0] for i in slots] != [gloss for gloss in glosses if gloss in SLOTS]:
            return None
        sources: list[tuple[int, ...]] = []
        for gloss in glosses:
            if gloss in SLOTS:
                sources.append((slots.pop(0),))
                continue
            places = (
                i
                for i, (token, group) in enumerate(groups)
                if token not in SLOTS and self._says(group, gloss)
            )
            sources.append(tuple(places))
        covered = {place for places in sources for place in places}
        left = (group for i, (_, group) in enumerate(groups) if i not in covered)
        return sources if all(sources) and all(map(self._may_be_left, left)) else None

    def _says(self, group: Iterable[Word], gloss: str) -> bool:
        return any(gloss in self._phrasebook.supported(word) for word in group)

    def _may_be_left(self, group: Iterable[Word]) -> bool:
        entries = [self._glosses.find(word.lower) for word in group]
        return all(entry is not None and entry.function for entry in entries)


def _output_words(
    prediction: Prediction,
    sources: Sequence[tuple[int, ...]],
    words: Sequence[tuple[Word, ...]],
    *,
    factor: float,
) -> list[OutputWord]:
    """Output words of a prediction; words that no gloss stands for go with the next one that has a gloss.

    Args:
        prediction: Glosses and slots.
        sources: For each of them the places in `words` that it stands for.
        words: The words of the sentence, several in one place for a name.
        factor: Times the model's probabilities gives the confidence.
    """
    extras = unclaimed(sources, range(len(words)))
    result: list[OutputWord] = []
    for token, probability, own, extra in zip(
        prediction.tokens, prediction.probabilities, sources, extras, strict=True
    ):
        confidence = factor * probability
        if token not in SLOTS:
            said = _typed(words, sorted((*own, *extra)))
            result.append(lexical(token, said, confidence))
            continue
        result += [carried(word.lower, word.parts) for place in extra for word in words[place]]
        for word in (word for place in own for word in words[place]):
            if word.kind is WordKind.NUMBER:
                result += number(word.value, word.parts, confidence)
            else:
                result += spelled(word.lower, word.parts, confidence)
    return result


def _typed(words: Sequence[tuple[Word, ...]], places: Iterable[int]) -> tuple[str, ...]:
    return tuple(part for place in places for word in words[place] for part in word.parts)
