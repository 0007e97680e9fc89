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
from teo_sign_translator.pipeline.drafted import DRAFT_CONFIDENCE, Drafter, read_phrases
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
        ("Los tres cerdos entran en la casa.", "3 CERDO ENTRAR CASA"),
        ("Tengo fiebre.", "YO FIEBRE"),
        ("Tengo cinco años.", "YO EDAD 5"),
        ("Me siento cansado.", "YO CANSADO"),
        ("Mi hija come pan.", "HIJA MI COMER PAN"),
        ("Mañana voy a comer con mi hija.", "MAÑANA YO COMER HIJA MI"),
        ("Fui a Madrid el lunes.", "LUNES YO IR MADRID"),
        ("No puedo dormir.", "YO DORMIR PODER NO"),
        ("No como carne.", "YO COMER NO CARNE"),
        ("¿Puedes ayudarme con esto?", "AYUDAR ESTO PODER"),
        ("¿Dónde está mi libro?", "LIBRO MI DÓNDE"),
        ("¿Qué autobús va al hospital?", "AUTOBÚS IR HOSPITAL CUÁL"),
        ("Me duele la cabeza.", "YO DOLER CABEZA"),
        ("No hace falta.", "NECESITAR NO"),
        ("Había desaparecido de allí", "DESAPARECER ALLÍ"),
        ("Los mocos", "MOCOS"),
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
    by_rule = {"YO", "TÚ", "NOSOTROS", "VOSOTROS", "DEBER", "EDAD", "CUÁL", "CUÁNTOS"}
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
