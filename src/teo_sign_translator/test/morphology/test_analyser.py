# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What words may be: against readings written by hand, and for any text."""

from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st
from loaded import TEXT, morphology
from refusals import refused

from teo_sign_translator.morphology import TAGS, Reading, lexicon, tag_class
from teo_sign_translator.morphology.readings import VERB_TAGS

#: Words and their likeliest readings; `~` is not exact. Of the lexicon, with pronouns, derived.
LIKELIEST = """
    vino: vino N:ms | casa: casa N:fs | para: para PREP | nada: nada PRON:neg | río: río N:ms |
    cara: cara N:fs | música: música N:fs | llama: llamar V:ind:pres:3s |
    vivo: vivir V:ind:pres:1s | poder: poder V:inf | fue: ser V:ind:pret:3s |
    fui: ir V:ind:pret:1s | creo: creer V:ind:pres:1s | siento: sentir V:ind:pres:1s |
    hay: haber V:ind:pres:3s | pasa: pasar V:ind:pres:3s | bien: bien ADV:manner |
    deberes: deberes N:mp | matematicas: matemáticas N:fp ~ | comía: comer V:ind:impf:3s |
    cantara: cantar V:sub:impf:3s | dijese: decir V:sub:impf:3s | comed: comer V:imp:2p |
    lápices: lápiz N:mp | crisis: crisis N:fn | gafas: gafas N:fp | estudiante: estudiante N:cs |
    profesoras: profesor N:fp | alcaldesa: alcalde N:fs | hijas: hija N:fp | actriz: actriz N:fs |
    jóvenes: joven A:cp | alemana: alemán A:fs | azules: azul A:cp | gratis: gratis A:cn |
    gran: grande A:cs | buen: bueno A:ms | ayer: ayer ADV:time:past |
    mañana: mañana ADV:time:future | nunca: nunca ADV:neg | aquí: aquí ADV:place |
    sí: sí ADV:sentence | la: el DET:def:fs | unos: uno DET:indef:mp | esta: este DET:dem:fs |
    mis: mi DET:poss:1s:cp | nuestras: nuestro DET:poss:1p:fp | mías: mío PRON:poss:1s:fp |
    muchas: mucho DET:quant:fp | ella: ella PRON:3s | ellas: ellos PRON:3p:f |
    les: le PRON:obj:3p | lo: lo PRON:obj:3s:m | se: se PRON:refl | conmigo: conmigo PRON:with:1s |
    mí: mí PRON:prep:1s | quiénes: quién WH:cp | cuántas: cuánto WH:fp | del: de PREP:art |
    e: y CONJ | hola: hola INT | siete: 7 NUM | veintiséis: 26 NUM | quinientas: 500 NUM |
    7: 7 NUM | 1.000: 1.000 NUM | 3,5: 3,5 NUM | ¿: ¿ MARK | 😀: 😀 MARK | Ana: Ana NAME:f |
    ana: Ana NAME:f | GONZÁLEZ: González NAME | Rosa: Rosa NAME:f | rosa: rosa N:fs |
    madrid: Madrid NAME:place | Blanco: blanco A:ms | Zurbano: Zurbano NAME ~ |
    dímelo: decir V:imp:2s me lo | dimelo: decir V:imp:2s me lo ~ | ayudarme: ayudar V:inf me |
    dándoselo: dar V:ger se lo | parte: parte N:fs |
    perrito: perro N:ms | gatitas: gato N:fp | manita: mano N:fs | cafecito: café N:ms |
    pececito: pez N:ms | trenecito: tren N:ms | amiguito: amigo N:ms | pobrecita: pobre A:cs |
    poquito: poco DET:quant:ms | ahorita: ahora ADV:time:present | buenísima: bueno A:fs |
    riquísimos: rico A:mp | facilísimo: fácil A:cs | amabilísima: amable A:cs |
    muchísimo: mucho DET:quant:ms
"""
GUESSED = """
    guglear: guglear V:inf ~ | gugleando: guglear V:ger ~ | guglearon: guglear V:ind:pret:3p ~ |
    gnomines: gnomín X ~ | xilofonaciones: xilofonación N:fp ~ | zurdismo: zurdismo N:ms ~ |
    trombonistas: trombonista N:cp ~ | gnomones: gnomón X ~ | zarzabuques: zarzabuque X ~ |
    funeriaria: funeriaria X ~ | zanahoriada: zanahoriada X ~ | estrépito: estrépito X ~ |
    sílfide: sílfide X ~ | xyz: xyz X ~
"""


def read(word: str) -> list[str]:
    """Readings as short texts: `como CONJ`, `cómo WH ~` (not exact), `decir V:imp:2s me lo`."""
    return [
        " ".join([each.lemma, each.tag, *each.clitics]) + ("" if each.exact else " ~")
        for each in morphology().readings(word)
    ]


def rows(table: str) -> list[list[str]]:
    return [row.split(": ", 1) for row in " ".join(table.split()).split(" | ")]


