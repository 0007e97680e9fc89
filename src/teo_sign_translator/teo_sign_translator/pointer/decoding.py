# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From steps of a model to whole translations, greedily or by beam search; and the models' files."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import ThreadpoolController  # type: ignore[import-untyped] # ships no types

from teo_sign_translator.model_files import Weights, read_model, write_model
from teo_sign_translator.pointer.array_model import Array, ArrayModel, Ints, Memory
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.ensemble import Ensemble
from teo_sign_translator.pointer.vocabulary import END_INDEX, READINGS, START_INDEX, Vocabulary
from teo_sign_translator.text.source_word import SourceWord

#: Blanks behind the words in the equal-length layout: glosses that no word says (YO, PASADO, MOTIVO ...).
SPARE = 4
#: Sentences that are read and translated together, to bound memory; more are no faster.
_TOGETHER = 64
#: Times that a translation may say one gloss: twice, with every fourth word once more (a pronoun comes back
#: in each clause), and once more than the sentence has its word. A search that goes round in a circle says
#: one gloss until it is stopped.
_TIMES_SAID = 2
_WORDS_OF_A_CLAUSE = 4
#: Words that a gloss stands for have at least this part of the highest attention: the alignment teaches equal
#: attention to all of them.
_SHARED_LOOK = 0.5


#: Which of a closed list's glosses a sentence's translation must not say.
Unsaid = Callable[[Sequence[SourceWord], Iterable[str]], Collection[str]]


@dataclass(frozen=True, slots=True)
class OutputGloss:
    """One gloss that a model says.

    Attributes:
        gloss: Upper case with accents, `_` for spaces; a number in digits.
        sources: Indices of the words that it stands for, ascending; empty where no word says it.
        probability: Of this gloss, given those before it, 0 to 1.
        copied: Whether it is a word's lemma carried over, not a gloss of the model's own vocabulary.
    """

    gloss: str
    sources: tuple[int, ...]
    probability: float
    copied: bool


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """One translation of a sentence.

    Attributes:
        glosses: In signing order.
        log_probability: Of the whole, the end included [nat]; at most 0.
    """

    glosses: tuple[OutputGloss, ...]
    log_probability: float


class _Choice(NamedTuple):
    """What was said at one step. All of shape (B, K), attention (B, K, W).

    Attributes:
        parent: Row of the step before.
        said: Place in the closed list, or its size + candidate.
        slot: The same, or its size + the first candidate with this gloss.
        probability: Of the gloss.
        attention: On the words.
    """

    parent: Ints
    said: Ints
    slot: Ints
    probability: Array
    attention: Array


@dataclass(frozen=True, slots=True)
class SentenceModel:
    """Translates sentences of words that carry their readings, with any model of the zoo.

    Attributes:
        name: Under which it was loaded.
        arrays: Its weights at work.
    """

    name: str
    arrays: ArrayModel | Ensemble

    def translate(self, words: Sequence[SourceWord], *, beam: int = 1) -> tuple[Hypothesis, ...]:
        """Translate one sentence; raises nothing for words it has never seen.

        Args:
            words: Of `source_words`; none gives one empty hypothesis.
            beam: Hypotheses kept at each step, at least 1; 1 takes the likeliest gloss each time.

        Returns:
            One to `beam` hypotheses, best first.
        """
        return self.translate_all([words], beam=beam)[0]

    def translate_all(
        self,
        sentences: Sequence[Sequence[SourceWord]],
        *,
        beam: int = 1,
        unsaid: Unsaid | None = None,
    ) -> tuple[tuple[Hypothesis, ...], ...]:
        """Translate many sentences, faster than one by one; the results are in their order.

        Args:
            sentences: Their words.
            beam: See `translate`.
            unsaid: Tells what must not be said.
        """
        result: list[tuple[Hypothesis, ...]] = [(Hypothesis((), 0.0),)] * len(sentences)
        by_length: dict[int, list[int]] = {}
        for index, words in enumerate(sentences):
            if words:
                by_length.setdefault(len(words), []).append(index)
        groups = (
            indices[start : start + _TOGETHER]
            for indices in by_length.values()
            for start in range(0, len(indices), _TOGETHER)
        )
        with one_core():
            for some in groups:
                chosen = [sentences[index] for index in some]
                if self.arrays.config.layout == "equal_length":
                    translated = _at_positions(self.arrays, chosen)
                else:
                    translated = search(self.arrays, chosen, max(1, beam), unsaid)
                for index, hypotheses in zip(some, translated, strict=True):
                    result[index] = hypotheses
        return tuple(result)


