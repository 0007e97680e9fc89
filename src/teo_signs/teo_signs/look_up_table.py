# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The look-up table: directories with one JSON file for each sign, read when a sign is first asked for.

Signs that a user makes go to a table of his own, which is searched before the one that comes with the
package: what is installed stays as it was, and an update takes nobody's signs away.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

from teo_common.package_files import package_path
from teo_signs.errors import LutError
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_file import read_sign, save_sign

__all__ = ["LANGUAGE", "Lut", "LutError", "Sign", "default_lut_directory", "save_sign", "user_lut_directory"]

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


def user_lut_directory() -> Path:
    """The user's own table, which need not be there: ``teo/lut`` of the data home (XDG base directories)."""
    base = os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share"
    return Path(base) / "teo" / "lut"


def held_entry(table: Path, gloss: str) -> Path | None:
    """The file that a gloss has in a table; None if it has none.

    Args:
        table: Directory of the entries. What the package's table holds counts as well for the user's own, as
            it is signed where that has nothing.
        gloss: Name of the sign.

    Raises:
        LutError: The directory cannot be looked at ("no_directory").
    """
    name = f"{gloss_key(gloss)}.json"
    directories = [table]
    if table == user_lut_directory():
        directories.append(default_lut_directory())
    for directory in directories:
        path = directory / name
        try:
            if path.exists():
                return path
        except OSError as error:
            raise _unlisted(directory, error) from error
    return None


class Lut(Mapping[str, Sign]):
    """Signs by gloss. Opening lists names only; an entry is read and checked when it is first asked for.

    A gloss is found whatever the Unicode form in which it is written, and with a space for "_". Signs are
    kept once read; what changed on disk since is seen with `refresh` or `reload`.
    """

    def __init__(self, directory: Path, *, own: Path | None = None) -> None:
        """List directories; see `open`.

        Args:
            directory: Of the entries; must be there.
            own: Of entries that take the place of those; may be missing.
        """
        self._directory, self._own = directory, own
        self._paths: dict[str, Path] = {}
        self._signs: dict[str, Sign] = {}
        self._modified: tuple[int, ...] = ()
        self.reload()

    @classmethod
    def open(cls, directory: str | os.PathLike[str] | None = None) -> Lut:
        """Open a table.

        Args:
            directory: Directory of the entries; None for the user's own table and, for what it does not hold,
                the table of the package.

        Raises:
            LutError: No such directory ("no_directory"), or two files of one gloss ("duplicate_gloss").
        """
        if directory is None:
            return cls(default_lut_directory(), own=user_lut_directory())
        return cls(Path(directory))

    @property
    def directories(self) -> tuple[Path, ...]:
        """Where the entries are, in the order in which a gloss is sought there."""
        if self._own is None or not self._own.is_dir():
            return (self._directory,)
        return (self._own, self._directory)

    @property
    def place(self) -> str:
        """Where the entries are, for messages; of several directories, how many signs each gives."""
        directories = self.directories
        if len(directories) == 1:
            return str(directories[0])
        found = Counter(path.parent for path in self._paths.values())
        return " and ".join(f"{directory} ({found[directory]})" for directory in directories)

    def reload(self) -> None:
        """List the directories again and forget what was read."""
        modified = self._stamps()
        paths: dict[str, Path] = {}
        for directory in reversed(self.directories):
            paths |= _listed(directory)
        self._paths, self._signs, self._modified = paths, {}, modified

    def refresh(self) -> str:
        """Reload the table if a sign was saved or removed since it was listed; else it costs a `stat` or two.

        Returns:
            Why the table could not be read, in which case it stays as it was; else empty.
        """
        try:
            if self._stamps() != self._modified:
                self.reload()
        except LutError as error:
            return str(error)
        return ""

    def _stamps(self) -> tuple[int, ...]:
        """When each directory was last changed [ns]."""
        return tuple(_stamp(directory) for directory in self.directories)

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
                f"expected a gloss that the table {self.place} holds ({len(self)} signs), got {gloss!r}",
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


def _stamp(directory: Path) -> int:
    try:
        return directory.stat().st_mtime_ns
    except OSError as error:
        raise _unlisted(directory, error) from error


def _listed(directory: Path) -> dict[str, Path]:
    """The files of a directory's signs by gloss."""
    paths: dict[str, Path] = {}
    try:
        names = sorted(entry.name for entry in os.scandir(directory))
    except OSError as error:
        raise _unlisted(directory, error) from error
    for name in names:
        # Names that begin with a dot are files on their way to being saved.
        if name.startswith(".") or not name.endswith(".json"):
            continue
        gloss = gloss_key(name.removesuffix(".json"))
        if gloss in paths:
            both = f"{paths[gloss].name!r} and {name!r}"
            message = f"{directory}: expected one file for {gloss!r}, got {both}"
            raise LutError("duplicate_gloss", message)
        paths[gloss] = directory / name
    return paths


def _unlisted(directory: Path, error: OSError) -> LutError:
    return LutError("no_directory", f"{directory}: expected a directory of signs, got: {error.strerror}")
