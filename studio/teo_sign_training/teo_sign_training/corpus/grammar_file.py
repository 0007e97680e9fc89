# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Reads and checks `text/grammar/*.yaml`.

Text: words and marks separated by spaces. `{X}` is what slot X says, `{V:S}` a verb agreeing with slot S,
`un~n` the paradigm word "un" agreeing with slot n.

Signs: `{X}` the glosses of slot X, `{n+V}` the same, which the head of slot V says too ("da miedo": MIEDO).
`GLOSS` is a gloss that no word says, `GLOSS=word+word` one that those words of the text side say (`word#2`
the second of them, `{X}` the head of a slot), `GLOSS=^` one that the verb's ending says, `GLOSS=@` one that a
clitic pronoun says.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NoReturn

import yaml

from teo_sign_training.corpus.grammar import (
    CLITIC,
    DOER,
    LEXICAL,
    VERB,
    Example,
    Family,
    GlossItem,
    Grammar,
    Rule,
    Shape,
    ShapePart,
    Slot,
    TextItem,
)
from teo_sign_training.corpus.writing import parse_writing
from teo_sign_translator.errors import TranslationError

_SLOT = re.compile(r"\{(?P<slot>\w+)(?::(?P<agree>\w+))?\}")
_AGREEING = re.compile(r"(?P<word>\w+)~(?P<agree>\w+)")
_LITERAL = re.compile(r"'?\w+|[¿?¡!,.:]")
_GLOSS_SLOT = re.compile(r"\{(?P<slot>\w+)(?:\+(?P<also>\w+))?\}")
_GLOSS = re.compile(r"(?P<gloss>[A-ZÁÉÍÓÚÜÑ0-9_]+)(?:=(?P<sources>\S+))?")


def _parse_text(text: str) -> tuple[TextItem, ...]:
    items: list[TextItem] = []
    for written in text.split():
        if match := _SLOT.fullmatch(written):
            items.append(TextItem(match["slot"], "", match["agree"] or ""))
        elif match := _AGREEING.fullmatch(written):
            items.append(TextItem("", match["word"], match["agree"]))
        elif _LITERAL.fullmatch(written):
            items.append(TextItem("", written, ""))
        else:
            raise TranslationError(
                "invalid_grammar",
                f"expected a word, a mark, {{slot}}, {{verb:subject}} or word~slot, got '{written}'",
            )
    return tuple(items)


def _parse_glosses(text: str) -> tuple[GlossItem, ...]:
    items: list[GlossItem] = []
    for written in text.split():
        if match := _GLOSS_SLOT.fullmatch(written):
            items.append(GlossItem(match["slot"], match["also"] or ""))
        elif match := _GLOSS.fullmatch(written):
            sources = tuple(match["sources"].split("+")) if match["sources"] else ()
            items.append(GlossItem(gloss=match["gloss"], sources=sources))
        else:
            raise TranslationError(
                "invalid_grammar", f"expected GLOSS, GLOSS=word or {{slot}}, got '{written}'"
            )
    return tuple(items)


_SECTIONS = (
    "families",
    "categories",
    "shapes",
    "paradigms",
    "word_lists",
    "held_out",
    "constructions",
    "writing",
)
_RULE_KEYS = ("weight", "when", "pick", "text", "signs", "set", "head", "example", "repeat")
_SHAPE_KEYS = ("weight", "mood", "time", "kind", "dated", "text", "signs")
_MOODS = ("ind", "sub", "sub_past", "inf", "imp", "neg_imp", "ger", "part")
_TIMES = ("past", "present", "future")
_PART = re.compile(r"(?P<lemma>\w*)(?P<main>\*?)/(?P<tag>[\w:]+)(?P<enclitic>\+?)")


def load_grammar(folder: Path) -> Grammar:
    """Read all files of a folder.

    Raises:
        TranslationError: "invalid_grammar" naming file and rule.
    """
    merged: dict[str, dict[str, Any]] = {section: {} for section in _SECTIONS}
    paths = sorted(folder.glob("*.yaml"))
    if not paths:
        raise TranslationError("invalid_grammar", f"{folder}: expected .yaml files, found none")
    for path in paths:
        for section, name, content in _entries(path):
            if name in merged[section]:
                _fail(f"{path.name}: {section}", f"each name once, got '{name}' again")
            merged[section][name] = (path.name, content)
    paradigms = {name: _four(where, name, forms) for name, (where, forms) in merged["paradigms"].items()}
    categories = {
        name: tuple(
            _rule(f"{where}: {name}.{key}", str(key), body, paradigms)
            for key, body in _mapping(where, name, rules)
        )
        for name, (where, rules) in merged["categories"].items()
    }
    families = tuple(
        _family(where, name, body, paradigms) for name, (where, body) in merged["families"].items()
    )
    word_lists = {
        name: tuple(_text(f"{where}: {name}", words).split())
        for name, (where, words) in merged["word_lists"].items()
    }
    writing = {
        name: {
            key: _text(f"{where}: writing.{name}.{key}", text) for key, text in _mapping(where, name, body)
        }
        for name, (where, body) in merged["writing"].items()
    }
    grammar = Grammar(
        families=families,
        categories=categories,
        shapes=tuple(
            _shape(f"{where}: {name}", name, body) for name, (where, body) in merged["shapes"].items()
        ),
        paradigms=paradigms,
        word_lists=word_lists,
        held_out=frozenset(merged["held_out"]),
        constructions={
            name: tuple(_text(f"{where}: {name}", names).split())
            for name, (where, names) in merged["constructions"].items()
        },
        writing=parse_writing(writing, word_lists),
    )
    _check_links(grammar)
    return grammar


