# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One gloss of a draft, and what words it says."""

from __future__ import annotations

from dataclasses import dataclass

from teo_sign_translator.morphology import Reading
from teo_sign_translator.pointer.vocabulary import copied_gloss

# Tags of verbs that have a person or an order.
FINITE = ("V:ind", "V:cond", "V:sub", "V:imp")


@dataclass(slots=True)
class Item:
    """One gloss of a draft with the words that it says.

    Attributes:
        gloss: As `OutputGloss` has it.
        places: Of the words, ascending.
        reading: Of the word that it is of; None for a set phrase.
    """

    gloss: str
    places: tuple[int, ...]
    reading: Reading | None = None

    def is_a(self, *tags: str) -> bool:
        """Whether the word has a tag that begins so."""
        return self.reading is not None and self.reading.tag.startswith(tags)


def item_of(place: int, reading: Reading) -> Item:
    """The item of one word: its dictionary form."""
    return Item(copied_gloss(reading), (place,), reading)
