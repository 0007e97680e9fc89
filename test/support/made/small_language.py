# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A language small enough to be learned in a second, and models that learn it."""

from __future__ import annotations

import dataclasses
import random
from collections.abc import Sequence
from typing import Any

import torch

from teo_sign_training.corpus import Pair
from teo_sign_training.fitting.fitting import ZOO, Fit, TrainingConfig, fit
from teo_sign_translator.morphology import Reading
from teo_sign_translator.pointer import Hypothesis
from teo_sign_translator.pointer.array_model import ArrayModel
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.decoding import SentenceModel
from teo_sign_translator.text.source_word import SourceWord

NOUNS = ("pan", "vaso", "libro", "coche", "gato", "perro")
VERBS = ("com", "beb", "le", "vend")
ENDINGS = {"o": ("1s", "YO"), "es": ("2s", "TÚ")}


def read(sentence: str) -> tuple[SourceWord, ...]:
    """A language small enough to be learned in a second: name or ending, article, noun, verb."""
    return tuple(_word(word, bool(place)) for place, word in enumerate(sentence.split()))


def _word(word: str, inside: bool) -> SourceWord:
    return SourceWord(word, word.lower(), inside and word[0].isupper(), _readings(word))


def _readings(word: str) -> tuple[Reading, ...]:
    if word in NOUNS:
        return (Reading(word, "N:ms"),)
    if word[:-1] in NOUNS and word.endswith("s"):
        return (Reading(word[:-1], "N:mp"),)
    for stem in VERBS:
        for ending, (person, _) in ENDINGS.items():
            if word == stem + ending:
                return (Reading(f"{stem}er", f"V:ind:pres:{person}"), Reading(word, "N:ms", (), False))
        if word == f"{stem}e":
            return (Reading(f"{stem}er", "V:ind:pres:3s"),)
    if word in ("el", "los", "no"):
        return (Reading(word, {"no": "ADV:neg"}.get(word, "DET:def")),)
    if word == ".":
        return (Reading(word, "MARK"),)
    return (Reading(word, "NAME" if word[0].isupper() else "X", (), False),)


def _pair(rng: random.Random) -> Pair:
    """Subject, object (repeated in the plural), verb, negation last."""
    words: list[str] = []
    verb, noun = rng.choice(VERBS), rng.choice(NOUNS)
    named, negated, plural = rng.random() < 0.5, rng.random() < 0.3, rng.random() < 0.3
    if named:
        words.append(rng.choice(("Ana", "Eva", "Leo", "Sol", "Gil")))
    words += ["no"] * negated
    ending = "e" if named else rng.choice(tuple(ENDINGS))
    words.append(verb + ending)
    at = len(words) - 1
    words += ["los" if plural else "el", noun + "s" * plural, "."]
    glosses = [(words[0].upper(), (0,))] if named else [(ENDINGS[ending][1], (at,))]
    glosses += [(noun.upper(), (at + 2,))] * (1 + plural)
    glosses += [(f"{verb}er".upper(), (at,)), *[("NO", (at - 1,))] * negated]
    return Pair(" ".join(words), tuple(g for g, _ in glosses), tuple(s for _, s in glosses), "paper", "train")


def sentence_pairs(count: int, seed: int = 1) -> list[Pair]:
    rng = random.Random(seed)
    return [_pair(rng) for _ in range(count)]


def small_config(name: str) -> NetworkConfig:
    return dataclasses.replace(ZOO[name], hidden=32, embedding=24, members=1)


def fit_small(name: str, pairs: Sequence[Pair], **training: Any) -> Fit:
    chosen = {
        "batch_size": 16,
        "learning_rate": 0.01,
        "dropout": 0.0,
        "rare_word": 0.0,
        "clean": 1.0,
    } | training
    device = torch.device("cpu")  # the same on every machine
    return fit(pairs, [], [], read, small_config(name), TrainingConfig(**chosen), device=device)


def small_model(name: str, trained: Fit) -> SentenceModel:
    return SentenceModel(name, ArrayModel(small_config(name), trained.vocabulary, trained.weights))


def glosses_of(hypothesis: Hypothesis) -> tuple[str, ...]:
    return tuple(each.gloss for each in hypothesis.glosses)
