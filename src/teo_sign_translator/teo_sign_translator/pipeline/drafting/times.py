# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words that say when: they come first."""

from __future__ import annotations

from collections.abc import Sequence

from teo_sign_translator.morphology import Reading
from teo_sign_translator.morphology.lexicon import nouns
from teo_sign_translator.pipeline.drafting.item import Item
from teo_sign_translator.text.source_words import SourceWord

AGE = "EDAD"
HOUR = "HORA"
_LAST_HOUR = 24
# What stands behind an hour: las dos y media, las dos menos cuarto.
_OF_HOURS = ("MEDIA", "MEDIO", "CUARTO", "MENOS")
#: Lengths of time: "hace dos meses", "llevo un mes" are the length alone.
LENGTHS = ("semana", "mes", "año", "hora", "minuto", "día", "rato", "tiempo")
# Words of time that say so of the noun behind "de": antes de Navidad.
_RELATIVE_TIMES = ("ANTES", "DESPUÉS")
_SPANS = ("DESDE", "HASTA", "ENTRE", "DENTRO")
# These say how far the verb has come, not when.
_WITH_VERBS = ("YA", "TODAVÍA")
# A time that is a count: "dos veces" says how often, not when.
_OCCASION = "VEZ"
# Glosses that go with a word of time before them, and those that may stand before it.
_OF_TIMES = ("PASADO", "PRÓXIMO", "SIGUIENTE", "PASAR")
_BEFORE_TIMES = ("PRÓXIMO", "ÚLTIMO")
_TIMES = frozenset(noun.lemma for noun in nouns() if noun.classes[0] == "time")


def tells_hour(reading: Reading, following: Sequence[Reading]) -> bool:
    """Whether an article stands before an hour: "las dos" with no noun that is counted."""
    if not reading.tag.startswith(("DET:def:fp", "DET:def:fs")) or not following:
        return False
    hour, *behind = following
    counted = bool(behind) and behind[0].tag.startswith("N:f")
    return hour.tag == "NUM" and hour.lemma.isdigit() and int(hour.lemma) <= _LAST_HOUR and not counted


def is_length(items: Sequence[Item]) -> bool:
    """Whether a number or "mucho" and a length of time come next."""
    return (
        len(items) == 2
        and items[0].is_a("NUM", "DET:quant", "A:")
        and items[1].reading is not None
        and items[1].reading.lemma in LENGTHS
    )


def times_first(items: Sequence[Item], words: Sequence[SourceWord]) -> tuple[list[Item], list[Item]]:
    """Words that say when, and all others; a word of time with its determiners, numbers and noun."""
    when: set[int] = set()
    for index, item in enumerate(items):
        if item.gloss in _WITH_VERBS or (index and items[index - 1].is_a("WH")):  # "¿a qué hora?" is last
            continue
        if item.is_a("ADV:time") and not item.is_a("ADV:time:frequency"):
            when.add(index)
            of_noun = any(word.form in ("de", "del") for word in words[item.places[-1] + 1 :][:1])
            if item.gloss in _RELATIVE_TIMES and of_noun and index + 1 < len(items):
                when.add(index + 1)
        elif item.gloss not in (AGE, _OCCASION) and item.reading is not None and _names_time(item.reading):
            before = items[index - 1] if index else None
            if before is not None and before.is_a("A:") and not before.gloss.startswith(_BEFORE_TIMES):
                continue  # "buen día" is no time
            when.add(index)
            start = index - 1
            while start >= 0 and _goes_with_time(items[start]):
                when.add(start)
                start -= 1
            if index + 1 < len(items) and items[index + 1].gloss in _OF_TIMES:
                when.add(index + 1)
            behind = index + 1
            while item.gloss == HOUR and behind < len(items) and _of_hour(items[behind]):
                if items[behind].gloss == "MEDIO":  # "las dos y media" has a sign of its own
                    items[behind].gloss = "MEDIA"
                when.add(behind)
                behind += 1
    first = [item for index, item in enumerate(items) if index in when]
    return first, [item for index, item in enumerate(items) if index not in when]


def _goes_with_time(item: Item) -> bool:
    return item.is_a("DET:dem", "DET:quant", "NUM", "A:") or item.gloss in _SPANS


def _of_hour(item: Item) -> bool:
    return item.is_a("NUM") or item.gloss in _OF_HOURS


def _names_time(reading: Reading) -> bool:
    return reading.tag.startswith("N:") and reading.lemma in _TIMES
