# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a Spanish word may be."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Reading:
    """One way to read a word.

    Attributes:
        lemma: Dictionary form in lower case with accents: "comer", "niño"; a name keeps its capital: "Ana"; a
            number is in digits: "7".
        tag: One of `tags.TAGS`.
        clitics: Pronouns that hang on a verb, as written: ("me", "lo") in "dímelo".
        exact: False if the word must be written with other accents to be this ("como" for "cómo"), or if the
            word is not known and this is a guess.
    """

    lemma: str
    tag: str
    clitics: tuple[str, ...] = ()
    exact: bool = True


def gloss_name(written: str) -> str:
    """A gloss as the look-up table names it: `"Por favor"` is `"POR_FAVOR"`."""
    return written.strip().upper().replace(" ", "_")
