# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Of the known sentences, are as many right as the translator says are likely to be?

Each fifth is judged by weights of the others; weights of all are those for a language's `pipeline.yaml`.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from scipy.optimize import minimize

from glosses.systems import judged, plain
from report import Figure, share
from teo_common.arrays import Array
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.output.translation import Kind
from teo_sign_translator.pipeline.reliability import features
from teo_sign_translator.pipeline.translator import Translator
from teo_sign_translator.text.source_words import source_words

_PARTS = 5
_BINS = (0.0, 0.5, 0.7, 0.8, 0.9, 1.0)


def measure(language: str = DEFAULT_LANGUAGE) -> Iterator[Figure]:
    """The weights, and what they are worth."""
    translator, morphology = Translator.load(language=language), Morphology.load(load_language(language).text)
    rows, right = [], []
    for text, accepted in judged("known", language):
        answer = translator.translate(text)
        tokens = [token for sentence in answer.sentences for token in sentence.tokens]
        words = {(token.word_index, token.kind): token.confidence for token in tokens}
        sure = [confidence for (_, kind), confidence in words.items() if kind is not Kind.PAUSE]
        rows.append((1.0, *features(source_words(text, morphology), sure)))
        right.append(plain(tuple(str(answer).split())) in accepted)
    values, is_right = np.array(rows), np.array(right)
    names = ("base", "least", "doubt", "gloss", "verb", "adjective")
    found = _weights(values, is_right)
    yield Figure(
        "weights", ", ".join(f"{name}: {weight:.2f}" for name, weight in zip(names, found, strict=True))
    )
    order = np.random.default_rng(0).permutation(len(values))
    likely = np.zeros(len(values))
    for part in range(_PARTS):
        judged_now = order[part::_PARTS]
        others = np.setdiff1d(order, judged_now)
        likely[judged_now] = _likely(values[judged_now], _weights(values[others], is_right[others]))
    for low, high in pairwise(_BINS):
        those = is_right[(likely >= low) & (likely < high)]
        yield Figure(
            f"right of those said to be likely, {low} to {high}", share(int(those.sum()), len(those))
        )


def _likely(values: Array, weights: Array) -> Array:
    likely: Array = 1.0 / (1.0 + np.exp(-(values @ weights)))
    return likely


def _weights(values: Array, right: Array) -> Array:
    """Of the greatest likelihood, drawn towards none by a unit of it (ridge)."""

    def cost(weights: Array) -> float:
        logits = values @ weights
        return float(
            np.logaddexp(0.0, np.where(right, -logits, logits)).sum() + 0.5 * (weights[1:] ** 2).sum()
        )

    found: Array = minimize(cost, np.zeros(values.shape[1])).x
    return found
