# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Dividing a sentence that is too much for the model."""

from __future__ import annotations

import pytest
from word_by_word_model import MORPHOLOGY, WordByWordModel

from teo_sign_translator.pipeline.hypothesis_repair import HypothesisRepair
from teo_sign_translator.pipeline.long_sentences import MOST_WORDS, parts, pieces
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.source_words import source_words

JOINTS = TextRules.load().sentences.joints


@pytest.mark.parametrize(
    ("sentence", "expected"),
    [
        ("Me llamo Lucía y vivo en Madrid.", "me llamo lucía | vivo en madrid ."),
        ("Compro pan y leche.", "compro pan y leche ."),
        ("Soy de Sevilla, pero trabajo en Roma.", "soy de sevilla , | pero trabajo en roma ."),
        ("Hola, ¿vienes?", "hola , | vienes ?"),
        ("Canto y bebo y duermo", "canto | bebo | duermo"),
        ("y", "y"),
        ("Hola", "hola"),
    ],
)
def test_a_sentence_is_divided_at_marks_and_between_verbs(sentence: str, expected: str) -> None:
    words = source_words(sentence, MORPHOLOGY)
    got = [" ".join(word.form for word in words[piece.start : piece.stop]) for piece in pieces(words, JOINTS)]
    assert " | ".join(got) == expected


@pytest.mark.parametrize("text", ["hola " * 200, "hola, " * 200, "hola, " * 10 + "a b " * 40, "hola " * 40])
def test_no_part_is_longer_than_the_model_has_seen_and_none_is_lost(text: str) -> None:
    words = source_words(text, MORPHOLOGY)
    divided = parts(words)
    assert all(0 < len(part) <= MOST_WORDS for part in divided)
    assert [word for part in divided for word in part] == list(words)


def test_pieces_are_joined_with_their_places_and_conjunctions() -> None:
    words = source_words("Como pan, bebo agua y duermo, pero sueño", MORPHOLOGY)
    model, repair = WordByWordModel(), HypothesisRepair.load()
    translated = [
        (
            piece,
            repair.repair(words[piece.start : piece.stop], model.translate(words[piece.start : piece.stop])),
        )
        for piece in pieces(words, JOINTS)
    ]
    whole = repair.join(words, translated)
    assert [(words[gloss.sources[0]].form, len(gloss.sources)) for gloss in whole.glosses] == [
        (form, 1) for form in ("como", "pan", "bebo", "agua", "duermo", "pero", "sueño")
    ]
    assert not any(whole.repaired)
