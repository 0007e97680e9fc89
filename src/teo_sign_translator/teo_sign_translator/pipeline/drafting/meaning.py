# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which of its readings a word has in its clause."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from teo_sign_translator.morphology import Reading
from teo_sign_translator.pipeline.drafting.item import FINITE
from teo_sign_translator.text.source_words import SourceWord

# Tags of words behind which a verb comes, if the word can be one.
_BEFORE_VERBS = ("PRON:obj", "PRON:refl", "PRON:1", "PRON:2", "ADV:neg")


def meant_readings(words: Sequence[SourceWord], places: Sequence[int], *, asks: bool) -> dict[int, Reading]:
    """The likeliest reading of each word, by the word before it.

    Behind an article, a possessive or a preposition stands no finite verb; behind a clitic, a subject pronoun
    or "no" a verb does, if it can be one; a question word without its accent is one at the beginning of a
    question.
    """
    result: dict[int, Reading] = {}
    for index, place in enumerate(places):
        word = words[place]
        before = result[places[index - 1]] if index else None
        choices: Sequence[Reading] = word.readings
        if before is not None and before.tag.startswith(("DET", "PREP")):
            choices = [each for each in choices if not each.tag.startswith(FINITE)] or choices
        elif before is not None and before.tag.startswith(_BEFORE_VERBS):
            behind = words[places[index + 1]].readings[0].tag if index + 1 < len(places) else ""
            if not (word.form == "se" and behind.startswith(FINITE)):  # "no se mueva": no saber
                choices = [each for each in choices if each.tag.startswith("V:")] or choices
        if before is not None and before.lemma == "haber":
            choices = [each for each in choices if each.tag.startswith("V:part")] or choices
        if asks and (index == 0 or (index == 1 and before is not None and before.tag == "PREP")):
            choices = [each for each in choices if each.tag.startswith("WH")] or choices
        reading = choices[0]
        if reading.tag.startswith("DET:def") and index + 1 < len(places):  # "la veo": no article
            following = words[places[index + 1]].readings[0]
            clitic = next((each for each in word.readings if each.tag.startswith("PRON:obj")), None)
            if clitic is not None and following.tag.startswith(FINITE):
                reading = clitic
        result[place] = reading
    if not any(reading.tag.startswith("V:") for reading in result.values()):
        result |= _verb_after_all(words, places, result)
    return result


def _verb_after_all(
    words: Sequence[SourceWord], places: Sequence[int], meant: Mapping[int, Reading]
) -> dict[int, Reading]:
    """The verb of a clause that has none, if one of its nouns may be one: "baja la basura".

    An object with its determiner or "a" stands behind it, and neither a determiner nor a preposition before.
    """
    for index, place in enumerate(places[:-1]):
        behind = words[places[index + 1]]
        before = meant[places[index - 1]] if index else None
        takes = meant[places[index + 1]].tag.startswith(("DET", "NUM")) or behind.form == "a"
        if not takes or (before is not None and before.tag.startswith(("DET", "PREP", "A:"))):
            continue
        verbs = (each for each in words[place].readings if each.exact and each.tag.startswith(FINITE))
        if meant[place].tag.startswith(("N:", "A:")) and (verb := next(verbs, None)):
            return {place: verb}
    return {}
