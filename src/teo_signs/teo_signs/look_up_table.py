# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The look-up table: directories with one JSON file for each sign, read when a sign is first asked for.

Signs that a user makes go to a table of his own, which is searched before the one that comes with the
package: what is installed stays as it was, and an update takes nobody's signs away.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from teo_sign_languages import DEFAULT_LANGUAGE, Language, LanguageError, load_language
from teo_signs.errors import LutError
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_file import read_sign, save_sign
from teo_signs.sign_schema import DEFAULT_ROBOT

__all__ = ["Lut", "LutError", "Sign", "default_lut_directory", "save_sign", "user_lut_directory"]


def default_lut_directory(language: str = DEFAULT_LANGUAGE, robot: str = DEFAULT_ROBOT) -> Path:
    """The table of a language that comes with it.

    Args:
        language: Its code.
        robot: Name of the robot.

    Raises:
        LutError: No such language, or a broken one ("unknown_language", "invalid_language"), or no table of
            it for the robot ("no_table").
    """
    found = _language(language)
    table = found.table(robot)
    if not table.is_dir():
        there = ", ".join(found.robots) or "none"
        raise LutError(
            "no_table",
            f"expected a robot for which {found.names.en} ({found.code}) has a table ({there}), got {robot!r}"
            f"; `ros2 run teo_lut_executor lut retarget --language {found.code} --robot {robot}` makes one",
        )
    return table


def user_lut_directory(language: str = DEFAULT_LANGUAGE, robot: str = DEFAULT_ROBOT) -> Path:
    """The user's own table of a language, which need not be there, in the data home (XDG base directories).

    That of the default language and robot is ``teo/lut``, where it was when there were no others; that of
    others ``teo/lut/<language>/<robot>``.
    """
    base = os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share"
    own = Path(base) / "teo" / "lut"
    code = _language(language).code
    return own if (code, robot) == (DEFAULT_LANGUAGE, DEFAULT_ROBOT) else own / code / robot


def holding_tables(
    table: Path, *, language: str = DEFAULT_LANGUAGE, robot: str = DEFAULT_ROBOT
) -> tuple[Path, ...]:
    """The directories whose entries a table holds: it and, beneath the user's own, the package's.

    Args:
        table: Directory of the entries.
        language: Code of the language whose table it is.
        robot: Name of the robot whose table it is.

    Raises:
        LutError: "unknown_language", "invalid_language".
    """
    known = _language(language)
    beneath = table == user_lut_directory(language, robot) and robot in known.robots
    return (table, known.table(robot)) if beneath else (table,)


def held_entry(tables: Iterable[Path], gloss: str) -> Path | None:
    """The file that a gloss has in tables; None if it has none.

    Args:
        tables: Directories of entries, as of `holding_tables`.
        gloss: Name of the sign.

    Raises:
        LutError: A directory cannot be looked at ("no_directory").
    """
    name = f"{gloss_key(gloss)}.json"
    for directory in tables:
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
    kept once read; what changed on disk since is seen with `refresh`.
    """

    def __init__(self, directory: Path, language: Language, robot: str, *, own: Path | None = None) -> None:
        """List directories; see `open`.

        Args:
            directory: Of the entries; must be there.
            language: That all entries must be of.
            robot: That all entries must be for.
            own: Of entries that take the place of those; may be missing.
        """
        self._directory, self._own = directory, own
        self._language, self._robot = language, robot
        self._paths: dict[str, Path] = {}
        self._signs: dict[str, Sign] = {}
        self._modified: tuple[int, ...] = ()
        self._reload()

    @classmethod
    def open(
        cls,
        directory: str | os.PathLike[str] | None = None,
        *,
        language: str = DEFAULT_LANGUAGE,
        robot: str = DEFAULT_ROBOT,
    ) -> Lut:
        """Open a table.

        Args:
            directory: Directory of the entries; None for the user's own table and, for what it does not hold,
                the one that comes with the language.
            language: Code of the language whose signs are wanted.
            robot: Name of the robot whose motions are wanted.

        Raises:
            LutError: No such language ("unknown_language", "invalid_language"), table ("no_table") or
                directory ("no_directory"), two files of one gloss ("duplicate_gloss"), or a table of
                another language or robot ("other_language", "other_robot").
        """
        if directory is None:
            known, own = _language(language), user_lut_directory(language, robot)
            if own.is_dir() and not known.table(robot).is_dir():
                return cls(own, known, robot)  # a robot of one's own
            return cls(default_lut_directory(language, robot), known, robot, own=own)
        lut = cls(Path(directory), _language(language), robot)
        lut._refuse_another()
        return lut

    @property
    def language(self) -> Language:
        """The language of the signs."""
        return self._language

    @property
    def robot(self) -> str:
        """Name of the robot whose joints the signs move."""
        return self._robot

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

    def _reload(self) -> None:
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
                self._reload()
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
            LutError: The table does not hold it ("unknown_sign"), or its entry is not a good one, or of
                another language or robot ("other_language", "other_robot").
        """
        key = gloss_key(gloss)
        sign = self._signs.get(key)
        if sign is None:
            sign = read_sign(self.path(gloss))
            _refuse_another(sign, self.path(gloss), self._language, self._robot)
            self._signs[key] = sign
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

    def _refuse_another(self) -> None:
        """Refuse a table of another language or robot by its first entry."""
        for gloss in self.glosses()[:1]:
            try:
                self[gloss]
            except LutError as error:
                if error.code in ("other_language", "other_robot"):  # a bad entry is named when asked for
                    raise


def _language(code: str) -> Language:
    try:
        return load_language(code)
    except LanguageError as error:
        raise LutError(error.code, str(error)) from error


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


def _refuse_another(sign: Sign, entry: Path, language: Language, robot: str) -> None:
    """Refuse an entry, which its file names, that is not of the language or for the robot in use."""
    code = language.code
    if sign.language not in (code, *language.formerly):
        raise LutError(
            "other_language",
            f"{entry}: language: expected {code}, the language in use, got {sign.language}; use this "
            f"table with language {sign.language} (`--language {sign.language}`), or a table of {code}: "
            "no command turns signs of one language into another's",
        )
    if sign.robot != robot:
        raise LutError(
            "other_robot",
            f"{entry}: robot: expected {robot}, the robot in use, got {sign.robot}; use this table "
            f"with robot {sign.robot} (`--robot {sign.robot}`), or make one for {robot}: `ros2 run "
            f"teo_lut_executor lut retarget --language {code} --robot {robot}`",
        )