@pytest.mark.parametrize(("word", "reading"), rows(LIKELIEST))
def test_the_likeliest_reading_is_first(word: str, reading: str) -> None:
    assert read(word)[0] == reading


@pytest.mark.parametrize(("word", "reading"), rows(GUESSED))
def test_unknown_words_are_guessed_by_their_ending(word: str, reading: str) -> None:
    assert read(word) == [reading]


@pytest.mark.parametrize(
    ("word", "readings"),
    [
        ("como", ["como CONJ", "comer V:ind:pres:1s", "cómo WH ~"]),
        ("esta", ["este DET:dem:fs", "estar V:ind:pres:3s ~"]),
        ("si", ["si CONJ", "sí ADV:sentence ~"]),
        ("el", ["el DET:def:ms", "él PRON:3s ~"]),
        ("te", ["te PRON:obj:2s", "té N:ms ~"]),
        ("se", ["se PRON:refl", "saber V:ind:pres:1s ~"]),
        ("solo", ["solo A:ms", "solo ADV:degree"]),
        ("canto", ["cantar V:ind:pres:1s", "cantar V:ind:pret:3s ~"]),
        ("rosa", ["rosa N:fs", "Rosa NAME:f"]),
        ("pilar", ["Pilar NAME:f"]),
        ("Blanco", ["blanco A:ms", "Blanco NAME"]),
        ("manana", ["mañana ADV:time:future ~"]),
        ("bajo", ["bajo PREP", "bajo A:ms"]),
        ("una", ["uno DET:indef:fs", "1 NUM"]),
        ("tranquilamente", ["tranquilamente ADV:manner", "tranquilo A:fs"]),
    ],
)
def test_other_readings_follow_in_their_order(word: str, readings: list[str]) -> None:
    given_back = read(word)
    assert [each for each in given_back if each in readings] == readings


def test_accents_that_are_wrong_count_only_for_short_words_and_where_nothing_else_fits() -> None:
    assert read("inglés") == ["inglés N:ms", "inglés A:ms"]
    assert read("cása") == ["casa N:fs ~", "casar V:ind:pres:3s ~"]


@given(st.text(max_size=12) | st.text(alphabet="abcdeéiíjlmnñoóqrstuüzáú", max_size=14))
def test_any_text_has_readings_that_keep_the_promise(word: str) -> None:
    readings = morphology().readings(word)
    assert 1 <= len(readings) <= 4
    assert all(reading.tag in TAGS for reading in readings)
    assert len({(each.lemma, tag_class(each.tag), each.exact) for each in readings}) == len(readings)
    assert morphology().readings(unicodedata.normalize("NFD", word)) == readings
    if any(character.isalnum() for character in unicodedata.normalize("NFC", word)):
        assert all(reading.lemma for reading in readings)


def test_a_word_without_end_is_read() -> None:
    word = "así" * 10_000
    # What looks at every ending of every part of it would not come back.
    assert morphology().readings(word) == (Reading(word, "X", exact=False),)


def forms_of_the_tables() -> list[tuple[str, str]]:
    words = [
        (form.lemma, form.tag)
        for word in (*lexicon.nouns(TEXT), *lexicon.adjectives(TEXT))
        for form in lexicon.nominal_forms(word)
    ]
    closed = [(form.lemma, form.tag) for form in lexicon.closed_class_forms(TEXT)]
    verbs = [(verb, tag) for verb in lexicon.verbs(TEXT)[::20] for tag in VERB_TAGS]
    return words + closed + verbs


def test_every_form_of_the_tables_is_read_back() -> None:
    # A form may be several of its lemma (come: he eats, eat!): the reading is one that is written the same.
    for lemma, tag in forms_of_the_tables():
        form = morphology().inflect(lemma, tag)
        found = [each for each in morphology().readings(form) if each.lemma == lemma and not each.clitics]
        same = [each for each in found if tag_class(each.tag) == tag_class(tag)]
        if not same:  # more words share the form than readings are given, as for "la", "sobre", "bajo"
            assert len(morphology().readings(form)) >= 3, (lemma, tag, form)
            continue
        assert morphology().inflect(lemma, same[0].tag) == form, (lemma, tag, form)


@pytest.mark.parametrize(
    ("lemma", "tag", "form"),
    [
        ("grande", "A:fs", "grande"),
        ("crisis", "N:fp", "crisis"),
        ("7", "NUM", "siete"),
        ("1234", "NUM", "1234"),
        ("algún", "DET:quant:ms", "algún"),
        ("comer", "V:sub:impf:1s", "comiera"),
    ],
)
def test_inflection_gives_the_usual_form(lemma: str, tag: str, form: str) -> None:
    assert morphology().inflect(lemma, tag) == form


@pytest.mark.parametrize(
    ("lemma", "tag"), [("xyzzy", "N:ms"), ("casa", "V:inf"), ("gafas", "N:fs"), ("", "")]
)
def test_a_form_that_does_not_exist_is_refused(lemma: str, tag: str) -> None:
    with refused("no_form", "expected a known lemma"):
        morphology().inflect(lemma, tag)
