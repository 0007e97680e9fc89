# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who does what a clause says, and to whom, where only an ending or a clitic pronoun names them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from teo_sign_translator.data_files import words_of
from teo_sign_translator.morphology import Reading
from teo_sign_translator.pipeline.drafting.item import FINITE, Item

_SUBJECTS = {"1s": "YO", "2s": "TÚ", "1p": "NOSOTROS", "2p": "VOSOTROS"}
#: Gloss and person of the clitic pronouns that name one.
OBJECTS = {"me": ("YO", "1s"), "te": ("TÚ", "2s"), "nos": ("NOSOTROS", "1p"), "os": ("VOSOTROS", "2p")}
# Whom these befall is signed as their subject: "me duele la cabeza" is YO CABEZA DOLER.
_BEFALLING = frozenset(
    words_of("gustar doler encantar parecer apetecer faltar interesar importar molestar preocupar sobrar")
)
# The direction of these says who gets something: "me" is no sign of its own.
_DIRECTED = frozenset(
    words_of("dar ayudar decir preguntar enseñar avisar pedir explicar mandar enviar contar llamar prestar")
)
# "Quería", "quisiera" at the beginning is said of oneself.
_POLITE = ("V:ind:impf:3s", "V:sub:impf:3s")


def is_implied(clitic: str, verb: Reading) -> bool:
    """Whether the verb says a clitic: its subject is the same (me lavo), or its direction says it (dame)."""
    person = OBJECTS[clitic][1]
    return (
        verb.tag.endswith(f":{person}")
        or (verb.lemma in _DIRECTED and person == "1s")
        or (verb.tag in ("V:inf", "V:ger") and person == "1s")
    )


def named_subjects(
    items: list[Item], meant: Mapping[int, Reading], places: Sequence[int], *, asks: bool
) -> list[Item]:
    """The subject that only a verb's ending names, for the front, and whom something befalls.

    That of a second verb, where it is another, goes before it into the items.
    """
    if any(reading.lemma in _BEFALLING for reading in meant.values()):
        for item in items:
            if item.is_a("PRON:obj"):
                items.remove(item)
                return [item]
    said = {item.reading.tag[5:7] for item in items if item.reading and item.is_a("PRON:1", "PRON:2")}
    before = ""
    front: list[Item] = []
    for place in places:
        tag = meant[place].tag
        if not tag.startswith(FINITE) or not meant[place].exact:  # a guess names nobody
            continue
        person = "" if tag.startswith("V:imp") else tag[-2:]
        polite = place == places[0] and meant[place].lemma == "querer" and tag in _POLITE
        if polite:
            person = "1s"
        requests = asks and meant[place].lemma == "poder" and person[:1] == "2"
        denied = tag.startswith("V:sub") and not before and not polite  # "no toques eso"
        gloss = _SUBJECTS.get(person)
        if gloss and person not in (before, *said) and not requests and not denied:
            subject = Item(gloss, (place,), Reading(gloss.lower(), f"PRON:{person}"))
            if before:  # of a second verb: "no hace falta que vengas"
                index = next((at for at, item in enumerate(items) if place in item.places), len(items))
                items.insert(index, subject)
            else:
                front.append(subject)
        before = person or tag
    return front
