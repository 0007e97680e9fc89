# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a verb says in LSE: not its tense, not whom its path shows, not that one has what is named."""

from __future__ import annotations

import pytest
from example_chooser import ExampleChooser

from teo_sign_training.corpus.derivation import Derivation
from teo_sign_training.corpus.phrases import SaidWord, Sign, without_addressee


@pytest.fixture(scope="module")
def say(generator):
    def say(family, rule, **fixed):
        rules = next(each.rules for each in generator.grammar.families if each.name == family)
        chosen = next(each for each in rules if each.name == rule)
        fixed = {path.replace("_", "."): choice for path, choice in fixed.items()}
        spread = {slot.name: fixed.get(slot.name) for slot in chosen.slots if slot.spread}
        made = Derivation(generator.grammar, generator.words, ExampleChooser(fixed)).sentence(chosen, spread)
        return made.text, " ".join(made.glosses)

    return say


@pytest.mark.parametrize(
    ("shape", "written"),
    [
        ("preterite", "Trabajé."),
        ("perfect", "He trabajado."),
        ("pluperfect", "Había trabajado."),
        ("future", "Trabajaré."),
        ("going_to", "Voy a trabajar."),
    ],
)
def test_a_tense_has_no_sign(say, shape, written):
    made = say("statement", "plain", P="intransitive", P_V="trabajar", P_V_shape=shape)
    assert made == (written, "YO IR TRABAJAR" if "IR" in made[1] else "YO TRABAJAR")


def test_a_time_word_alone_says_when(say):
    made = say(
        "cause", "because_tomorrow", T="yesterday", N="no", P="goal", P_V="ir", P_V_shape="preterite",
        P_G_n="cine", C_N="pos", C_S="yo_f", C_P="feeling", C_P_V_shape="imperfect", C_P_A="enfermo",
    )  # fmt: skip
    assert made == (
        "Ayer no fui al cine porque estaba enferma.",
        "AYER YO CINE IR NO PORQUE YO ENFERMO",
    )


@pytest.mark.parametrize(
    ("subject", "negation", "expected"),
    [
        ("yo", "pos", ("Tengo un perro.", "YO PERRO")),
        ("yo", "no", ("No tengo un perro.", "YO PERRO NO")),
        ("vosotros", "pos", ("Tenéis un perro.", "VOSOTROS PERRO")),
    ],
)
def test_who_has_something_is_named_beside_it_without_a_verb(say, subject, negation, expected):
    made = say(
        "statement", "plain", S=subject, N=negation, P="have_thing", P_V="tener", P_V_shape="present",
        P_O="a", P_O_n="perro",
    )  # fmt: skip
    assert made == expected


def test_having_is_said_where_what_one_has_is_not_named(say):
    assert say("questions_what", "what_have", S="tú") == ("¿Qué tienes?", "TÚ TENER QUÉ")


def test_the_path_of_a_directed_verb_shows_whom_a_clitic_means(say):
    made = say("statement", "call", T="none", S="yo", N="pos", V="ayudar", V_shape="present", O="you")
    assert made == ("Te ayudo.", "YO AYUDAR")
    made = say("statement", "call", T="none", S="yo", N="pos", V="ver", V_shape="present", O="you")
    assert made == ("Te veo.", "YO TÚ VER")


def test_who_feels_is_said_beside_a_directed_verb_too_whose_noun_says_both_words(say, generator):
    assert say("felt", "gives_it", E="you", n="miedo") == ("Te da miedo.", "TÚ MIEDO")
    family = next(each for each in generator.grammar.families if each.name == "felt")
    rule = next(each for each in family.rules if each.name == "gives_it")
    made = Derivation(generator.grammar, generator.words, ExampleChooser({"n": "miedo"})).sentence(rule, {})
    assert (made.text, made.alignment) == ("Me da miedo.", ((0,), (1, 2)))


LISTS = {"asking_glosses": ("PODER",), "addressee_glosses": ("TÚ",)}


def test_the_addressee_of_a_request_is_left_out_unless_a_word_says_it():
    you, can, say_you = SaidWord("puedes"), Sign("PODER"), SaidWord("tú")
    can.sources = [you]
    silent = [Sign("TÚ", [you]), Sign("VENIR"), can]
    said = [Sign("TÚ", [say_you]), Sign("VENIR"), can]
    assert without_addressee(silent, LISTS, asked=True) == silent[1:]
    assert without_addressee(silent, LISTS, asked=False) == silent
    assert without_addressee(said, LISTS, asked=True) == said
    assert without_addressee([*silent, Sign("NO")], LISTS, asked=True)[0] is silent[0]
    assert without_addressee([], LISTS, asked=True) == []


def test_the_pronoun_of_a_clause_stays_in_it(say):
    made = say("saying", "think", V="creer", C="liking", C_E="me", C_V="gustar", C_O_n="fútbol")
    assert made == ("Creo que me gusta el fútbol.", "YO CREER YO FÚTBOL GUSTAR")
