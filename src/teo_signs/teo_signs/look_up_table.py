# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The look-up table: a directory with one JSON file for each sign, read when a sign is first asked for."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from teo_common.package_files import package_path
from teo_signs.errors import LutError
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_file import read_sign, save_sign

__all__ = ["LANGUAGE", "Lut", "LutError", "Sign", "default_lut_directory", "save_sign"]

LANGUAGE = "lse"


def default_lut_directory() -> Path:
    """The table of Spanish Sign Language that comes with the package.

    Raises:
        LutError: Neither the installed package nor the source tree holds it ("no_directory").
    """
    try:
        return package_path("teo_signs", f"lut/{LANGUAGE}")
    except FileNotFoundError as error:
        raise LutError("no_directory", str(error)) from error


class Lut(Mapping[str, Sign]):
    """Signs by gloss. Opening lists names only; an entry is read and checked when it is first asked for.

    A gloss is found whatever the Unicode form in which it is written, and with a space for "_". Signs are
    kept once read; what changed on disk since is seen with `refresh` or `reload`.
    """

    def __init__(self, directory: Path) -> None:
        """List a directory; see `open`."""
        self._directory = directory
        self._paths: dict[str, Path] = {}
        self._signs: dict[str, Sign] = {}
        self._modified = 0  # of the directory, when it was listed [ns]
        self.reload()

    @classmethod
    def open(cls, directory: str | os.PathLike[str] | None = None) -> Lut:
        """Open a table.

        Args:
            directory: Directory of the entries; None for the table of the package.

        Raises:
            LutError: No such directory ("no_directory"), or two files of one gloss ("duplicate_gloss").
        """
        return cls(default_lut_directory() if directory is None else Path(directory))

    @property
    def directory(self) -> Path:
        """Where the entries are."""
        return self._directory

    def reload(self) -> None:
        """List the directory again and forget what was read."""
        paths: dict[str, Path] = {}
        try:
            modified = self._directory.stat().st_mtime_ns
            entries = sorted(entry.name for entry in os.scandir(self._directory))
        except OSError as error:
            raise LutError(
                "no_directory", f"{self._directory}: expected a directory of signs, got: {error.strerror}"
            ) from error
        for name in entries:
            # Names that begin with a dot are files on their way to being saved.
            if name.startswith(".") or not name.endswith(".json"):
                continue
            gloss = gloss_key(name.removesuffix(".json"))
            if gloss in paths:
                both = f"{paths[gloss].name!r} and {name!r}"
                message = f"{self._directory}: expected one file for {gloss!r}, got {both}"
                raise LutError("duplicate_gloss", message)
            paths[gloss] = self._directory / name
        self._paths, self._signs, self._modified = paths, {}, modified

    def refresh(self) -> str:
        """Reload the table if a sign was saved or removed since it was listed; else it costs one `stat`.

        Returns:
            Why the table could not be read, in which case it stays as it was; else empty.
        """
        try:
            if self._directory.stat().st_mtime_ns != self._modified:
                self.reload()
        except OSError as error:
            return f"{self._directory}: expected a directory of signs, got: {error.strerror}"
        except LutError as error:
            return str(error)
        return ""

    def glosses(self) -> tuple[str, ...]:
        """Every gloss of the table, sorted."""
        return tuple(sorted(self._paths))

    def path(self, gloss: str) -> Path:
        """The file of a sign.

        Raises:
            LutError: The table does not hold it ("unknown_sign").
        """
        try:
            return self._paths[gloss_key(gloss)]
        except KeyError:
            raise LutError(
                "unknown_sign",
                f"expected a gloss that the table {self._directory} holds ({len(self)} signs), got {gloss!r}",
            ) from None

    def __getitem__(self, gloss: str) -> Sign:
        """Look a sign up.

        Raises:
            LutError: The table does not hold it ("unknown_sign"), or its entry is not a good one.
        """
        key = gloss_key(gloss)
        sign = self._signs.get(key)
        if sign is None:
            sign = self._signs[key] = read_sign(self.path(gloss))
        return sign

    def __contains__(self, gloss: object) -> bool:
        """Whether the table holds a gloss; nothing is read."""
        return isinstance(gloss, str) and gloss_key(gloss) in self._paths

    def __iter__(self) -> Iterator[str]:
        """Glosses, sorted."""
        return iter(self.glosses())

    def __len__(self) -> int:
        """How many signs the table lists."""
        return len(self._paths)
