# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which words are people's names: a capital alone does not make one.

A capital says something only inside a sentence; at its beginning, behind a colon, an opening quote, a dash or
`¿`, and in a text that is all in capitals, the rules of writing explain it. There a word that Spanish has
besides (`Segura`, `Tranquilos`, `Rosa`) is that word, unless what stands beside it makes it a name.
"""

from __future__ import annotations

from collections.abc import Sequence

from teo_sign_translator.morphology import MAX_READINGS, Reading
from teo_sign_translator.text.rules import SpecialWords

#: Tags of people's names; names of places have signs, or are spelled like any other word.
PEOPLE = ("NAME", "NAME:m", "NAME:f")

_GIVEN = ("NAME:m", "NAME:f")


def is_persons_name(reading: Reading) -> bool:
    """Whether a reading is that of a person's name."""
    return reading.tag in PEOPLE


def name_readings(
    readings: Sequence[Reading], written: str, *, capital: bool, introduced: bool
) -> tuple[Reading, ...]:
    """Readings of a word inside a sentence: a name if it is introduced as one, or not known otherwise.

    Args:
        readings: Of the word in lower case.
        written: The word as typed.
        capital: Whether it has a capital that nothing else explains.
        introduced: See `introduces`.
    """
    names = tuple(filter(is_persons_name, readings))
    others = tuple(reading for reading in readings if not is_persons_name(reading))
    known = any(reading.exact for reading in others)
    if not capital:
        return tuple(readings) if introduced or not known else others
    if any(reading.tag.startswith("NAME") for reading in readings):
        return tuple(readings)
    guessed = Reading(written, "NAME", exact=False)
    if not known:
        return (guessed, *others)[:MAX_READINGS]
    # "Ana Cuesta": a word that everybody knows is a surname behind a name alone.
    return (*others[: MAX_READINGS - 1], guessed) if introduced else (*others, *names)


def introduces(readings: Sequence[Reading], words: SpecialWords) -> bool:
    """Whether a name may follow a word with these readings though it is a common word too."""
    return is_persons_name(readings[0]) or any(reading.lemma in words.introducing for reading in readings)


def opening_name(
    readings: Sequence[Reading], following: Sequence[Reading], words: SpecialWords
) -> tuple[Reading, ...]:
    """Readings of a capitalised word that begins a sentence: a given name first, if it is a subject.

    A common noun that is a subject has an article (`La rosa huele`); a name has none (`Rosa viene mañana`).

    Args:
        readings: Of the word.
        following: Of the word behind it; none at the end.
        words: Of the language.
    """
    given = tuple(reading for reading in readings if reading.tag in _GIVEN)
    says = (
        bool(following)
        and following[0].tag.startswith("V:")
        and following[0].tag.endswith(words.subject_tags)
    )
    others = tuple(reading for reading in readings if not is_persons_name(reading))
    if given and says:
        return (*given, *others)
    return others or tuple(readings)
