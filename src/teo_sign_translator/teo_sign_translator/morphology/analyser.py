"""Readings of words and forms of lemmas."""

from __future__ import annotations

import unicodedata

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology.reading import Reading


class Morphology:
    """The readings of Spanish words and the forms of Spanish lemmas."""

    @classmethod
    def load(cls) -> Morphology:
        """Read the package's tables."""
        return cls()

    def readings(self, word: str) -> tuple[Reading, ...]:
        """What a word may be, most likely first: at least one reading, at most four."""
        form = unicodedata.normalize("NFC", word).lower()
        if form.isdigit():
            return (Reading(form, "NUM"),)
        if not any(character.isalnum() for character in form):
            return (Reading(form, "MARK"),)
        return (Reading(form, "X", exact=False),)

    def inflect(self, lemma: str, tag: str) -> str:
        """The form of a lemma that a tag names.

        Raises:
            TranslationError: "no_form" if the lemma is unknown or has no such form.
        """
        raise TranslationError(
            "no_form", f"expected a known lemma and a form that it has, got {lemma!r} {tag}"
        )
