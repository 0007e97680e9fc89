# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What others make of a Spanish sentence: the baselines that a translator has to beat."""

from __future__ import annotations

import re

import simplemma
from spoken_to_signed.text_to_gloss.simple import text_to_gloss

# What LSE leaves out: articles, copulas and auxiliaries, prepositions, "y" (lemmas).
_ARTICLES = ("el", "la", "lo", "un", "uno", "al", "del")
_VERBS = ("ser", "estar", "haber")
_TO_AND_FROM = ("a", "de", "desde", "en", "hacia", "hasta", "para", "por")
_WITH_AND_OTHERS = ("ante", "con", "entre", "según", "sin", "sobre")
_STOP_WORDS = frozenset((*_ARTICLES, *_VERBS, *_TO_AND_FROM, *_WITH_AND_OTHERS, "y", "e"))


def lemmas_in_spanish_order(sentence: str) -> tuple[str, ...]:
    """The trivial baseline: every word's lemma where it stands, stop words dropped."""
    lemmas = (simplemma.lemmatize(word, lang="es").lower() for word in re.findall(r"\w+", sentence))
    return tuple(lemma.upper() for lemma in lemmas if lemma not in _STOP_WORDS)


def spoken_to_signed(sentence: str) -> tuple[str, ...]:
    """The peer: spoken-to-signed 0.4 with its only glosser that takes Spanish, without the marks it keeps."""
    return tuple(
        item.gloss.upper()
        for glosses in text_to_gloss(sentence, language="es")
        for item in glosses
        if re.search(r"\w", item.gloss)
    )