def search(
    model: ArrayModel | Ensemble,
    sentences: Sequence[Sequence[SourceWord]],
    beam: int,
    unsaid: Unsaid | None = None,
) -> list[tuple[Hypothesis, ...]]:
    """Beam search over sentences that have the same number of words.

    Glosses that can be said in several ways count once, with all their probability. The first row of each
    beam is the likeliest gloss each time, kept whatever it scores, so that a beam never ends below it.
    """
    memory = model.encode(sentences)
    count, width = memory.words.shape[:2]
    size = len(model.vocabulary.glosses)
    states = tuple(np.repeat(state, beam, axis=0) for state in memory.first)
    score = np.full((count, beam), -np.inf, np.float32)
    score[:, 0] = 0
    ended = np.zeros((count, beam), np.bool_)
    said = np.full((count, beam), START_INDEX)
    choices: list[_Choice] = []
    row = np.arange(count)[:, None]
    allowed = _allowed(memory, size)
    if unsaid:
        closed = model.vocabulary.glosses[START_INDEX + 1 :]
        for index, words in enumerate(sentences):
            allowed[index, [model.vocabulary.gloss_index[gloss] for gloss in unsaid(words, closed)]] = 0
    left = np.repeat(allowed[:, None], beam, axis=1)
    # Twice the words: pronoun, tense and question add glosses. One more step tells what would go on.
    for _ in range(2 * (width - 1) + 1):
        step = model.step(memory, said.ravel(), states)
        options = step.probability.shape[1]
        with np.errstate(divide="ignore"):
            following = np.log(step.probability).reshape(count, beam, options)
        following[..., START_INDEX] = -np.inf  # never said, only read
        following[left <= 0] = -np.inf
        following[ended] = -np.inf
        following[ended, END_INDEX] = 0  # what has ended stays as it is
        total = (score[..., None] + following).reshape(count, beam * options)
        best = _best(total, following[:, 0].argmax(axis=1), beam)
        parent, slot = np.divmod(best, options)
        score = total[row, best]
        rows = parent + row * beam
        attention = step.attention[rows]
        said = _said(slot, step.candidates[rows], memory, size) if model.config.copy else slot
        probability = np.exp(following.reshape(count, -1)[row, best])
        choices.append(_Choice(parent, said, slot, probability, attention))
        states = tuple(state[rows.ravel()] for state in step.states)
        left = left[row, parent]
        left[row, np.arange(beam), slot] -= 1
        ended = slot == END_INDEX
        if ended.all():
            break
    return [_hypotheses(model, memory, choices, index, score[index], ended[index]) for index in range(count)]


