"""Reading the package's small text files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from teo_sign_translator.errors import TranslationError


def read_rows(path: Path, columns: int) -> Iterator[tuple[int, list[str]]]:
    """Yield line number (from 1) and columns of a tab-separated UTF-8 file; blank and `#` lines are skipped.

    Raises:
        TranslationError: "invalid_data" if the file cannot be read or a line has another number of columns.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise TranslationError("invalid_data", f"{path}: expected a readable UTF-8 file: {error}") from error
    for number, line in enumerate(lines, start=1):
        if not line.strip() or line.startswith("#"):
            continue
        fields = line.split("\t")
        if len(fields) != columns or not all(field.strip() for field in fields):
            raise TranslationError(
                "invalid_data",
                f"{path}, line {number}: expected {columns} columns separated by tabs, none empty, got "
                f"{len(fields)}",
            )
        yield number, [field.strip() for field in fields]


def words_of(text: str) -> tuple[str, ...]:
    """The words of a list that is written as one string."""
    return tuple(text.split())
