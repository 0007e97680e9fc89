# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a word that connects others means, as a speaker of Spanish reads the sentence."""

from __future__ import annotations

import pytest
from loaded import TEXT, read, translator

from teo_sign_translator.pipeline.completeness import CompleteTranslation
from teo_sign_translator.pipeline.connectives import Connectives
from teo_sign_translator.pointer import OutputGloss

CONNECTIVES = Connectives(TEXT)
PLACES = {"por": "MOTIVO", "sobre": "ENCIMA", "que": "QUÉ"}


def said(sentence: str, *, model: bool) -> str:
    """The nouns, and what the preposition means, where a model says that it does mean it or does not."""
    words = read(sentence)
    glosses = [
        OutputGloss((model and PLACES.get(word.form)) or word.form.upper(), (place,), 0.9, copied=False)
        for place, word in enumerate(words)
        if word.tag.startswith("N:") or (model and word.form in PLACES)
    ]
    translation = CompleteTranslation(tuple(glosses), (False,) * len(glosses))
    return " ".join(gloss.gloss for gloss in CONNECTIVES.read(words, translation).glosses)


@pytest.mark.parametrize(
    ("sentence", "meant"),
    [
        ("No fui por la lluvia.", "MOTIVO LLUVIA"),
        ("Estoy nervioso por el examen.", "MOTIVO EXAMEN"),
        ("Lo castigaron por mentir.", "MOTIVO"),
        ("Pasé por tu casa.", "CASA"),
        ("Salió por la gran puerta.", "PUERTA"),
        ("Respira por la nariz.", "NARIZ"),
        ("Está escrito por mi madre.", "MADRE"),
        ("Lloró por su madre.", "MOTIVO MADRE"),
        ("Trabaja por la noche.", "NOCHE"),
        ("El gato duerme sobre la mesa.", "GATO ENCIMA MESA"),
        ("Vi un libro sobre la mesa.", "LIBRO ENCIMA MESA"),
        ("Leí un libro sobre la guerra.", "LIBRO GUERRA"),
        ("Leí un libro muy largo sobre coches.", "LIBRO COCHES"),
        ("Hablamos sobre la casa.", "CASA"),
        ("Me aconsejó sobre la herencia.", "HERENCIA"),
        ("Prefiero el tren que el coche.", "TREN COCHE"),
        ("Prefiero que el tren salga.", "TREN"),
        ("¿Prefieres que te diga que tren sale?", "QUÉ QUÉ TREN"),
    ],
)
def test_a_reason_or_a_place_is_said_only_where_it_is_meant(sentence: str, meant: str) -> None:
    assert said(sentence, model=True) == meant


@pytest.mark.parametrize(
    ("sentence", "meant"),
    [
        ("Dejé las llaves sobre el televisor.", "LLAVES TELEVISOR ENCIMA"),
        ("Las gafas quedaron sobre el armario.", "GAFAS ARMARIO ENCIMA"),
        ("Hablamos sobre el televisor.", "TELEVISOR"),
        ("Llegaré sobre las cinco.", ""),
        ("Compré un sobre.", "SOBRE"),
    ],
)
def test_what_something_lies_on_is_said_where_a_model_leaves_it_out(sentence: str, meant: str) -> None:
    assert said(sentence, model=False) == meant


def test_what_is_spoken_of_is_neither_above_nor_spelled() -> None:
    for sentence in ("La profesora habla acerca de los animales.", "Tengo dudas respecto al examen."):
        glosses = str(translator().translate(sentence)).split()
        assert "ENCIMA" not in glosses and "ACERCAR" not in glosses, glosses
