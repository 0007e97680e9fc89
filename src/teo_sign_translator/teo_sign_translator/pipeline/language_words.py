# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words that translations are completed and inflected by: `pipeline.yaml` of a language's text folder."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

from teo_sign_translator.data_files import data_file
from teo_sign_translator.data_sections import read_sections

_FILE = "pipeline.yaml"


@dataclass(frozen=True)
class CompletenessWords:
    """What may go without a gloss though it is no function word; the section `completeness`.

    Attributes:
        goes: Verb that only says the future before an infinitive; empty for none.
        goes_to: Word between that verb and the infinitive.
    """

    goes: str
    goes_to: str


@dataclass(frozen=True)
class PersonWords:
    """Who acts on whom, for signs that agree; the section `persons`. Persons are 1, 2 and 3.

    Attributes:
        objects: Object pronouns with their person.
        things: Those of the third person that may be things.
        reflexive: The pronoun that a dative becomes beside one of those.
        subjects: Subject pronouns with their person.
        polite: Those of the addressee whose verb is of the third person.
        towards: Words before the person that something is done to.
        own_possessive: Possessive that names a third person.
        own_imperatives: Verbs whose imperative is no form of the third person.
        experiencer_verbs: Verbs whose object is who feels.
    """

    objects: dict[str, str]
    things: frozenset[str]
    reflexive: str
    subjects: dict[str, str]
    polite: frozenset[str]
    towards: frozenset[str]
    own_possessive: str
    own_imperatives: frozenset[str]
    experiencer_verbs: frozenset[str]


@dataclass(frozen=True)
class PipelineWords:
    """All of it.

    Attributes:
        completeness: What may go without a gloss.
        persons: Who acts on whom.
    """

    completeness: CompletenessWords
    persons: PersonWords

    @classmethod
    @cache
    def load(cls, folder: Path | None = None) -> PipelineWords:
        """Read the file of a language's text folder, once.

        Args:
            folder: By default that of the default language.

        Raises:
            TranslationError: "invalid_data" naming file and field.
        """
        sections = {"completeness": CompletenessWords, "persons": PersonWords}
        return cls(**read_sections((folder or data_file("")) / _FILE, sections))
