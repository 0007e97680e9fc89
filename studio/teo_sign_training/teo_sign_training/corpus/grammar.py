# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a grammar is made of, its templates, and the tenses that suit a place; `grammar_file` reads it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product

from teo_sign_training.corpus.writing import Writing

#: Kinds of slots that are filled from the word lists; every other name is a category of the grammar.
LEXICAL = ("noun", "adj", "verb", "name", "number", "adverb")


#: Sources of a gloss: the verb's ending, a clitic, the ending where another person could be meant.
VERB, CLITIC, DOER = "^", "@", "^?"


@dataclass(frozen=True, slots=True)
class TextItem:
    """One item of the text side: a slot, an agreeing paradigm word or a literal.

    Attributes:
        slot: Name of the slot; empty for a word.
        word: The word or mark; empty for a slot.
        agree: Slot that it agrees with; empty if with none.
    """

    slot: str
    word: str
    agree: str


@dataclass(frozen=True, slots=True)
class GlossItem:
    """One item of the side of signs: a slot or a gloss.

    Attributes:
        slot: Name of the slot; else empty.
        also: Slot whose head says the glosses too; empty for none.
        gloss: The gloss; empty for a slot.
        sources: Words of the text side, `{slot}`s, `VERB`, `CLITIC` or `DOER`.
    """

    slot: str = ""
    also: str = ""
    gloss: str = ""
    sources: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Slot:
    """What fills one slot of a rule.

    Attributes:
        name: As the rule's two sides call it.
        category: A category of the grammar or one of `LEXICAL`.
        arguments: Features handed down; a value that begins with `$` is looked up: `$V.object` a feature of
            the earlier slot V, `$pol` one that was handed to this rule.
        spread: Whether each alternative of the category makes a template of its own (`*` in the file).
    """

    name: str
    category: str
    arguments: tuple[tuple[str, str], ...]
    spread: bool


@dataclass(frozen=True, slots=True)
class Example:
    """What a rule makes when its choices are fixed.

    Attributes:
        text: The sentence.
        glosses: Its translation.
        fixed: Choice by path (`S.P.n`), or by a slot's name alone, wherever it is: name of an alternative or
            a lemma. All else takes the first there is.
    """

    text: str
    glosses: tuple[str, ...]
    fixed: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Rule:
    """One alternative of a category, or one sentence of a family.

    Attributes:
        name: Unique in its category or family.
        where: File and name, for messages.
        weight: How often, among its neighbours.
        when: Features that must have been handed down: each value must be among those given.
        slots: In the order in which they are filled.
        text: The side of the spoken language.
        glosses: The side of the sign language.
        features: What it adds to the features of its head.
        head: Slot whose features (person, number, gender) it takes; empty for none.
        example: Of sentences; categories have none.
        repeat: How often training may see the same sentence: set phrases are few, but said often.
    """

    name: str
    where: str
    weight: float
    when: tuple[tuple[str, tuple[str, ...]], ...]
    slots: tuple[Slot, ...]
    text: tuple[TextItem, ...]
    glosses: tuple[GlossItem, ...]
    features: tuple[tuple[str, str], ...]
    head: str
    example: Example | None
    repeat: int


@dataclass(frozen=True, slots=True)
class ShapePart:
    """One word of a verb's shape.

    Attributes:
        lemma: Auxiliary; empty for the main verb, or for a literal.
        tag: Form, without the person where it is finite; `readings.TAGS` plus the person.
        literal: A word as it is (`que`, `a`, `de`); `^` is where clitics stand.
        enclitic: Whether clitics hang on this form.
    """

    lemma: str
    tag: str
    literal: str
    enclitic: bool


@dataclass(frozen=True, slots=True)
class Shape:
    """How a verb is said: its tense, mood and modal, with what they add in LSE.

    Attributes:
        name: Unique.
        weight: How often, among those that fit.
        mood: ind, sub, sub_past, inf, imp, neg_imp, ger or part.
        time: past, present or future.
        kind: "event": only of verbs that are events; else empty.
        dated: Whether it is said with a past date: not the perfect ("ayer he ido").
        parts: Words.
        glosses: `*` the main verb, with the lemma of an auxiliary that says it too or none; else gloss and
            lemma of the auxiliary that says it.
    """

    name: str
    weight: float
    mood: str
    time: str
    kind: str
    dated: bool
    parts: tuple[ShapePart, ...]
    glosses: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Family:
    """Sentences of one construction; its weight says how often, among the families."""

    name: str
    weight: float
    rules: tuple[Rule, ...]


