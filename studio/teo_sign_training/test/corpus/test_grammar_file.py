# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The grammar's files: every example is made, every word exists, every fault is named."""

from __future__ import annotations

import shutil

import pytest
from example_chooser import ExampleChooser
from refusals import refused

from teo_sign_training.corpus.derivation import Derivation
from teo_sign_training.corpus.generator import Generator
from teo_sign_training.corpus.grammar_file import load_grammar
from teo_sign_translator.data_files import data_file
from teo_sign_translator.errors import TranslationError

#: Lists of words.yaml that are not of nouns.
OTHER_LISTS = ("stressed_a", "mass_classes", "unsaid_verbs", "directed_verbs", "person_verbs", "plans")


def test_every_example_beside_a_rule_is_what_the_rule_makes(generator):
    wrong = []
    for family in generator.grammar.families:
        for rule in family.rules:
            chooser = ExampleChooser(rule.example.fixed)
            spread = {slot.name: rule.example.fixed.get(slot.name) for slot in rule.slots if slot.spread}
            made = Derivation(generator.grammar, generator.words, chooser).sentence(rule, spread)
            if (made.text, made.glosses) != (rule.example.text, rule.example.glosses):
                wrong.append((rule.where, made.text, made.glosses))
            unused = set(rule.example.fixed) - chooser.used - set(spread)
            if unused:
                wrong.append((rule.where, "fixes what is not there", unused))
    assert not wrong


def test_every_verb_can_be_conjugated(generator):
    impersonal = {"llover", "nevar", "granizar"}
    for verb in generator.words.verbs:
        lemma = verb.lemma.removesuffix("se") if verb.lemma.endswith("se") else verb.lemma
        for tag in ("V:ind:pres:1s", "V:ind:pret:3p", "V:sub:pres:2s", "V:ger", "V:part:ms"):
            if lemma not in impersonal:
                assert generator.words.inflect(lemma, tag)


def test_every_word_of_the_lists_is_in_the_lexicon(generator):
    nouns = {word.lemma for word in generator.words.nouns}
    classes = {each for word in generator.words.nouns for each in word.features["classes"].split(",")}
    adjectives = {word.lemma for word in generator.words.adjectives}
    shapes = {shape.name for shape in generator.grammar.shapes}
    lists = generator.grammar.word_lists
    for name, words in lists.items():
        glosses = all(word == word.upper() for word in words)
        if name not in OTHER_LISTS and not glosses and not set(words) <= shapes:
            missing = set(words) - (adjectives if name.startswith("fits_") else nouns)
            assert not missing, name
    for verb in generator.words.verbs:
        for item in verb.features["object"].split(","):
            assert item == "-" or item in classes or item in lists or item in nouns, (verb.lemma, item)


@pytest.mark.parametrize(
    ("file", "old", "new", "named"),
    [
        ("sentences.yaml", '{N} {P:S} ."\n        signs', '{Z} {P:S} ."\n        signs', "statement.plain"),
        ("phrases.yaml", "este~n {n}", "esto~n {n}", "someone.this"),
        ("sentences.yaml", 'signs: "{S} {P} {N}"', 'signs: "{S} {Q} {N}"', "statement.plain"),
        ("sentences.yaml", 'pick: {S: "subject"', 'pick: {S: "subjetc"', "statement.plain"),
        ("sentences.yaml", 'example: {text: "Compro el l', 'exmaple: {text: "Compro el l', "statement.plain"),
        ("sentences.yaml", "        weight: 10\n", "        weight: -1\n", "statement.plain"),
        ("phrases.yaml", 'signs: "{n} MUCHO=mucho"', 'signs: "{n} MUCHO=muchos"', "someone.many"),
        ("clauses.yaml", "$V.object det=$V.det", "$W.object det=$W.det", "vp.thing"),
        ("shapes.yaml", '^ */ind:pres", signs: "*"', '^ */ind:pres", signs: "* NO=no"', "present"),
        ("shapes.yaml", "mood: sub, text", "mood: sbu, text", "subjunctive"),
        ("words.yaml", "  el: el la los las", "  el: el la los", "el"),
        ("times.yaml", "    none: {weight: 62", "    no: {weight: 62", "time"),
        ("held_out.yaml", "held_out:\n", "held_out:\n  - statement.plain.none\n", "statement.plain.none"),
        ("held_out.yaml", "    condition in_case", "    condition vp.nowhere in_case", "vp.nowhere"),
        ("everyday.yaml", "families:", "family:", "everyday.yaml"),
    ],
)
def test_a_fault_is_reported_with_file_and_rule(morphology, tmp_path, file, old, new, named):
    shutil.copytree(data_file("grammar"), tmp_path / "grammar")
    (tmp_path / "lexicon").symlink_to(data_file("lexicon"))
    path = tmp_path / "grammar" / file
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with refused("invalid_grammar") as caught:
        Generator.load(tmp_path / "grammar", morphology)
    assert named in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"families: [", b"\xff\xfe", b"- a\n- b\n", b"families: 3\n"])
def test_a_broken_file_is_reported_by_name_and_a_folder_without_any_too(tmp_path, content):
    with pytest.raises(TranslationError, match="found none"):
        load_grammar(tmp_path)
    (tmp_path / "broken.yaml").write_bytes(content)
    with refused("invalid_grammar", r"broken\.yaml"):
        load_grammar(tmp_path)