def _allowed(memory: Memory, size: int) -> Ints:
    """How often each gloss may be said in each sentence; the end always. Shape (B, options)."""
    count, width = memory.words.shape[:2]
    words: Ints = np.zeros((count, size + memory.slots.shape[1]), np.int64)
    np.add.at(words, (np.arange(count)[:, None], memory.slots[:, ::READINGS]), 1)
    words = np.maximum(words + 1, max(_TIMES_SAID, (width - 1) // _WORDS_OF_A_CLAUSE))
    words[:, END_INDEX] = np.iinfo(np.int64).max
    return words


def _best(total: Array, greedy: Ints, beam: int) -> Ints:
    """The best `beam` places of each row, the likeliest continuation of the first row of the beam first."""
    if beam == 1:
        return greedy[:, None]
    row = np.arange(len(total))[:, None]
    places = np.argpartition(total, -beam, axis=1)[:, -beam:]
    order = places[row, np.argsort(-total[row, places], axis=1)]
    result: Ints = np.empty((len(total), beam), np.int64)
    for index, first in enumerate(greedy):
        others = [place for place in order[index] if place != first]
        result[index] = [first, *others[: beam - 1]]
    return result


def _said(slot: Ints, candidates: Array, memory: Memory, size: int) -> Ints:
    """Of several candidates with one gloss the likeliest; candidates of shape (B, K, C)."""
    same = memory.slots[:, None] == slot[..., None]
    likeliest = np.where(same, candidates, -1.0).argmax(axis=2)
    result: Ints = np.where(slot < size, slot, size + likeliest)
    return result


def _hypotheses(
    model: ArrayModel | Ensemble,
    memory: Memory,
    choices: Sequence[_Choice],
    index: int,
    score: Array,
    ended: NDArray[np.bool_],
) -> tuple[Hypothesis, ...]:
    """The translations of one sentence, best first; those that did not end only if none did."""
    found: dict[tuple[str, ...], Hypothesis] = {}
    for beam in np.argsort(-score, kind="stable"):
        if not np.isfinite(score[beam]) or (ended.any() and not ended[beam]):
            continue
        glosses: list[OutputGloss] = []
        place = int(beam)
        for choice in reversed(choices):
            if choice.slot[index, place] != END_INDEX:
                glosses.append(_gloss(model, memory, choice, index, place))
            place = int(choice.parent[index, place])
        glosses.reverse()
        key = tuple(each.gloss for each in glosses)
        found.setdefault(key, Hypothesis(tuple(glosses), min(0.0, float(score[beam]))))
    return tuple(found.values())


def _gloss(
    model: ArrayModel | Ensemble, memory: Memory, choice: _Choice, index: int, place: int
) -> OutputGloss:
    size = len(model.vocabulary.glosses)
    said = int(choice.said[index, place])
    looked = sources(choice.attention[index, place])
    probability = min(1.0, float(choice.probability[index, place]))
    if said < size:
        return OutputGloss(model.vocabulary.glosses[said], looked, probability, copied=False)
    word = (said - size) // READINGS - 1
    gloss = memory.glosses[index][said - size]
    return OutputGloss(gloss, tuple(sorted({*looked, word})), probability, copied=True)


def sources(attention: Array) -> tuple[int, ...]:
    """The words that attention lies on; none if it lies on the root (place 0) most of all."""
    if not len(attention) or attention.argmax() == 0:
        return ()
    return tuple(
        int(place) - 1 for place in np.flatnonzero(attention >= _SHARED_LOOK * attention.max()) if place
    )


def _at_positions(
    model: ArrayModel | Ensemble, sentences: Sequence[Sequence[SourceWord]]
) -> list[tuple[Hypothesis, ...]]:
    """The equal-length layout: the likeliest gloss at each position, up to the first END."""
    probability = model.positions(model.encode(sentences, SPARE))
    probability[..., START_INDEX] = 0
    likeliest = probability.argmax(axis=2)
    result: list[tuple[Hypothesis, ...]] = []
    for row, places in enumerate(likeliest):
        ends = np.flatnonzero(places == END_INDEX)
        stop = int(ends[0]) if len(ends) else len(places)
        chances = probability[row, np.arange(len(places)), places]
        glosses = tuple(
            OutputGloss(model.vocabulary.glosses[gloss], (), float(chance), copied=False)
            for gloss, chance in zip(places[:stop], chances[:stop], strict=True)
        )
        result.append((Hypothesis(glosses, float(np.log(chances[: stop + 1]).sum())),))
    return result


def one_core() -> AbstractContextManager[object]:
    """Let BLAS use one thread inside the `with`, and as many as before behind it (8 µs).

    The products of one sentence are so small that sharing them out costs more than it gains, and on a busy
    machine each waits for its slowest part: 46 ms a sentence were measured where one core took 3.
    """
    limiter: AbstractContextManager[object] = _blas().limit(limits=1)
    return limiter


@cache
def _blas() -> ThreadpoolController:
    return ThreadpoolController().select(user_api="blas")


#: Of the cards of sentence models.
SCHEMA = 2
# Of a card: the lists that number the words and glosses.
_LISTS = "lexis"


def load_sentence_model(name: str, directory: Path | None = None) -> SentenceModel:
    """Load a sentence model; arguments and errors are those of `model_files.read_model`."""

    def build(card: dict[str, Any], weights: Weights) -> SentenceModel:
        vocabulary = Vocabulary.from_dict(card[_LISTS])
        config = NetworkConfig(**card["network"])
        kind = ArrayModel if config.members == 1 else Ensemble
        return SentenceModel(name, kind(config, vocabulary, weights))

    return read_model(name, SCHEMA, directory, build)


def save_sentence_model(
    name: str,
    directory: Path,
    *,
    config: NetworkConfig,
    vocabulary: Vocabulary,
    weights: Weights,
    card: Mapping[str, Any],
) -> None:
    """Write weights, in half precision, and card.

    Args:
        name: Of the model and its two files.
        directory: Made if it is missing.
        config: Goes into the card.
        vocabulary: Likewise, in the order of the weights' rows.
        weights: As `ArrayModel` takes them.
        card: What else the card says.
    """
    content = {**card, "network": dataclasses.asdict(config), _LISTS: vocabulary.as_dict()}
    write_model(name, directory, SCHEMA, weights, content, indent=None)
