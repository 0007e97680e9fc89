# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sentence as a model's input, however it is typed."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from loaded import TEXT, read

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology.lexicon import adjectives, nouns
from teo_sign_translator.text.rules import TextRules


def _forms(sentence: str) -> list[str]:
    return [word.form for word in read(sentence)]


@pytest.mark.parametrize(
    ("sentence", "forms"),
    [
        ("Hola,  Ana: ¿vienes?", "hola|,|ana|,|vienes|?"),
        ("Tengo treinta y uno; tú 31.", "tengo|31|,|tú|31|."),
        ("Cuesta 1.000 € o 3,5 $", "cuesta|1000|euros|o|3,5|dólares"),
        ("Cuesta $35 o €2,50, 5 € 2 veces", "cuesta|35|dólares|o|2,50|euros|,|5|euros|2|veces"),
        ("Mi teléfono es 600 257 707.", "mi|teléfono|es|600257707|."),
        ("A las 15.30 h o 9h05", "a|las|15:30|horas|o|9:05"),
        ("el 25/12 y el 1/2", "el|25|diciembre|y|el|1|febrero"),
        ("1/2 kilo el 3-4-2024", "medio|kilo|el|3|abril|2024"),
        ("ciento un días", "101|días"),
        ("3/4 de hora, 2/3, 7/3", "3|cuartos|de|hora|,|2|tercios|,|7|3"),
        ("a Ana.Gil-2@uc3m.es, ya", "a|ana.gil-2@uc3m.es|,|ya"),
        ("en https://www.cnse.es/lse/ o cnse.es.", "en|www.cnse.es/lse/|o|cnse.es|."),
        ("el 10 % o el 10 por ciento", "el|10|por ciento|o|el|10|por ciento"),
        ("la 2ª y el 3er piso", "la|segunda|y|el|tercero|piso"),
        ("20ºC, -5 °", "20|grados|,|menos|5|grados"),
        ("5 km, 5 m, m", "5|kilómetros|,|5|metros|,|m"),
        ("El Sr. Gil y la Dra. Ruiz, p. ej.", "el|señor|gil|y|la|doctora|ruiz|,|por|ejemplo|."),
        ("xq lloras? Porque sí", "por|qué|lloras|?|porque|sí"),
        ("Holaaaa, síííí", "hola|,|sí"),
        ("Carlos III y el siglo XXI", "carlos|3|y|el|siglo|21"),
        ("Q tal? K haces? plan Q", "que|tal|?|que|haces|?|plan|q"),
        ("UC3M, mp3 y 3m", "uc3m|,|mp3|y|3|metros"),
        ("1.234.567,8 y 1,2,3 y 007", "1234567,8|y|1|2|3|y|007"),
        (
            "D. Juan, los km. de p.  ej. ti, vitamina d",
            "don|juan|,|los|kilómetros|de|por|ejemplo|ti|,|vitamina|d",
        ),
        ("Julia Díez, veintidós, veintidos", "julia|díez|,|22|,|22"),
        ("Me gusta 😀 mucho!!!", "me|gusta|mucho|!"),
        ("“Hola”, dijo", "hola|,|dijo"),
        ("Ana ¿quién es J. Gil?", "ana|,|quién|es|j|gil|?"),
        ("Bueno... pues el ex-marido d'Ors, 1ºA", "bueno|,|pues|el|ex|marido|d|ors|,|primero|a"),
        ("el 12.10.2024, 1.000,50 € y dos mil", "el|12|octubre|2024|,|1000,50|euros|y|2000"),
        ("un año, cien, dieciseis, siete ocho", "un|año|,|100|,|16|,|7|8"),
        ("una casa, treinta y pico, quinientas veinte", "una|casa|,|30|y|pico|,|520"),
        ("mil cero, ciento cero", "1000|0|,|100|0"),
        ("carísimo, riquisimas y el mismísimo rey", "muy|caro|,|muy|ricas|y|el|mismísimo|rey"),
        ("un puesto en la uni entre semana", "un|puesto|en|la|universidad|de|lunes|a|viernes"),
        ("t digo q a las 5 d la tarde m voy", "te|digo|que|a|las|5|de|la|tarde|me|voy"),
        ("3 m d tela xa ti, talla m", "3|metros|de|tela|para|ti|,|talla|m"),
        ("", ""),
    ],
)
def test_a_sentence_becomes_words_and_marks(sentence: str, forms: str) -> None:
    assert _forms(sentence) == [form for form in forms.split("|") if form]


@pytest.mark.parametrize(
    ("sentence", "capitals"),
    [
        ("Ana quiere a Pedro", ["Pedro"]),
        ("Hola, Ana. Dile a Luis", ["Ana", "Luis"]),
        ("El Sr. Gil tiene 5 €", ["Gil"]),
    ],
)
def test_only_capitals_that_mean_something_count(sentence: str, capitals: list[str]) -> None:
    assert [word.text for word in read(sentence) if word.capital] == capitals


def test_words_that_one_short_form_stands_for_share_what_was_typed() -> None:
    assert [(word.text, word.form) for word in read("p. ej. ven, xfa")] == [
        ("p. ej.", "por"),
        ("p. ej.", "ejemplo"),
        ("ven", "ven"),
        (",", ","),
        ("xfa", "por"),
        ("xfa", "favor"),
    ]


