# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What may be signed in place of a gloss that has no sign, and the lists that say it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from pathlib import Path

from teo_sign_translator.data_files import data_file, invalid_line, read_lines, read_rows
from teo_sign_translator.errors import TranslationError

#: What a look-up table can name: Spanish letters, `_` for spaces, as long as a message holds.
SIGN_NAME = re.compile(r"[A-ZÁÉÍÓÚÜÑ_]{1,64}")


class Substitutes(IntEnum):
    """How far from a gloss without a sign what is signed may be; each allows those before it too."""

    #: The sign of the gloss or of its dictionary form, else letters.
    NONE = 0
    #: The same sign under another name.
    SYNONYM = 1
    #: A general sign and one that narrows it.
    PARAPHRASE = 2

    @classmethod
    def named(cls, name: str) -> Substitutes:
        """The value of a name in lower case.

        Raises:
            TranslationError: "unknown_substitutes".
        """
        try:
            return cls[name.upper()]
        except KeyError:
            known = ", ".join(each.name.lower() for each in cls)
            raise TranslationError("unknown_substitutes", f"expected one of {known}, got {name!r}") from None


@dataclass(frozen=True, slots=True)
class SubstituteLists:
    """The lists of the package's data.

    Attributes:
        synonyms: For each gloss others that the same sign is known by, in the order of the lists.
        paraphrases: For each gloss the rows of glosses that say it together, the best first.
    """

    synonyms: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    paraphrases: Mapping[str, tuple[tuple[str, ...], ...]] = field(default_factory=dict)

    @classmethod
    def load(cls, folder: Path | None = None) -> SubstituteLists:
        """Read `synonyms.tsv`, `word_families.tsv` and `paraphrases.tsv`.

        Args:
            folder: The language's text folder; by default that of the default language.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        folder = folder or data_file("")
        own = read_synonyms(folder / "synonyms.tsv")
        families = read_synonyms(folder / "word_families.tsv")
        synonyms: dict[str, tuple[str, ...]] = {}
        for gloss in {*own, *families}:
            near = [*own.get(gloss, ()), *families.get(gloss, ())]
            far = [other for each in near for other in (*own.get(each, ()), *families.get(each, ()))]
            synonyms[gloss] = tuple(other for other in dict.fromkeys([*near, *far]) if other != gloss)
        return cls(synonyms, read_paraphrases(folder / "paraphrases.tsv"))


def read_synonyms(path: Path) -> dict[str, tuple[str, ...]]:
    """For each gloss the others that mean the same, in the order of the file, which has a line a group.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    synonyms: dict[str, tuple[str, ...]] = {}
    for line_number, line in read_lines(path):
        group = [gloss.strip() for gloss in line.split(",")]
        valid = all(SIGN_NAME.fullmatch(gloss) and gloss not in synonyms for gloss in group)
        if len(group) < 2 or len({*group}) < len(group) or not valid:
            raise invalid_line(path, line_number, "two or more glosses, each listed once", f"'{line}'")
        for gloss in group:
            synonyms[gloss] = tuple(other for other in group if other != gloss)
    return synonyms


def read_paraphrases(path: Path) -> dict[str, tuple[tuple[str, ...], ...]]:
    """For each gloss the rows of glosses that say it together, in the order of the file.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    found: dict[str, tuple[tuple[str, ...], ...]] = {}
    for number, (gloss, said) in read_rows(path, columns=2):
        parts = tuple(said.split())
        known = found.get(gloss, ())
        if not all(map(SIGN_NAME.fullmatch, (gloss, *parts))) or gloss in parts or parts in known:
            expected = "a gloss and others, separated by blanks, that say it, each row once"
            raise invalid_line(path, number, expected, f"'{gloss}', '{said}'")
        found[gloss] = (*known, parts)
    return found
