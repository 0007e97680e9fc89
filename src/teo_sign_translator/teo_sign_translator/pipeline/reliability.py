# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How likely the translation of a whole sentence is right.

The model says how sure it is of each gloss; that a long sentence, or one of several verbs, is right in all
its parts is less likely than that. A logistic regression on the known sentences says by how much (bench
`glosses.reliability`).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import tanh

from teo_sign_translator.pipeline.pipeline_words import ReliabilityWeights
from teo_sign_translator.text.source_word import SourceWord

#: A gloss less likely than this is a doubt; the others are as sure as the model can be.
_SURE = 0.99


def features(words: Sequence[SourceWord], confidences: Sequence[float]) -> tuple[float, ...]:
    """What tells it: the least confidence, doubts, glosses, verbs, adjectives.

    Args:
        words: Of the sentence.
        confidences: Of what is signed, at least one, 0 to 1.
    """
    tags = [word.tag for word in words]
    return (
        min(confidences),
        sum(confidence < _SURE for confidence in confidences),
        len(confidences),
        sum(tag.startswith("V:") for tag in tags),
        sum(tag.startswith("A:") for tag in tags),
    )


def reliability(values: Sequence[float], weights: ReliabilityWeights) -> float:
    """How likely a translation with some features is right, 0 to 1."""
    slopes = (weights.least, weights.doubt, weights.gloss, weights.verb, weights.adjective)
    logit = weights.base + sum(slope * value for slope, value in zip(slopes, values, strict=True))
    return (1.0 + tanh(logit / 2.0)) / 2.0  # the logistic function, which has no overflow so