@given(st.text())
@settings(max_examples=300)
def test_any_text_can_be_read(text: str) -> None:
    try:
        words = read(text)
    except TranslationError as error:
        assert error.code in ("broken_encoding", "text_too_long")
        return
    for word in words:
        assert word.text and word.form and 1 <= len(word.readings) <= 4
        assert word.is_mark == (word.form in (",", ".", "?", "!"))


@pytest.mark.parametrize(
    ("sentence", "forms"),
    [
        ("oye kedamos en el parke", "oye|quedamos|en|el|parque"),
        ("weno kisiera ablar kon mi ermana", "bueno|quisiera|hablar|con|mi|hermana"),
        ("muxas grasias", "muchas|gracias"),
        ("Muxo es mi apellido: Ana Muxo", "mucho|es|mi|apellido|,|ana|muxo"),
        ("el señor Veloz y la cesión", "el|señor|veloz|y|la|cesión"),
        ("no me as contestado", "no|me|has|contestado"),
        ("mi madre a comprado pan", "mi|madre|ha|comprado|pan"),
        ("te e comprado pan", "te|he|comprado|pan"),
        ("padres e hijos", "padres|e|hijos"),
        ("voy a casa de lado a lado", "voy|a|casa|de|lado|a|lado"),
        ("es un as de oros", "es|un|as|de|oros"),
    ],
)
def test_what_is_typed_by_its_sound_is_read_as_it_is_written(sentence: str, forms: str) -> None:
    assert "|".join(_forms(sentence)) == forms


def test_a_text_without_a_blank_is_not_looked_for_by_its_sound() -> None:
    assert _forms("kasa" * 4000) == ["kasa" * 4000]


def test_no_word_of_the_lexicon_is_taken_for_another_that_sounds_so() -> None:
    words = [noun.lemma for noun in nouns(TEXT)] + [adjective.lemma for adjective in adjectives(TEXT)]
    short = TextRules.load().expressions
    single = [word for word in words if word.isalpha() and not short.stands_for(word)]
    assert len(single) > 4000
    assert [word for word in single if _forms(f"veo {word}")[1:] != [word]] == []


@pytest.mark.parametrize(
    ("sentence", "word", "impossible"),
    [
        ("el grito me asustó", "grito", "V:"),
        ("dentro del sobre", "sobre", "PREP"),
        ("el trabajo es muy duro", "duro", "V:"),
        ("no llevo suelto", "suelto", "V:"),
        ("esperamos bajo el puente", "bajo", "V:"),
        ("llama sin falta", "falta", "V:"),
        ("las riego mañana", "riego", "N:"),
        ("te la mando luego", "mando", "N:"),
        ("si me lo cuentas", "cuentas", "N:"),
        ("solo vino a comer", "vino", "N:"),
        ("perdí la cosa", "cosa", "V:"),
        ("los fines de mes", "fines", "V:"),
        ("quiero que me firmes esto", "firmes", "A:"),
        ("no me llama nadie", "llama", "N:"),
        ("se me olvido ayer", "olvido", "N:"),
        ("yo cuento hasta tres", "cuento", "N:"),
        ("pitó la falta", "falta", "V:"),
        ("¿cuánto ganas?", "ganas", "N:"),
        ("se lima las uñas", "lima", "N:"),
        ("así que nada de fútbol", "nada", "V:"),
        ("lleva un litro y medio de nata", "un", "DET"),
    ],
)
def test_a_neighbour_rules_out_what_a_word_cannot_be(sentence: str, word: str, impossible: str) -> None:
    (found,) = (each for each in read(sentence) if each.form == word)
    assert not [reading for reading in found.readings if reading.tag.startswith(impossible)]


@pytest.mark.parametrize(
    ("sentence", "word", "possible"),
    [
        ("el libro sobre la mesa", "sobre", "PREP"),
        ("un vino a granel", "vino", "N:"),
        ("lo cuentas tú", "cuentas", "V:"),
        ("grito mucho", "grito", "V:"),
        ("el que llama", "llama", "V:"),
        ("el llama a su madre", "llama", "V:"),  # él
        ("el vive en casa", "vive", "V:"),
        ("el beber agua", "beber", "V:inf"),
        ("espera llama a Ana", "llama", "V:"),  # orders without a comma
        ("la cuenta", "cuenta", "V:"),
        ("la cuenta", "cuenta", "N:"),
        ("no la meta ahí", "meta", "V:sub"),
        ("no se nada", "nada", "PRON"),  # no sé nada
        ("un te caliente", "caliente", "A:"),  # un té
    ],
)
def test_where_both_may_stand_both_areread(sentence: str, word: str, possible: str) -> None:
    (found,) = (each for each in read(sentence) if each.form == word)
    assert [reading for reading in found.readings if reading.tag.startswith(possible)]


def test_a_verb_that_stands_alone_is_an_order() -> None:
    assert {reading.lemma for reading in read("Ven, que es tarde.")[0].readings} == {"venir"}
    assert {reading.lemma for reading in read("Ven la película.")[0].readings} == {"venir", "ver"}


def test_a_form_of_two_verbs_is_the_copula_before_an_adjective() -> None:
    assert {reading.lemma for reading in read("Sé amable.")[0].readings} == {"ser"}
    assert {reading.lemma for reading in read("Fui feliz.")[0].readings} == {"ser"}
    assert {reading.lemma for reading in read("Fui al bar.")[0].readings} == {"ir", "ser"}
