# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Readings of unknown words, guessed from their endings."""

from __future__ import annotations

import re

from teo_common.text_folding import strip_marks
from teo_sign_translator.morphology.conjugation import Conjugations
from teo_sign_translator.morphology.reading import Reading

#: The verb whose endings new verbs take (guglear), and its forms that hardly any noun looks like: -ado,
#: -ara, -ase, -aste and -o are endings of nouns too.
_MODEL = "amar"
_TELLING_FORMS = ("V:ger", "V:ind:impf", "V:ind:fut", "V:cond", "V:ind:pret:2p", "V:ind:pret:3p")

#: Infinitives of new verbs end so; nouns end in -ar (hogar), hardly ever so.
_NEW_INFINITIVES = ("ear", "izar", "ificar")

#: Endings of plurals and of their singulars; the first that fits counts.
_PLURALS = tuple(
    (re.compile(several + "$"), one)
    for several, one in (
        ("([cs])iones", r"\1ión"),
        ("ones", "ón"),
        ("anes", "án"),
        ("ines", "ín"),
        ("eses", "és"),
        ("ces", "z"),
        ("(?<=[aeiouáéíóú])([lrd])es", r"\1"),
        ("([aáeéoó])s", r"\1"),
    )
)
#: Endings that only nouns have, with their gender.
_NOUNS = (
    (("ción", "sión", "dad", "tad", "tud"), "f"),
    (("miento", "ismo", "aje"), "m"),
    (("ista",), "c"),
)
#: Shortest word that is taken for a plural [letters]: "gas" and "dos" are none.
_SHORTEST_PLURAL = 5


def guess(form: str, conjugations: Conjugations) -> Reading:
    """The likeliest reading of an unknown word in lower case."""
    for cut in range(2, len(form)):
        for ending, tag in conjugations.endings(_MODEL, strip_marks(form[cut:])):
            if ending == form[cut:] and tag.startswith(_TELLING_FORMS):
                return Reading(form[:cut] + "ar", tag, exact=False)
    if form.endswith(_NEW_INFINITIVES):
        return Reading(form, "V:inf", exact=False)
    lemma = singular(form)
    gender = next((gender for endings, gender in _NOUNS if lemma.endswith(endings)), None)
    if gender is None:
        return Reading(lemma, "X", exact=False)
    return Reading(lemma, f"N:{gender}{'s' if lemma == form else 'p'}", exact=False)


def singular(form: str) -> str:
    """The singular of an unknown word, as far as its ending tells: `"chándales"` is `"chándal"`."""
    if len(form) < _SHORTEST_PLURAL:
        return form
    return next((several.sub(one, form) for several, one in _PLURALS if several.search(form)), form)
