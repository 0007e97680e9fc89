# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The grammar of ASL from English: examples, sources, and the order of what it makes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from example_chooser import ExampleChooser

from teo_sign_languages import load_language
from teo_sign_training.corpus.derivation import Derivation
from teo_sign_training.corpus.generator import Generator
from teo_sign_translator.morphology import Morphology

TEXT = load_language("ase").text
#: What a comment names as a source: author or short name of shapes.yaml, and how sure it is.
SOURCE = re.compile(r"#.*\b(VL|BC|LP|N00|Liddell|Fischer)\b.*\b[ABC][).]")
FAMILY = re.compile(r"^  \w+:")
RULE = re.compile(r"^      (\w+):")


@pytest.fixture(scope="module")
def generator() -> Generator:
    return Generator.load(TEXT / "grammar", Morphology.load(TEXT))


class UncontractedExample(ExampleChooser):
    """Examples are written in full: "do not"."""

    def contracted(self) -> bool:
        return False


def test_every_example_beside_a_rule_is_what_the_rule_makes(generator: Generator) -> None:
    wrong = []
    for family in generator.grammar.families:
        for rule in family.rules:
            assert rule.example is not None
            chooser = UncontractedExample(rule.example.fixed)
            spread = {slot.name: rule.example.fixed[slot.name] for slot in rule.slots if slot.spread}
            made = Derivation(generator.grammar, generator.words, chooser).sentence(rule, spread)
            if (made.text, made.glosses) != (rule.example.text, rule.example.glosses):
                wrong.append((rule.where, made.text, made.glosses))
    assert not wrong


def test_the_grammar_has_more_than_sixty_rules_and_each_stands_under_a_source(generator: Generator) -> None:
    assert sum(len(family.rules) for family in generator.grammar.families) >= 60
    unsourced = [name for path in sorted((TEXT / "grammar").glob("*.yaml")) for name in _unsourced(path)]
    assert unsourced == []


def _unsourced(path: Path) -> list[str]:
    """Rules of a file above which neither its head nor a comment of their family names a source."""
    found: list[str] = []
    head, _, body = path.read_text(encoding="utf-8").partition("\nfamilies:\n")
    of_file = SOURCE.search(head) is not None
    sourced = of_file
    for line in body.splitlines():
        sourced = (of_file if FAMILY.match(line) else sourced) or SOURCE.search(line) is not None
        if (rule := RULE.match(line)) and not sourced:
            found.append(f"{path.name}: {rule[1]}")
    return found


def test_question_words_are_last_and_words_of_time_first(generator: Generator) -> None:
    for pair in generator.pairs(1500, seed=6):
        family = pair.rule.partition(".")[0]
        if family == "wh" and pair.rule != "wh.how_are":
            assert re.match("WH|HOW", pair.glosses[-1]), pair
        if "YESTERDAY" in pair.glosses and family in ("statement", "yes_no", "denying"):
            assert pair.glosses[0] == "YESTERDAY", pair
