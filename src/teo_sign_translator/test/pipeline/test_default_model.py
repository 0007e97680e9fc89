# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the default model must do whatever it has learned: paper, names, numbers, any typing."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable

import pytest

from teo_sign_training.corpus.paper_pairs import paper_pairs
from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.pipeline.translator import Translator

WAYS_OF_TYPING: dict[str, Callable[[str], str]] = {
    "as published": lambda text: text,
    "without accents": lambda text: "".join(
        c for c in unicodedata.normalize("NFD", text) if unicodedata.category(c) != "Mn"
    ),
    "without accents and marks": lambda text: re.sub(
        r"[¿?¡!,.…]",
        "",
        "".join(c for c in unicodedata.normalize("NFD", text) if unicodedata.category(c) != "Mn"),
    ),
    "without marks": lambda text: re.sub(r"[¿?¡!,.…]", "", text),
    "without opening marks": lambda text: re.sub("[¿¡]", "", text),
    "decomposed": lambda text: unicodedata.normalize("NFD", text),
    "with repeated marks": lambda text: text.replace("?", "???").replace("!", "!!"),
    "with blanks around": lambda text: f"  {text}\t\n",
    "with an emoji": lambda text: text + " 😀",
}


@pytest.fixture(scope="module")
def default() -> Translator:
    return Translator.load()


@pytest.mark.parametrize("way", WAYS_OF_TYPING)
def test_the_papers_39_sentences_are_exact(default: Translator, way: str) -> None:
    expected = {pair.sentence: " ".join(map(gloss_name, pair.glosses)) for pair in paper_pairs()}
    got = {sentence: str(default.translate(WAYS_OF_TYPING[way](sentence))) for sentence in expected}
    assert got == expected


@pytest.mark.parametrize(
    ("text", "glosses"),
    [
        ("Me llamo Ana", "MI NOMBRE A-N-A"),
        ("Hola, me llamo Ana. ¿Qué tal?", "HOLA MI NOMBRE A-N-A TÚ BIEN"),
        ("Me llamo Guillermo", "MI NOMBRE G-U-I-LL-E-R-M-O"),
        ("Me llamo Al.", "MI NOMBRE A-L"),
        ("¿Quién es Ana?", "A-N-A QUIÉN"),
        ("Tengo treinta y cinco años", "YO EDAD 35"),
        ("Mi correo es eva@uc3m.es", "CORREO MI E-V-A ARROBA U-C 3 M PUNTO E-S"),
    ],
)
def test_names_are_spelled_and_numbers_counted(default: Translator, text: str, glosses: str) -> None:
    assert str(default.translate(text)) == glosses


def test_an_unseen_sentence_is_signed_in_the_order_of_lse(default: Translator) -> None:
    assert str(default.translate("Mañana no voy al médico.")) == "MAÑANA YO MÉDICO IR NO"


def test_words_that_no_list_holds_are_carried_over(default: Translator) -> None:
    glosses = str(default.translate("Mañana compro un flinflú.")).split()
    assert "FLINFLÚ" in glosses or "F-L-I-N-F-L-U" in glosses


def test_what_makes_no_sentence_is_called_uncertain(default: Translator) -> None:
    (sentence,) = default.translate("blim porque cuyo tras ñofu grabitón").sentences
    assert sentence.uncertain
