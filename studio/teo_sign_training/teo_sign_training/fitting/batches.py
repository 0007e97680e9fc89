# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Pairs of equal length together, as the arrays that a network learns from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from teo_sign_training.fitting.examples import BLANK_ROW, ROOT_ROW, Examples, Ints, WordTable, copies
from teo_sign_translator.pointer.vocabulary import END_INDEX, READINGS, START_INDEX, UNKNOWN_TAG, Vocabulary

#: Places of "unknown" in the lists of forms and lemmas.
_UNKNOWN_FORM, _UNKNOWN_LEMMA = 0, 1

#: Arrays, or tensors on the device that trains.
Values = TypeVar("Values")


@dataclass(frozen=True, slots=True)
class Batch(Generic[Values]):
    """Pairs with the same number of words W (the root and blanks included), up to T glosses (END included).

    Attributes:
        forms: Shape (B, W).
        capitals: Shape (B, W).
        lemmas: Shape (B, W, READINGS).
        tags: Shape (B, W, READINGS).
        said: Closed gloss before each gloss (START at first); -1 for a copied one. Shape (B, T).
        said_copy: The candidate `word * READINGS + reading` that was copied there, else 0. Shape (B, T).
        target: Place of each gloss in the closed list; -1 if it is not in it. Shape (B, T).
        ways: Which candidates copy the gloss. Shape (B, T, W * READINGS).
        looks: Where attention should lie: evenly on the words that the gloss stands for, else on the root.
            Shape (B, T, W).
        weight: 1 for each gloss, 0 behind the end. Shape (B, T).
    """

    forms: Values
    capitals: Values
    lemmas: Values
    tags: Values
    said: Values
    said_copy: Values
    target: Values
    ways: Values
    looks: Values
    weight: Values


@dataclass(frozen=True)
class WordNumbers:
    """For each word of a `WordTable` its places in the lists of a `Vocabulary`.

    Attributes:
        forms: Shape (rows,).
        capitals: Shape (rows,).
        lemmas: Shape (rows, READINGS).
        tags: Shape (rows, READINGS).
        glosses: Place of each of the table's glosses in the closed list, -1 if it is not in it.
        form_counts: Occurrences of each form in the training pairs. Shape (forms,).
        lemma_counts: Of each lemma. Shape (lemmas,).
        nouns: Which tags are those of nouns. Shape (tags,).
        unknown_tag: Place of the tag of a word of which nothing is known.
    """

    forms: Ints
    capitals: Ints
    lemmas: Ints
    tags: Ints
    glosses: Ints
    form_counts: Ints
    lemma_counts: Ints
    nouns: NDArray[np.bool_]
    unknown_tag: int

    @classmethod
    def of(cls, table: WordTable, vocabulary: Vocabulary, examples: Examples) -> WordNumbers:
        """Look the words up."""
        features = [vocabulary.features(word) for word in table.words if word is not None]
        root, blank = vocabulary.forms.index("<root>"), vocabulary.forms.index("<blank>")
        none = [0] * READINGS
        forms = np.array([root, blank, *(f.form for f in features)], np.int64)
        lemmas = np.array([none, none, *(f.lemmas for f in features)], np.int64)
        occurrences = np.bincount(examples.words, minlength=len(table.words))
        return cls(
            forms,
            np.array([0, 0, *(f.capital for f in features)], np.int64),
            lemmas,
            np.maximum(np.array([none, none, *(f.tags for f in features)], np.int64), 0),
            np.array([vocabulary.gloss_index.get(gloss, -1) for gloss in table.glosses], np.int64),
            np.bincount(forms, occurrences, len(vocabulary.forms)).astype(np.int64),
            np.bincount(lemmas.ravel(), np.repeat(occurrences, READINGS), len(vocabulary.lemmas)).astype(
                np.int64
            ),
            np.array([key.startswith("N:") for key in vocabulary.tags]),
            vocabulary.tag_index[UNKNOWN_TAG],
        )


