# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whom something happens to, as a speaker of Spanish reads the sentence."""

from __future__ import annotations

import pytest
from loaded import TEXT, read

from teo_sign_translator.pipeline.completeness import CompleteTranslation
from teo_sign_translator.pipeline.objects import Objects
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics
from teo_sign_translator.pointer import OutputGloss

OBJECTS = Objects(PipelineWords.load(TEXT), Topics(TEXT))


def meant(sentence: str, model: str) -> str:
    """What is signed where a model says these glosses, each with the word that it says: `TÚ/te`."""
    words = read(sentence)
    forms = [word.form for word in words]
    glosses = []
    for each in model.split():
        gloss, _, form = each.partition("/")
        glosses.append(OutputGloss(gloss, (forms.index(form),) if form else (), 0.9, copied=False))
    said = CompleteTranslation(tuple(glosses), (False,) * len(glosses))
    return " ".join(gloss.gloss for gloss in OBJECTS.read(words, said).glosses)


@pytest.mark.parametrize(
    ("sentence", "model", "signed"),
    [
        # The signer or the addressee who does it is said by the verb's ending alone.
        ("La chica que te presenté.", "CHICA/chica TÚ/te PRESENTAR/presenté", "CHICA YO TÚ PRESENTAR"),
        ("El libro que me diste.", "LIBRO/libro YO/me DAR/diste", "LIBRO TÚ YO DAR"),
        ("Yo te llamo.", "YO/yo TÚ/te LLAMAR/llamo", "YO TÚ LLAMAR"),
        ("Te llamo.", "YO/llamo TÚ/te LLAMAR/llamo", "YO TÚ LLAMAR"),
        ("Luego te llamo.", "LUEGO/luego LLAMAR/llamo", "LUEGO LLAMAR"),  # nobody is taken for another one
        ("Me lavo.", "YO/me LAVAR/lavo", "YO LAVAR"),
        # Who is asked to do it.
        ("Déjame en paz.", "YO/déjame PAZ/paz DEJAR/déjame", "TÚ YO PAZ DEJAR"),
        ("Acuérdate de llamarme.", "YO/llamarme LLAMAR/llamarme", "TÚ YO LLAMAR"),
        ("Ven a verme.", "VENIR/ven YO/verme VER/verme", "TÚ VENIR YO VER"),
        ("Mándame un mensaje.", "MENSAJE/mensaje MANDAR/mándame", "MENSAJE MANDAR"),
        # A third person who is not named.
        ("Ayer me llamó.", "AYER/ayer YO/me LLAMAR/llamó", "AYER ÉL YO LLAMAR"),
        ("Ayer me llamó.", "AYER/ayer LLAMAR/llamó", "AYER ÉL YO LLAMAR"),
        ("El lunes te ha visto.", "LUNES/lunes TÚ/te VER/visto", "LUNES ÉL TÚ VER"),
        (
            "Vi a Ana, pero no me saludó.",
            "YO/vi ANA/ana VER/vi YO/me SALUDAR/saludó",
            "YO ANA VER ÉL YO SALUDAR",
        ),
        ("Me ha pedido dinero.", "DINERO/dinero PEDIR/pedido", "DINERO ÉL YO PEDIR"),
        ("Ayer me llamó Ana.", "AYER/ayer ANA/ana YO/me LLAMAR/llamó", "AYER ANA YO LLAMAR"),
        ("El colegio me llamó.", "COLEGIO/colegio YO/me LLAMAR/llamó", "COLEGIO YO LLAMAR"),
        ("Nadie me llamó.", "NADIE/nadie YO/me LLAMAR/llamó", "NADIE YO LLAMAR"),
        ("¿Quién te llamó?", "TÚ/te LLAMAR/llamó QUIÉN/quién", "TÚ LLAMAR QUIÉN"),
        ("¿Me ayuda?", "AYUDAR/ayuda", "AYUDAR"),  # the addressee, politely
        ("La mujer que me llamó.", "MUJER/mujer YO/me LLAMAR/llamó", "MUJER YO LLAMAR"),
        # Nobody does it.
        ("Me duele mucho.", "YO/me DOLER/duele MUCHO/mucho", "YO DOLER MUCHO"),
        ("Me gusta llamar.", "YO/me LLAMAR/llamar GUSTAR/gusta", "YO LLAMAR GUSTAR"),
        ("Se me olvidó llamar.", "YO/me LLAMAR/llamar OLVIDAR/olvidó", "YO LLAMAR OLVIDAR"),
        # What others are wished to do.
        ("Me gusta que me mientan.", "YO/me GUSTAR/gusta MENTIR/mientan", "YO GUSTAR ELLOS YO MENTIR"),
        (
            "Espero que me devuelva el libro.",
            "ESPERAR/espero LIBRO/libro DEVOLVER/devuelva",
            "ESPERAR ÉL YO LIBRO DEVOLVER",
        ),
        (
            "No quiero que me mientan.",
            "YO/quiero QUERER/quiero MENTIR/mientan YO",
            "YO QUERER ELLOS YO MENTIR",
        ),
        ("Quiero que me llame Ana.", "YO/quiero QUERER/quiero ANA/ana LLAMAR/llame", "YO QUERER ANA LLAMAR"),
        (
            "Quiero que te llame.",
            "YO/quiero QUERER/quiero LLAMAR/llame",
            "YO QUERER LLAMAR",
        ),  # he or the signer
    ],
)
def test_who_is_left_out_is_not_taken_for_another(sentence: str, model: str, signed: str) -> None:
    assert meant(sentence, model) == signed