def _entries(path: Path) -> Iterator[tuple[str, str, Any]]:
    try:
        content = yaml.load(path.read_text(encoding="utf-8"), Loader=yaml.CSafeLoader)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise TranslationError("invalid_grammar", f"{path}: expected readable YAML: {error}") from error
    if not isinstance(content, dict):
        _fail(path.name, f"a mapping of {_SECTIONS}, got {type(content).__name__}")
    for section, entries in content.items():
        if section not in _SECTIONS:
            _fail(path.name, f"sections {_SECTIONS}, got '{section}'")
        if section == "held_out" and isinstance(entries, list):
            entries = dict.fromkeys(entries)
        if not isinstance(entries, dict):
            _fail(f"{path.name}: {section}", "names with their content")
        for name, body in entries.items():
            if not isinstance(name, str):
                _fail(
                    f"{path.name}: {section}",
                    f"names in quotes where YAML reads them otherwise, got {name!r}",
                )
            yield section, name, body


def _family(where: str, name: str, body: Any, paradigms: Mapping[str, Any]) -> Family:
    place = f"{where}: {name}"
    if not isinstance(body, dict) or set(body) != {"weight", "rules"}:
        _fail(place, "'weight' and 'rules'")
    rules = tuple(
        _rule(f"{place}.{key}", str(key), content, paradigms)
        for key, content in _mapping(where, name, body["rules"])
    )
    for rule in rules:
        if rule.example is None:
            _fail(rule.where, "an example")
    return Family(name, _number(place, body["weight"]), rules)


def _rule(where: str, name: str, body: Any, paradigms: Mapping[str, Any]) -> Rule:
    _check_keys(where, body, _RULE_KEYS)
    try:
        text = _parse_text(_text(where, body["text"]))
        glosses = _parse_glosses(_text(where, body["signs"]))
    except TranslationError as error:
        raise TranslationError(error.code, f"{where}: {error}") from error
    slots = tuple(_slot(where, key, text) for key, text in _mapping(where, "pick", body.get("pick", {})))
    names = {slot.name for slot in slots}
    _check_sides(where, names, text, glosses, paradigms)
    head = body.get("head", slots[0].name if slots else "")
    if head and head not in names:
        _fail(where, f"a head among {sorted(names)}, got '{head}'")
    return Rule(
        name=name,
        where=where,
        weight=_number(where, body.get("weight", 1)),
        when=tuple(
            (key, tuple(str(value).split())) for key, value in _mapping(where, "when", body.get("when", {}))
        ),
        slots=slots,
        text=text,
        glosses=glosses,
        features=tuple((key, str(value)) for key, value in _mapping(where, "set", body.get("set", {}))),
        head=head,
        example=_example(where, body["example"]) if "example" in body else None,
        repeat=round(_number(where, body.get("repeat", 1))),
    )


def _slot(where: str, name: str, text: Any) -> Slot:
    words = _text(where, text).split()
    if not words:
        _fail(where, f"a category for slot '{name}'")
    arguments: list[tuple[str, str]] = []
    for word in words[1:]:
        key, equals, value = word.partition("=")
        if not equals or not value:
            _fail(where, f"feature=value in slot '{name}', got '{word}'")
        arguments.append((key, value))
    return Slot(name, words[0].removeprefix("*"), tuple(arguments), words[0].startswith("*"))


def _example(where: str, body: Any) -> Example:
    _check_keys(f"{where}: example", body, ("text", "signs", "fix"))
    fixed = {key: str(value) for key, value in _mapping(where, "fix", body.get("fix", {}))}
    return Example(_text(where, body["text"]), tuple(_text(where, body["signs"]).split()), fixed)


