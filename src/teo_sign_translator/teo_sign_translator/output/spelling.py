# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words as letters of a language's manual alphabet."""

from __future__ import annotations

from functools import cache

from teo_common.text_folding import strip_marks, without_accents
from teo_sign_languages import DEFAULT_LANGUAGE, Language, load_language

#: Signs of numbers, which may stand in a word ("UC3M").
DIGITS = frozenset("0123456789")


class Spelling:
    """Spells words; of a sign of several letters (CH) before its first letter alone."""

    def __init__(self, language: Language) -> None:
        """Take a language's alphabet."""
        self.name = language.names.short
        self.alphabet = frozenset(language.alphabet.letters)
        self._transcription = str.maketrans(language.alphabet.transcriptions)
        self._longest = max(map(len, self.alphabet))

    @classmethod
    @cache
    def load(cls, code: str = DEFAULT_LANGUAGE) -> Spelling:
        """That of a language by its code.

        Raises:
            LanguageError: "unknown_language" or "invalid_language".
        """
        return cls(load_language(code))

    def letters(self, word: str) -> tuple[str, ...]:
        """The signs that spell a word, e.g. `"Guillermo"` gives G U I LL E R M O in LSE.

        Characters that no sign exists for are left out; `unsignable` names them beforehand.
        """
        plain = self._plain(word)
        result: list[str] = []
        index = 0
        while index < len(plain):
            sizes = range(self._longest, 1, -1)
            size = next((size for size in sizes if plain[index : index + size] in self.alphabet), 1)
            if plain[index : index + size] in self.alphabet:
                result.append(plain[index : index + size])
            index += size
        return tuple(result)

    def unsignable(self, word: str) -> tuple[str, ...]:
        """Characters of a word that neither letters nor numbers can spell, in order, without repetition.

        An apostrophe is no letter, and is not missed.
        """
        known = self.alphabet | DIGITS | {"'"}
        return tuple(dict.fromkeys(c for c in word if any(p not in known for p in self._plain(c))))

    def _plain(self, word: str) -> str:
        """A word in capitals of the alphabet, without accents; what has no such form stays as it is."""
        plain = without_accents(word.upper()).translate(self._transcription)
        return "".join(c if c in self.alphabet else strip_marks(c).upper() for c in plain)