@dataclass(frozen=True)
class Grammar:
    """The whole grammar.

    Attributes:
        families: Sentences.
        categories: Phrases by category.
        shapes: Of verbs.
        paradigms: Agreeing words: masculine and feminine singular, then plural.
        word_lists: Lists of the grammar's own, by name (nouns, names, …).
        held_out: Names of templates that only tests see.
        constructions: For each construction that a corpus may be made without, all that says it: families
            (`condition`), sentence rules (`in_case.if_then`) and alternatives of categories
            (`vp.better_than`).
        writing: How words that meet are written, and the pronouns at verbs.
    """

    families: tuple[Family, ...]
    categories: Mapping[str, tuple[Rule, ...]]
    shapes: tuple[Shape, ...]
    paradigms: Mapping[str, tuple[str, str, str, str]]
    word_lists: Mapping[str, tuple[str, ...]]
    held_out: frozenset[str]
    constructions: Mapping[str, tuple[str, ...]]
    writing: Writing

    def rules(self) -> list[Rule]:
        """All sentence rules and alternatives."""
        groups = (*(family.rules for family in self.families), *self.categories.values())
        return [rule for rules in groups for rule in rules]

    def without_constructions(self) -> Grammar:
        """The grammar without the sentence rules and alternatives of all `constructions`."""
        gone = {name for names in self.constructions.values() for name in names}
        families = (
            replace(
                family, rules=tuple(rule for rule in family.rules if f"{family.name}.{rule.name}" not in gone)
            )
            for family in self.families
            if family.name not in gone
        )
        categories = {
            category: tuple(rule for rule in rules if f"{category}.{rule.name}" not in gone)
            for category, rules in self.categories.items()
        }
        return replace(
            self, families=tuple(family for family in families if family.rules), categories=categories
        )


def fits(rule: Rule, features: Mapping[str, str]) -> bool:
    """Whether the features handed down are what the rule wants."""
    return all(_allows(allowed, features.get(key, "-").split(",")) for key, allowed in rule.when)


def _allows(allowed: Sequence[str], given: Sequence[str]) -> bool:
    """Whether one of the values is allowed; where values are forbidden (`!neg`), whether none is given."""
    forbidden = [value[1:] for value in allowed if value.startswith("!")]
    if forbidden:
        return not any(value in forbidden for value in given)
    return any(value in allowed for value in given)


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
        if not value.startswith("$") and not _allows(allowed, [value]):
            return False
    return True


@dataclass
class Tenses:
    """Finds the shapes of a grammar that suit a place.

    Attributes:
        shapes: All of them.
        lists: Names of several shapes; `plans` are those of the present that speak of what is to come
            ("mañana voy").
    """

    shapes: Sequence[Shape]
    lists: Mapping[str, tuple[str, ...]]
    _found: dict[tuple[str, ...], tuple[Shape, ...]] = field(default_factory=dict)

    def fitting(self, mood: str, says: str, kind: str, only: str) -> tuple[Shape, ...]:
        """The shapes that suit a place.

        Args:
            mood: Of the clause.
            says: Time that a time word says; empty or "any" for none.
            kind: "event" or "state".
            only: Shapes or lists of them, separated by commas; groups joined by `&` must all allow a shape.
        """
        key = (mood, says, kind, only)
        if key not in self._found:
            allowed = [
                {name for each in part.split(",") for name in self.lists.get(each, (each,))}
                for part in only.split("&")
                if part
            ]
            self._found[key] = tuple(
                shape
                for shape in self.shapes
                if shape.mood == mood
                and all(shape.name in names for names in allowed)
                and (shape.kind != "event" or kind == "event")
                and _time_fits(says, shape, kind, self.lists.get("plans", ()))
            )
        return self._found[key]


def _time_fits(says: str, shape: Shape, kind: str, plans: Sequence[str]) -> bool:
    """Whether a tense goes with a time word."""
    if says in ("", "any"):
        return True
    if says == "past":
        return shape.time == "past" and shape.dated
    if says == "future":
        return shape.time == "future" or (shape.time == "present" and shape.name in plans and kind == "event")
    return shape.time == says
