# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What translates in the benches, ours and the baselines to beat, and the sentences that are given to it."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import simplemma
from spoken_to_signed.text_to_gloss.simple import text_to_gloss

from glosses.accepted_translations import accepted, plain_gloss
from glosses.measures import Glosses
from teo_sign_languages import load_language
from teo_sign_translator.data_files import read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pipeline.translator import Translator

System = Callable[[str], Glosses]
Judged = list[tuple[str, frozenset[Glosses]]]
"""Sentences with the translations that are accepted for each."""

SENTENCES = Path(__file__).parents[3] / "test" / "data"
# Of a language's text folder: sentence, accepted glosses, `blind` or `known`, and where it is published.
_PUBLISHED = "published_sentences.tsv"
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


def judged(name: str) -> Judged:
    """The sentences of a file of test/data with the translations that are accepted for each."""
    pairs = zip(lines(f"{name}.txt"), lines(f"{name}.glosses"), strict=True)
    return [(sentence, accepted(pattern)) for sentence, pattern in pairs]


def published(language: str, status: str) -> Judged:
    """Sentences of a language whose translation somebody else has published.

    Args:
        language: Its code.
        status: "blind", or "known" for those that were looked at while the grammar was written.
    """
    rows = read_rows(load_language(language).text / _PUBLISHED, columns=4)
    return [(sentence, accepted(pattern)) for _, (sentence, pattern, kind, _) in rows if kind == status]


def lines(file: str) -> list[str]:
    """Lines of a file of test/data."""
    return (SENTENCES / file).read_text(encoding="utf-8").splitlines()


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
