# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_translator.text.reading import SentenceType, is_negated, read, sentence_type


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("¿Vienes?", SentenceType.YES_NO_QUESTION),
        ("Vienes?", SentenceType.YES_NO_QUESTION),
        ("¿Dónde vives?", SentenceType.WH_QUESTION),
        ("¿de donde eres?", SentenceType.WH_QUESTION),
        ("¿Y tú cómo estás?", SentenceType.WH_QUESTION),
        ("¿Sabes cómo se llama?", SentenceType.YES_NO_QUESTION),
        ("¿Haces qué?", SentenceType.WH_QUESTION),
        ("Hola, ¿cuándo vienes?", SentenceType.WH_QUESTION),
        ("donde vives", SentenceType.WH_QUESTION),
        ("como estas", SentenceType.WH_QUESTION),
        ("cuando vienes", SentenceType.WH_QUESTION),
        ("Cuando llegue, te llamo", SentenceType.STATEMENT),
        ("Como pan", SentenceType.STATEMENT),
        ("Que tengas buen día", SentenceType.STATEMENT),
        ("¡Qué bien!", SentenceType.EXCLAMATION),
        ("¡¿Vienes?!", SentenceType.YES_NO_QUESTION),
        ("Vengo.", SentenceType.STATEMENT),
    ],
)
def test_the_type_of_a_sentence(text: str, kind: SentenceType) -> None:
    assert sentence_type(read(text).clauses) is kind


@pytest.mark.parametrize(
    ("text", "negated"),
    [
        ("No vengo", True),
        ("Nooooo vengo", True),
        ("Nunca vengo", True),
        ("No hay nadie", True),
        ("Vienes, ¿no?", False),
        ("De nada", False),
        ("Vengo", False),
        ("Una nota", False),
    ],
)
def test_whether_a_sentence_is_negated(text: str, negated: bool) -> None:
    assert is_negated(read(text).clauses) is negated
