# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What no translation may do: go round in a circle, grow beyond its text, lose a word unsaid, name nobody."""

from __future__ import annotations

import math
import re
from collections import Counter

import pytest
from loaded import translator

from teo_sign_translator.output.translation import Kind
from teo_sign_translator.pipeline.pointer_back_end import MOST_WORDS

SENTENCES = (
    "actividades formativas complementarias",
    "Ahora está acabada.",
    "Para que la casa sea segura",
    "Vengo por la baja",
    "había desaparecido de allí",
    "Mi perro es my best friend",
    "Estoy very tired hoy",
    "a" * 10_000,
    "Hola " + "b" * 10_000 + " casa",
    "casa " * 200,
    "muy muy muy muy bien",
)


@pytest.mark.parametrize("text", SENTENCES)
def test_no_translation_repeats_or_outgrows_its_text(text: str) -> None:
    translation = translator().translate(text)
    glosses = [
        token.gloss
        for sentence in translation.sentences
        for token in sentence.tokens
        if token.kind is Kind.LEXICAL
    ]
    words = re.findall(r"\w+", text)
    assert len(glosses) <= 2 * len(words)
    extra = 2 * math.ceil(len(words) / MOST_WORDS)
    assert all(times <= words.count(gloss.lower()) + extra for gloss, times in Counter(glosses).items())


@pytest.mark.parametrize(
    ("text", "invented"),
    [
        ("había desaparecido de allí", {"YO", "TÚ"}),
        ("Vengo por la baja", {"ELLA", "ÉL"}),
        ("Ahora está acabada.", {"ÉL", "ELLA", "YO"}),
        ("actividades formativas complementarias", {"TÚ", "YO"}),
        ("Mi perro es my best friend", {"PASADO", "YO"}),
        ("Hola, ¿cuánto cuesta?", {"USTED"}),
        ("¿Cuánto valen?", {"USTEDES", "ELLOS"}),
        ("¿Por qué está cerrado?", {"USTED"}),
        ("¿Es cierto que te ofrecieron un trabajo?", {"USTED"}),
        ("Sin cita, salvo en casos urgentes.", {"YO"}),
        ("Sin falta las riego mañana.", {"FALTAR"}),
    ],
)
def test_nobody_is_named_whom_no_word_names(text: str, invented: set[str]) -> None:
    assert not invented & {*str(translator().translate(text)).split()}


@pytest.mark.parametrize(
    ("text", "acts", "acted_on"),
    [
        ("Me han quitado el bolso.", "ELLOS", "YO"),
        ("La operaron ayer.", "ELLOS", "ELLA"),
        ("Nos engañaron.", "ELLOS", "NOSOTROS"),
        ("Mi vecino me espera.", "VECINO", "YO"),
        ("Te escribo mañana.", "YO", "TÚ"),
        ("No me llames.", "TÚ", "YO"),
    ],
)
def test_whom_it_happens_to_does_not_seem_to_do_it(text: str, acts: str, acted_on: str) -> None:
    glosses = str(translator().translate(text)).split()
    assert glosses.index(acts) < glosses.index(acted_on)


@pytest.mark.parametrize(
    ("text", "said", "false"),
    [
        ("El libro está sobre la silla.", "ENCIMA", "DE_ACUERDO"),
        ("El perro duerme bajo el árbol.", "DEBAJO", "BAJAR"),
        ("El cine está entre el banco y la farmacia.", "ENTRE", "ENTRAR"),
        ("Ni mi tía ni mi abuelo conducen.", "NO", "NI"),
        ("Hoy estoy peor que el martes.", "HOY", "ESTAR"),
        ("Ninguno de los tres vino.", "VENIR", "VINO"),
        ("No levantes peso.", "PESO", "YO"),
        ("Mi tía habla como si fuera mi madre.", "IGUAL", "IR"),
        ("Le quitaron la llave para que no cayera.", "CAER", "YO"),
        ("Cuanto más estudio, menos duermo.", "MENOS", "ESTUDIO"),
        ("no se cocinar", "SABER", "SE"),
        ("Gracias, nada más.", "NADA", "NADAR"),
        ("gracias x la comida", "COMIDA", "X"),
        ("sta carta es pa ti", "TÚ", "PA"),
        ("El agua sale por debajo de la mesa.", "DEBAJO", "MOTIVO"),
        ("Estoy cansado y aun así trabajo.", "PERO", "ASÍ"),
    ],
)
def test_words_that_look_alike_are_told_apart_and_no_denial_is_lost(text: str, said: str, false: str) -> None:
    glosses = str(translator().translate(text)).split()
    assert said in glosses and false not in glosses


def test_what_no_token_stands_for_is_listed() -> None:
    (sentence,) = translator().translate("La casa de mi madre está en la calle.").sentences
    said = [word for token in sentence.tokens for word in token.source_words]
    assert sorted([*said, *sentence.dropped]) == sorted(
        ["La", "casa", "de", "mi", "madre", "está", "en", "la", "calle"]
    )
    assert {"La", "de", "en"} <= {*sentence.dropped}
    assert translator().translate("La casa").as_dict()["sentences"][0]["dropped"] == ["La"]


def test_a_title_in_quotes_has_its_own_signs_or_letters_and_no_substitutes() -> None:
    signs = {"VIVIR", "CASA", "PELÍCULA"}
    for quoted in ("«La vida en casa»", '"La vida en casa"', "“La vida en casa”"):
        title = str(translator().translate(f"He visto la película {quoted}.", signs)).split()
        assert "VIVIR" not in title and {"PELÍCULA", "CASA", "V-I-D-A"} <= {*title}
    assert "VIVIR" in str(translator().translate("Dijo: «La vida es así».", signs))
