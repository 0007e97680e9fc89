# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The order of a clause: modifiers behind their noun, verbs behind their objects, NO and questions last."""

from __future__ import annotations

from collections.abc import Sequence

from teo_sign_translator.data_files import words_of
from teo_sign_translator.pipeline.drafting.item import Item
from teo_sign_translator.pipeline.drafting.times import HOUR
from teo_sign_translator.text.source_words import SourceWord

_NO = "NO"
_MODALS = ("PODER", "DEBER")
_BESIDE = tuple(words_of("DEBAJO ENCIMA DELANTE DETRÁS CERCA LEJOS DENTRO FUERA ENFRENTE ALREDEDOR JUNTO"))
_PERSONS = ("PRON:1", "PRON:2", "PRON:3", "PRON:prep")
_NOMINAL = ("N:", "A:", "NAME", "NUM", "DET", "X")
# Tags of what stands before its verb: what is done, to whom, with what and where, and who does it.
_OF_VERBS = (*_NOMINAL, "V:part", *_PERSONS, "ADV:place")


def modifiers_behind(items: Sequence[Item]) -> list[Item]:
    """Possessives and adjectives behind their noun (16 of 25 counted), "muy" behind its adjective."""
    result = list(items)
    for index in range(len(result) - 2, -1, -1):
        modifies = result[index].is_a("DET:poss", "A:") or result[index].gloss in ("MUCHO", "POCO")
        beside = result[index].places[-1] + 1 == result[index + 1].places[0]
        qualifies = modifies and result[index].is_a("DET", "A:") and result[index + 1].is_a("N:")
        grades = result[index].is_a("ADV:degree") and result[index + 1].is_a("A:", "ADV")
        if beside and (qualifies or grades):
            result[index], result[index + 1] = result[index + 1], result[index]
    return result


def places_behind(items: Sequence[Item], words: Sequence[SourceWord]) -> list[Item]:
    """Where something is behind what it is near: "debajo de la cama" is CAMA DEBAJO."""
    result = list(items)
    for index in range(len(result) - 2, -1, -1):
        place = result[index].places[-1] + 1
        if not result[index].is_a("ADV:place", "PREP") or result[index].gloss not in _BESIDE:
            continue
        if place < len(words) and words[place].form in ("de", "del", "a", "al"):
            end = index + 1
            while end < len(result) and result[end].is_a(*_NOMINAL):
                end += 1
            result.insert(end - 1, result.pop(index))
    return result


def verbs_behind(items: Sequence[Item], words: Sequence[SourceWord]) -> list[Item]:
    """Verbs behind what they are said with: object, place and a subject that the text has behind them.

    Signers have as many objects before the verb as behind it (10 to 10), and grammars of LSE name the order
    before it; the subject is before the verb 65 times of 82. What governs an infinitive stays before it.
    """
    result = list(items)
    verbs = {item.places for item in items if item.is_a("V:")}
    for index in range(len(result) - 1, -1, -1):
        governs = index + 1 < len(items) and items[index + 1].is_a("V:inf", "V:ger")
        if not result[index].is_a("V:") or governs:
            continue
        end = index + 1
        while end < len(result) and (_stands_before_verb(result, end) or _joins_nouns(result, end)):
            next_subject = result[end].is_a(*_PERSONS) and result[end].places in verbs
            if next_subject or _begins_clause(words, result[end].places[0]):
                break
            end += 1
        result.insert(end - 1, result.pop(index))
    return result


def _stands_before_verb(items: Sequence[Item], index: int) -> bool:
    """Whether an item goes before its verb; "mucho" alone says how, and stays behind it."""
    alone = index + 1 == len(items) or not items[index + 1].is_a("N:", "A:", "X", "NUM", "DET")
    return items[index].is_a(*_OF_VERBS) and not (items[index].is_a("DET:quant") and alone)


def _begins_clause(words: Sequence[SourceWord], place: int) -> bool:
    """Whether "que" stands before a word, with articles and prepositions between at most."""
    while place and words[place - 1].readings[0].tag.startswith(("DET", "PREP")):
        place -= 1
    return place > 0 and words[place - 1].form == "que"


def _joins_nouns(items: Sequence[Item], index: int) -> bool:
    return items[index].gloss == "O" and index + 1 < len(items) and items[index + 1].is_a(*_OF_VERBS)


def modals_behind(items: Sequence[Item]) -> list[Item]:
    """PODER and DEBER at the end of their clause (of requests 6 of 6)."""
    modals = [item for item in items if item.is_a("V:") and item.gloss in _MODALS]
    modals = [each for each in modals if any(other.is_a("V:inf") and other not in modals for other in items)]
    denied = [
        items[index]
        for index in range(len(items) - 1)
        if items[index].gloss == _NO and items[index + 1] in modals
    ]
    moved = [*modals, *denied]
    return [*(item for item in items if item not in moved), *moved]


def negation_behind(items: Sequence[Item]) -> list[Item]:
    """NO behind the verb that it denies, or at the end where none is left; once beside NADA or NADIE."""
    result = list(items)
    if any(item.is_a("PRON:neg") or item.gloss in ("NUNCA", "NINGÚN", "TAMPOCO") for item in result):
        return [item for item in result if item.gloss != _NO]
    for index in range(len(result) - 1, -1, -1):
        if result[index].gloss != _NO:
            continue
        behind = next((at for at in range(index + 1, len(result)) if result[at].is_a("V:")), None)
        item = result.pop(index)
        if behind is not None:
            result.insert(behind, item)
        elif index and result[index - 1].gloss in _MODALS:
            result.insert(index, item)
        else:
            result.append(item)
    return result


def questions_last(items: Sequence[Item]) -> tuple[list[Item], list[Item]]:
    """What is asked, and the question words, which are last: of "qué" and a noun it is CUÁL."""
    asking = [item for item in items if item.is_a("WH")]
    hour: list[Item] = []
    for item in asking:
        index = items.index(item)
        if item.gloss == "QUÉ" and index + 1 < len(items) and items[index + 1].is_a("N:"):
            item.gloss = "CUÁL"
            if items[index + 1].gloss == HOUR:
                hour = [items[index + 1]]
    last = [*hour, *asking]
    return [item for item in items if item not in last], last
