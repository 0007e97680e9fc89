# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Tense in LSE: marked once, and not where a time word says it."""

from __future__ import annotations

import pytest
from example_chooser import ExampleChooser

from teo_sign_translator.corpus.derivation import Derivation
from teo_sign_translator.corpus.fillers import NoFillerError
from teo_sign_translator.corpus.generator import Generator
from teo_sign_translator.corpus.tokens import Sign
from teo_sign_translator.corpus.verb_phrase import marked_once
from teo_sign_translator.data_files import data_file
from teo_sign_translator.morphology import Morphology


@pytest.fixture(scope="module")
def generator():
    return Generator.load(data_file("grammar"), Morphology.load())


@pytest.fixture(scope="module")
def say(generator):
    def say(family, rule, **fixed):
        rules = next(each.rules for each in generator.grammar.families if each.name == family)
        chosen = next(each for each in rules if each.name == rule)
        fixed = {path.replace("_", "."): choice for path, choice in fixed.items()}
        spread = {slot.name: fixed.get(slot.name) for slot in chosen.slots if slot.spread}
        made = Derivation(generator.grammar, generator.words, ExampleChooser(fixed)).sentence(chosen, spread)
        return made.spanish, " ".join(made.glosses)

    return say


def glosses(*signs):
    return [sign.gloss for sign in marked_once(signs)]


def test_a_second_mark_of_the_same_tense_is_left_out():
    past, future = Sign("PASADO", tense="past"), Sign("FUTURO", tense="future")
    assert glosses(past, Sign("IR"), past, Sign("VER")) == ["PASADO", "IR", "VER"]
    assert glosses(past, Sign("IR"), future, Sign("VER")) == ["PASADO", "IR", "FUTURO", "VER"]


def test_a_time_word_marks_the_tense_of_what_follows_and_other_glosses_of_that_name_stay():
    said = Sign("", tense="past")
    assert glosses(said, Sign("AYER"), Sign("PASADO", tense="past"), Sign("VER")) == ["AYER", "VER"]
    assert glosses(said, Sign("AÑO"), Sign("PASADO"), Sign("VER")) == ["AÑO", "PASADO", "VER"]


def test_the_clause_of_a_cause_does_not_mark_again_what_the_time_word_says(say):
    made = say(
        "cause", "because_tomorrow", T="yesterday", N="no", P="goal", P_V="ir", P_V_shape="preterite",
        P_G_n="cine", C_N="pos", C_S="yo_f", C_P="feeling", C_P_V_shape="imperfect", C_P_A="enfermo",
    )  # fmt: skip
    assert made == (
        "Ayer no fui al cine porque estaba enferma.",
        "AYER YO CINE IR NO MOTIVO YO ENFERMO",
    )


@pytest.mark.parametrize(
    ("negation", "expected"),
    [
        ("not_yet", ("Todavía no he trabajado.", "YO TRABAJAR TODAVÍA_NO")),
        ("already", ("Ya he trabajado.", "YO TRABAJAR YA")),
        ("pos", ("He trabajado.", "PASADO YO TRABAJAR")),
    ],
)
def test_already_and_not_yet_say_the_past(say, negation, expected):
    made = say("statement", "plain", N=negation, P="intransitive", P_V="trabajar", P_V_shape="perfect")
    assert made == expected


def test_already_does_not_say_the_future(say):
    made = say("statement", "plain", N="already", P="intransitive", P_V="trabajar", P_V_shape="future")
    assert made == ("Ya trabajaré.", "FUTURO YO TRABAJAR YA")


def test_a_form_that_may_be_present_or_past_is_never_taught_as_past_without_a_time_word(say):
    with pytest.raises(NoFillerError):
        say("statement", "plain", S="nosotros", P="intransitive", P_V="trabajar", P_V_shape="preterite")
    made = say(
        "statement", "time_first", T="yesterday", S="nosotros", P="intransitive", P_V="trabajar",
        P_V_shape="preterite",
    )  # fmt: skip
    assert made == ("Ayer trabajamos.", "AYER NOSOTROS TRABAJAR")


def test_the_perfect_is_past_in_every_person(say):
    made = say("statement", "plain", S="nosotros", P="intransitive", P_V="trabajar", P_V_shape="perfect")
    assert made == ("Hemos trabajado.", "PASADO NOSOTROS TRABAJAR")


def test_a_time_word_beside_a_present_marks_what_follows(say):
    made = say(
        "in_case", "if_then", T="tomorrow", D="rain", D_V="llover", P="intransitive", P_V="trabajar",
        P_V_shape="future",
    )  # fmt: skip
    assert made == ("Si mañana llueve, trabajaré.", "SI MAÑANA LLOVER YO TRABAJAR")


def test_the_pronoun_of_a_clause_stays_in_it(say):
    made = say("saying", "think", V="creer", C="liking", C_E="me", C_V="gustar", C_O_n="fútbol")
    assert made == ("Creo que me gusta el fútbol.", "YO CREER YO FÚTBOL GUSTAR")


def test_a_noun_says_what_the_light_verb_beside_it_says(generator):
    family = next(each for each in generator.grammar.families if each.name == "felt")
    rule = next(each for each in family.rules if each.name == "gives_it")
    fixed = {"n": "miedo"}
    made = Derivation(generator.grammar, generator.words, ExampleChooser(fixed)).sentence(rule, {})
    assert (made.spanish, made.glosses) == ("Me da miedo.", ("YO", "MIEDO"))
    assert made.alignment == ((0,), (1, 2))