def _check_sides(
    where: str,
    names: set[str],
    text: tuple[TextItem, ...],
    glosses: tuple[GlossItem, ...],
    paradigms: Mapping[str, Any],
) -> None:
    for item in text:
        for slot in (item.slot, item.agree):
            if slot and slot not in names:
                _fail(where, f"slots {sorted(names)} in 'text', got '{slot}'")
        if item.agree and item.word and item.word not in paradigms:
            _fail(where, f"a paradigm of {sorted(paradigms)}, got '{item.word}'")
    counted = Counter(item.word for item in text)
    words = {f"{word}#{n}" if n > 1 else word for word, count in counted.items() for n in range(1, count + 1)}
    for gloss in glosses:
        for slot in (gloss.slot, gloss.also):
            if slot and slot not in names:
                _fail(where, f"slots {sorted(names)} in 'signs', got '{slot}'")
        for source in gloss.sources:
            known = source.strip("{}") in names if source.startswith("{") else source in words
            if not known and source not in (VERB, CLITIC, DOER):
                _fail(where, f"words of 'text' as sources in 'signs', got '{source}'")


def _shape(where: str, name: str, body: Any) -> Shape:
    _check_keys(where, body, _SHAPE_KEYS)
    mood, time = body.get("mood", "ind"), body.get("time", "present")
    if mood not in _MOODS or time not in _TIMES:
        _fail(where, f"a mood of {_MOODS} and a time of {_TIMES}, got '{mood}', '{time}'")
    parts: list[ShapePart] = []
    for written in _text(where, body["text"]).split():
        match = _PART.fullmatch(written)
        if match and (match["lemma"] or match["main"]):
            parts.append(ShapePart(match["lemma"], match["tag"], "", bool(match["enclitic"])))
        elif written.replace("_", "").isalpha() or written == "^":
            parts.append(ShapePart("", "", written, False))
        else:
            _fail(where, f"*/tag, auxiliary/tag, a word or ^, got '{written}'")
    known = {part.lemma for part in parts} | {part.literal for part in parts}
    glosses: list[tuple[str, str]] = []
    for written in _text(where, body["signs"]).split():
        gloss, _, source = written.partition("=")
        if source not in known and not (gloss == "*" and not source):
            _fail(where, f"* or GLOSS=auxiliary, got '{written}'")
        glosses.append((gloss, source))
    return Shape(
        name,
        _number(where, body.get("weight", 1)),
        mood,
        time,
        _text(where, body.get("kind", "")),
        bool(body.get("dated", True)),
        tuple(parts),
        tuple(glosses),
    )


def _check_links(grammar: Grammar) -> None:
    for rule in grammar.rules():
        earlier: set[str] = set()
        for slot in rule.slots:
            if slot.category not in LEXICAL and slot.category not in grammar.categories:
                _fail(rule.where, f"a category for slot '{slot.name}', got '{slot.category}'")
            for _, value in slot.arguments:
                name, dot, _ = value.removeprefix("$").partition(".")
                if value.startswith("$") and dot and name not in earlier:
                    _fail(rule.where, f"a slot filled before '{slot.name}', got '{value}'")
            earlier.add(slot.name)
        said = {item.slot for item in rule.text}
        for slot in rule.slots:
            silent = all(not each.text for each in grammar.categories.get(slot.category, ()))
            signed = any(item.slot == slot.name for item in rule.glosses)
            if signed and slot.name not in said and (slot.category in LEXICAL or not silent):
                _fail(rule.where, f"slot '{slot.name}' in 'text' since it is in 'signs'")
    known = {
        name for family in grammar.families for name in (family.name, *_names(family.name, family.rules))
    }
    known |= {name for category, rules in grammar.categories.items() for name in _names(category, rules)}
    for construction, names in grammar.constructions.items():
        if unknown := sorted(set(names) - known):
            _fail(f"constructions: {construction}", f"families, their rules or alternatives, got {unknown}")


def _names(group: str, rules: tuple[Rule, ...]) -> list[str]:
    return [f"{group}.{rule.name}" for rule in rules]


def _four(where: str, name: str, forms: Any) -> tuple[str, str, str, str]:
    words = _text(f"{where}: {name}", forms).split()
    if len(words) != 4:
        _fail(f"{where}: {name}", f"four forms (ms fs mp fp), got {words}")
    return words[0], words[1], words[2], words[3]


def _mapping(where: str, name: str, value: Any) -> list[tuple[str, Any]]:
    if not isinstance(value, dict):
        _fail(f"{where}: {name}", f"a mapping, got {type(value).__name__}")
    for key in value:
        if not isinstance(key, str):
            _fail(f"{where}: {name}", f"names in quotes where YAML needs them, got {key!r}")
    return list(value.items())


def _text(where: str, value: Any) -> str:
    if not isinstance(value, str):
        _fail(where, f"text, got {value!r}")
    return value


def _number(where: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or value <= 0:
        _fail(where, f"a weight above 0, got {value!r}")
    return float(value)


def _check_keys(where: str, body: Any, known: tuple[str, ...]) -> None:
    if not isinstance(body, dict) or not {"text", "signs"} <= set(body) <= set(known):
        got = [str(key) for key in body] if isinstance(body, dict) else [type(body).__name__]
        _fail(where, f"'text' and 'signs', and of {known} what is needed, got {got}")


def _fail(where: str, expected: str) -> NoReturn:
    raise TranslationError("invalid_grammar", f"{where}: expected {expected}")
