# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Templates: the sentences of a grammar, one for each alternative of their spread slots."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from teo_sign_training.corpus.grammar import Grammar, Rule, allows


@dataclass(frozen=True, slots=True)
class Template:
    """A sentence rule with its spread slots decided.

    Attributes:
        name: `family.rule`, then the alternative of each spread slot: `statement.plain.thing`.
        rule: Of the family.
        spread: Alternative by slot.
        weight: How often, among all templates; they sum up to 1.
    """

    name: str
    rule: Rule
    spread: Mapping[str, str]
    weight: float


def templates(grammar: Grammar) -> list[Template]:
    """All templates of a grammar."""
    total = sum(family.weight for family in grammar.families)
    found: list[Template] = []
    for family in grammar.families:
        rules = sum(rule.weight for rule in family.rules)
        for rule in family.rules:
            share = family.weight / total * rule.weight / rules
            found += _of_rule(grammar, family.name, rule, share)
    return found


def _of_rule(grammar: Grammar, family: str, rule: Rule, share: float) -> Iterator[Template]:
    slots = [slot for slot in rule.slots if slot.spread]
    choices = [
        [
            (each.name, each.weight)
            for each in grammar.categories[slot.category]
            if _possible(each, slot.arguments)
        ]
        for slot in slots
    ]
    total = 1.0
    for alternatives in choices:
        total *= sum(weight for _, weight in alternatives)
    for combination in product(*choices):
        weight = share / total
        for _, each in combination:
            weight *= each
        names = [name for name, _ in combination]
        yield Template(
            ".".join([family, rule.name, *names]),
            rule,
            {slot.name: name for slot, name in zip(slots, names, strict=True)},
            weight,
        )


def _possible(rule: Rule, arguments: tuple[tuple[str, str], ...]) -> bool:
    """Whether an alternative may be taken under the features that the rule itself fixes."""
    given = dict(arguments)
    for key, allowed in rule.when:
        value = given.get(key, "-")
        if not value.startswith("$") and not allows(allowed, [value]):
            return False
    return True
