# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A draft says what its sentence says, in an order that rules give, and invents nothing."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_sign_translator.data_files import words_of
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pipeline.drafting.drafter import DRAFT_CONFIDENCE, Drafter, read_phrases
from teo_sign_translator.pipeline.trust import GLOSSES_A_WORD
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_words import source_words

MORPHOLOGY = Morphology.load()
DRAFTER = Drafter.load()


def _draft(sentence: str) -> str:
    return " ".join(gloss.gloss for gloss in DRAFTER.draft(source_words(sentence, MORPHOLOGY)))


@pytest.mark.parametrize(
    ("sentence", "glosses"),
    [
        ("El lobo está tranquilo.", "LOBO TRANQUILO"),
        ("Los tres cerdos entran en la casa.", "3 CERDO CASA ENTRAR"),
        ("Tengo fiebre.", "YO FIEBRE"),
        ("Tengo cinco años.", "YO EDAD 5"),
        ("Me siento cansado.", "YO CANSADO"),
        ("Mi hija come pan.", "HIJA MI PAN COMER"),
        ("Mañana voy a comer con mi hija.", "MAÑANA YO HIJA MI COMER"),
        ("Fui a Madrid el lunes.", "LUNES YO MADRID IR"),
        ("No puedo dormir.", "YO DORMIR PODER NO"),
        ("No como carne.", "YO CARNE COMER NO"),
        ("¿Puedes ayudarme con esto?", "AYUDAR ESTO PODER"),
        ("¿Dónde está mi libro?", "LIBRO MI DÓNDE"),
        ("¿Qué autobús va al hospital?", "AUTOBÚS HOSPITAL IR CUÁL"),
        ("Me duele la cabeza.", "YO CABEZA DOLER"),
        ("No hace falta.", "NECESITAR NO"),
        ("Había desaparecido de allí", "ALLÍ DESAPARECER"),
        ("Los mocos", "MOCOS"),
        ("Vino el lobo.", "LOBO VENIR"),
        ("Quiero devolver este abrigo.", "YO QUERER ESTE ABRIGO DEVOLVER"),
        ("Sé que Ana compró la casa.", "YO SABER ANA CASA COMPRAR"),
        ("Cuando murió mi tía, lloré.", "CUANDO TÍA MI MORIR YO LLORAR"),
        ("Salgo a las dos y media.", "HORA 2 MEDIA YO SALIR"),
        ("¿A qué hora sale el tren?", "TREN SALIR HORA CUÁL"),
        ("Tengo las dos cosas.", "YO 2 COSA"),
        ("Esta tarde viajo.", "HOY TARDE YO VIAJAR"),
        ("Llevo una semana en cama.", "1 SEMANA YO CAMA"),
        ("Hace dos meses que no como carne.", "2 MES YO CARNE COMER NO"),
        ("Vomité dos veces.", "YO 2 VEZ VOMITAR"),
        ("Antes de Navidad viajo.", "ANTES NAVIDAD YO VIAJAR"),
        ("El gato duerme debajo de la cama.", "GATO CAMA DEBAJO DORMIR"),
        ("Es un pueblo muy tranquilo.", "PUEBLO TRANQUILO MUY"),
        ("No se mueva.", "MOVER NO"),
        ("Baja la basura.", "BASURA BAJAR"),
        ("Quisiera abrir una cuenta.", "YO QUERER CUENTA ABRIR"),
        ("Tengo hambre, dijo el mono.", "MONO DECIR YO HAMBRE"),
        ("¿y de la?", "Y DE EL"),
    ],
)
def test_each_rule(sentence: str, glosses: str) -> None:
    assert _draft(sentence) == glosses


TYPED = words_of(
    "el la mi tu niño casa lobo como comió tengo está no nunca que qué dónde puedo quiero ir a de en con me "
    "te lo se dos 5 ayer lunes hoy muy rojo segura y o pero si porque xyz dog Ana dímelo ayudarme , ? ."
)


@given(st.lists(st.sampled_from(TYPED), min_size=1, max_size=30))
@settings(max_examples=300, deadline=None)
def test_no_content_word_is_lost_and_nothing_is_invented(chosen: list[str]) -> None:
    words = source_words(" ".join(chosen), MORPHOLOGY)
    if all(word.is_mark for word in words):
        return
    glosses = DRAFTER.draft(words)
    said = {place for gloss in glosses for place in gloss.sources}
    for place, word in enumerate(words):
        if word.readings[0].tag.startswith(("N:", "A:", "NAME", "NUM", "X", "ADV:place")):
            assert place in said, (word.text, [gloss.gloss for gloss in glosses])
    assert glosses
    assert len(glosses) <= GLOSSES_A_WORD * sum(not word.is_mark for word in words)
    by_rule = {"YO", "TÚ", "NOSOTROS", "VOSOTROS", "DEBER", "EDAD", "CUÁL", "HORA", "HOY", "1", "MEDIA"}
    for gloss in glosses:
        assert gloss.sources and gloss.probability == DRAFT_CONFIDENCE
        own = {copied_gloss(reading) for place in gloss.sources for reading in words[place].readings}
        assert gloss.gloss in own | by_rule | {*DRAFTER.phrases.values()}


@pytest.mark.parametrize("line", ["favor\tFAVOR", "por favor\tpor_favor", "a b\tX\na b\tY", "por favor"])
def test_a_damaged_list_of_phrases_is_refused_with_file_and_line(tmp_path: Path, line: str) -> None:
    path = tmp_path / "set_phrases.tsv"
    path.write_text(line, encoding="utf-8")
    with pytest.raises(TranslationError, match=r"set_phrases\.tsv, line") as error:
        read_phrases(path)
    assert error.value.code == "invalid_data"
