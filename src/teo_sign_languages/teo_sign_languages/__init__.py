# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sign languages as data: what one is, and where its files are.

``load_language("ssp")`` is Spanish Sign Language; its ``text`` is the folder of what is known of Spanish.
"""

from teo_sign_languages.language import (
    DEFAULT_LANGUAGE,
    Language,
    available_languages,
    load_language,
    user_languages_directory,
)
from teo_sign_languages.language_file import (
    Alphabet,
    HeadGrammar,
    HeadMove,
    LanguageError,
    LetterClips,
    Numbers,
)

__all__ = [
    "DEFAULT_LANGUAGE",
    "Alphabet",
    "HeadGrammar",
    "HeadMove",
    "Language",
    "LanguageError",
    "LetterClips",
    "Numbers",
    "available_languages",
    "load_language",
    "user_languages_directory",
]
