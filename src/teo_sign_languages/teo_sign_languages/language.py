# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign language and its files, looked for among the user's own languages, then among those that ship."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

import msgspec

from teo_common.installed_packages import package_path
from teo_sign_languages.language_file import FILE, LanguageError, LanguageFile, read_language_file

#: The language that is signed where none is named: Spanish Sign Language, the project's first.
DEFAULT_LANGUAGE = "ssp"


class Language(LanguageFile, frozen=True, kw_only=True):
    """A sign language: what its file says, and where the rest of it is.

    Attributes:
        directory: Its folder.
    """

    directory: Path

    @property
    def text(self) -> Path:
        """Folder of the text side: lexicon, morphology, grammar, synonyms."""
        return self.directory / "text"

    @property
    def models(self) -> Path:
        """Folder of the models that translate into the language, with their cards."""
        return self.directory / "models"

    @property
    def scores(self) -> Path:
        """Folder of the signs in written form."""
        return self.directory / "scores"

    @property
    def robots(self) -> tuple[str, ...]:
        """Names of the robots that it has a table for, sorted."""
        return tuple(sorted(table.name for table in self.directory.glob("tables/*/") if table.is_dir()))

    def table(self, robot: str) -> Path:
        """Folder of the language's signs as motions of a robot; it need not be there."""
        return self.directory / "tables" / robot


def user_languages_directory() -> Path:
    """Folder of the user's own languages, which need not be there (XDG base directories)."""
    base = os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share"
    return Path(base) / "teo" / "languages"


def available_languages() -> tuple[str, ...]:
    """Codes of the languages that are there, sorted."""
    return tuple(sorted(_folders()))


def load_language(code: str) -> Language:
    """Load a language.

    Args:
        code: ISO 639-3 code of the sign language, or a name that it had formerly.

    Raises:
        LanguageError: "unknown_language" or "invalid_language".
    """
    folders = _folders()
    if code in folders:
        return _read(folders[code])
    for folder in folders.values():
        with contextlib.suppress(LanguageError):  # that another language is broken is no matter here
            language = _read(folder)
            if code in language.formerly:
                return language
    known = ", ".join(sorted(folders)) or "none"
    raise LanguageError(
        "unknown_language",
        f"expected a language that is there ({known}), got {code!r}; a language of your own is a folder "
        f"{user_languages_directory() / '<code>'} with a {FILE}",
    )


def _folders() -> dict[str, Path]:
    """The folders of all languages by code; the user's own take the place of those that ship."""
    return {
        file.parent.name: file.parent
        for place in (package_path("teo_sign_languages", "languages"), user_languages_directory())
        for file in place.glob(f"*/{FILE}")
    }


def _read(folder: Path) -> Language:
    file = folder / FILE
    read = read_language_file(file)
    if read.code != folder.name:
        raise LanguageError(
            "invalid_language",
            f"{file}, field code: expected the folder's name {folder.name!r}, got {read.code!r}",
        )
    return Language(directory=folder, **msgspec.structs.asdict(read))
