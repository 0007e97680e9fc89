# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What takes long to load, once for all tests of a process, and Spanish sentences as words."""

from __future__ import annotations

from functools import cache

from teo_sign_languages import load_language
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pipeline.translator import DEFAULT_MODEL, Translator
from teo_sign_translator.text.source_word import SourceWord
from teo_sign_translator.text.source_words import source_words

#: What is known of Spanish.
TEXT = load_language("ssp").text


@cache
def morphology() -> Morphology:
    return Morphology.load()


@cache
def translator(name: str = DEFAULT_MODEL) -> Translator:
    return Translator.load(name)


def read(sentence: str) -> tuple[SourceWord, ...]:
    return source_words(sentence, morphology())
