# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What translates in the benches, ours and the baselines to beat, and the sentences that are given to it."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

import simplemma
from spoken_to_signed.text_to_gloss.simple import text_to_gloss

from glosses.accepted_translations import accepted, plain_gloss
from glosses.measures import Glosses
from report import share
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pipeline.translator import Translator

System = Callable[[str], Glosses]
Judged = list[tuple[str, frozenset[Glosses]]]
"""Sentences with the translations that are accepted for each."""

SENTENCES = Path(__file__).parents[3] / "test" / "data"
# What sign languages leave out (lemmas): articles, copulas and auxiliaries, prepositions, "and".
_STOP_WORDS = {
    "es": (
        "el la lo un uno al del ser estar haber a de desde en hacia hasta para por ante con entre según sin "
        "sobre y e"
    ),
    "en": "the a an be do to in at on of and",
}


def systems(ours: Translator | None = None) -> dict[str, System]:
    """By name: our model, the paper's, the trivial baseline and a peer; glosses by their `plain_gloss`.

    Args:
        ours: The shipped translator by default.
    """
    return {
        "ours": _translating(ours or Translator.load()),
        "paper's": _translating(Translator.load("lstm256")),
        "lemmas": lambda sentence: plain(lemmas_in_spanish_order(sentence)),
        "spoken-to-signed": lambda sentence: plain(_spoken_to_signed(sentence)),
    }


def english_systems(language: str) -> dict[str, System]:
    """The model of a language that is written in English, and the trivial baseline."""

    def lemmas(sentence: str) -> Glosses:
        words = _lemmas(sentence.replace("'", ""), "en")
        return tuple(plain_gloss("me" if word == "i" else word) for word in words)

    return {"ours": _translating(Translator.load(language=language)), "lemmas": lemmas}


def lemmas_in_spanish_order(sentence: str) -> Glosses:
    """The trivial baseline: every word's lemma where it stands, stop words dropped."""
    return tuple(lemma.upper() for lemma in _lemmas(sentence, "es"))


def judged(name: str, language: str = DEFAULT_LANGUAGE) -> Judged:
    """The sentences of a set of test/data with the translations that are accepted for each.

    Args:
        name: `known`, `blind` and so on.
        language: Sets of other languages than the default one have a folder with its code.
    """
    place = sentence_set(name, language)
    sentences, patterns = (
        place.with_suffix(suffix).read_text(encoding="utf-8").splitlines() for suffix in (".txt", ".glosses")
    )
    return [(sentence, accepted(pattern)) for sentence, pattern in zip(sentences, patterns, strict=True)]


def sentence_set(name: str, language: str = DEFAULT_LANGUAGE) -> Path:
    """Where a set's two files are, without their suffixes; they need not be there."""
    return (SENTENCES if language == DEFAULT_LANGUAGE else SENTENCES / language) / name


def translating(language: str) -> Mapping[str, System]:
    """What translates into a language: its shipped model, and what it is compared with."""
    return systems() if language == DEFAULT_LANGUAGE else english_systems(language)


def lines(file: str) -> list[str]:
    """Lines of a file of test/data."""
    return (SENTENCES / file).read_text(encoding="utf-8").splitlines()


def right_shares(every: Mapping[str, System], sentences: Judged) -> dict[str, str]:
    """How many sentences each system translates as accepted, as `share` tells it."""
    return {
        name: share(sum(system(sentence) in accepted for sentence, accepted in sentences), len(sentences))
        for name, system in every.items()
    }


def plain(glosses: Glosses) -> Glosses:
    """Glosses as they are compared."""
    return tuple(map(plain_gloss, glosses))


def _lemmas(sentence: str, language: str) -> list[str]:
    lemmas = (simplemma.lemmatize(word, lang=language).lower() for word in re.findall(r"\w+", sentence))
    left_out = _STOP_WORDS[language].split()
    return [lemma for lemma in lemmas if lemma not in left_out]


def _spoken_to_signed(sentence: str) -> Glosses:
    """The peer: spoken-to-signed 0.4 with its only glosser that takes Spanish, without the marks it keeps."""
    return tuple(
        item.gloss.upper()
        for glosses in text_to_gloss(sentence, language="es")
        for item in glosses
        if re.search(r"\w", item.gloss)
    )


def _translating(translator: Translator) -> System:
    def translate(sentence: str) -> Glosses:
        try:
            return plain(tuple(str(translator.translate(sentence)).split()))
        except TranslationError as error:
            return (f"[{error.code}]",)

    return translate