def batches(
    examples: Examples,
    table: WordTable,
    numbers: WordNumbers,
    size: int,
    *,
    random: np.random.Generator | None = None,
    rare_word: float = 0.0,
    spare: int = 0,
) -> Iterator[Batch[NDArray[Any]]]:
    """All pairs, those of the same number of words together.

    Args:
        examples: The pairs, as typed.
        table: Their words.
        numbers: The same in the model's lists.
        size: Most pairs of a batch.
        random: Shuffles the pairs and batches and hides words; none for a fixed order.
        rare_word: See `TrainingConfig`; needs `random`.
        spare: Blanks behind the words (the equal-length layout).
    """
    lengths = np.diff(examples.word_start)
    gloss_counts = np.diff(examples.gloss_start)
    # Within a length, similar numbers of glosses go together; the fraction shuffles equals.
    fraction = random.random(len(lengths)) if random else np.zeros(len(lengths))
    order = np.lexsort((gloss_counts + 2 * fraction, lengths))
    cuts = np.flatnonzero(np.diff(lengths[order])) + 1
    parts = [
        group[start : start + size] for group in np.split(order, cuts) for start in range(0, len(group), size)
    ]
    for part in random.permutation(len(parts)) if random else range(len(parts)):
        yield _batch(examples.take(parts[part]), table, numbers, random, rare_word, spare)


def _batch(
    examples: Examples,
    table: WordTable,
    numbers: WordNumbers,
    random: np.random.Generator | None,
    rare_word: float,
    spare: int,
) -> Batch[NDArray[Any]]:
    count = len(examples)
    length = int(examples.word_start[1])
    rows = np.full((count, 1 + length + spare), BLANK_ROW)
    rows[:, 0] = ROOT_ROW
    rows[:, 1 : 1 + length] = examples.words.reshape(count, length)
    width = rows.shape[1]
    forms, lemmas, tags = numbers.forms[rows], numbers.lemmas[rows], numbers.tags[rows]
    if random is not None and rare_word > 0:
        forms, lemmas, tags = _hide(forms, lemmas, tags, numbers, random, rare_word)

    gloss_counts = np.diff(examples.gloss_start)
    steps = int(gloss_counts.max(initial=0)) + 1
    pair = np.repeat(np.arange(count), gloss_counts)
    step = np.arange(len(pair)) - np.repeat(examples.gloss_start[:-1], gloss_counts)
    target = np.full((count, steps), -1)
    target[pair, step] = numbers.glosses[examples.glosses]
    target[np.arange(count), gloss_counts] = END_INDEX

    link_pair = pair[examples.link_gloss]
    link_step = step[examples.link_gloss]
    link_word = examples.link_word - examples.word_start[link_pair] + 1
    ways = np.zeros((count, steps, width * READINGS), np.bool_)
    link, reading = np.nonzero(copies(examples, table))
    candidate = link_word[link] * READINGS + reading
    ways[link_pair[link], link_step[link], candidate] = True
    looks = np.zeros((count, steps, width), np.float32)
    looks[link_pair, link_step, link_word] = 1
    looks[:, :, 0] = looks.sum(axis=2) == 0
    looks /= looks.sum(axis=2, keepdims=True)

    said = np.full((count, steps), START_INDEX)
    said[:, 1:] = target[:, :-1]
    said_copy = np.zeros((count, steps), np.int64)
    said_copy[:, 1:] = ways.argmax(axis=2)[:, :-1]
    weight = (np.arange(steps) <= gloss_counts[:, None]).astype(np.float32)
    return Batch(
        forms, numbers.capitals[rows], lemmas, tags,
        said, said_copy, target, ways, looks, weight,
    )  # fmt: skip


def _hide(
    forms: Ints,
    lemmas: Ints,
    tags: Ints,
    numbers: WordNumbers,
    random: np.random.Generator,
    rare_word: float,
) -> tuple[Ints, Ints, Ints]:
    """Show rare words as unknown: the form, and sometimes its lemmas with it.

    Half of the nouns that are hidden are tagged as a word of which nothing is known ("whatsapp"), too.
    """
    draw = random.random(forms.shape)
    form_odds = rare_word / (rare_word + numbers.form_counts)
    lemma_odds = rare_word / (rare_word + numbers.lemma_counts)
    lemma_odds[0] = form_odds[1:3] = 0  # no reading stays no reading, root and blank what they are
    # The commonest reading decides, or a word would be hidden because it may also be something rare.
    together = np.where(lemmas > 0, lemma_odds[lemmas], 1.0).min(axis=-1)
    hide = (draw < together) & (lemmas[..., 0] > 0)
    untag = hide & (draw < together / 2) & (lemmas[..., 1] == 0) & numbers.nouns[tags[..., 0]]
    tags = tags.copy()
    tags[untag, 0] = numbers.unknown_tag
    return (
        np.where(draw < form_odds[forms], _UNKNOWN_FORM, forms),
        np.where(hide[..., None] & (lemmas > 0), _UNKNOWN_LEMMA, lemmas),
        tags,
    )
