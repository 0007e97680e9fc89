"""Texts of people as log lines show them."""

from __future__ import annotations

# A log line shows this much of a text [characters].
_LENGTH = 80


def quoted(text: str) -> str:
    """A text in quotes, with characters that could upset a terminal escaped."""
    return short(repr(text))


def short(text: str) -> str:
    """A text, or its beginning."""
    return text if len(text) <= _LENGTH else text[: _LENGTH - 1] + "…"
