"""Numbers in digits and in words."""

from __future__ import annotations

import re
from collections.abc import Sequence

from teo_sign_translator.tables import words_of

_UNITS = words_of("cero uno dos tres cuatro cinco seis siete ocho nueve diez once doce trece catorce quince")
_TEENS = words_of(
    "dieciseis diecisiete dieciocho diecinueve veinte veintiuno veintidos veintitres veinticuatro"
)
_TWENTIES = words_of("veinticinco veintiseis veintisiete veintiocho veintinueve")
_TENS = words_of("treinta cuarenta cincuenta sesenta setenta ochenta noventa")
_HUNDREDS = words_of(
    "doscientos trescientos cuatrocientos quinientos seiscientos setecientos ochocientos novecientos"
)

_SMALL = {word: value for value, word in enumerate(_UNITS + _TEENS + _TWENTIES)} | {
    "veintiun": 21,
    "veintiuna": 21,
}
_TEN = {word: 10 * value for value, word in enumerate(_TENS, start=3)}
_HUNDRED = {word: 100 * value for value, word in enumerate(_HUNDREDS, start=2)}
_HUNDRED |= {word.replace("ientos", "ientas"): value for word, value in _HUNDRED.items()} | {
    "ciento": 100,
    "cien": 100,
}

_DIGITS = re.compile(r"\d+(?:[.,]\d+)*")
_THOUSANDS = re.compile(r"[1-9]\d{0,2}(?:\.\d{3})+(?:,\d+)?")


def read_number_words(words: Sequence[str]) -> tuple[int, int]:
    """Read the longest number below a million that the words begin with.

    Args:
        words: Folded words (lower case, no accents), e.g. `["treinta", "y", "cinco", "años"]`.

    Returns:
        Its value and how many words say it, here 35 and 3; `(0, 0)` if the words begin with no number.
        A lone "un" or "una" is an article, not a number.
    """
    value, used = _below_thousand(words)
    if list(words[used : used + 1]) == ["mil"] and (value > 1 or not used):
        below, more = _below_thousand(words[used + 1 :])
        # "mil cero" is two numbers, not one.
        return (value or 1) * 1000 + below, used + 1 + (more if below else 0)
    return value, used


def _below_thousand(words: Sequence[str]) -> tuple[int, int]:
    total = used = 0
    if words and words[0] in _HUNDRED:
        total, used = _HUNDRED[words[0]], 1
        if words[0] == "cien":
            return total, used
    rest = words[used:]
    if rest and rest[0] in _TEN:
        total, used = total + _TEN[rest[0]], used + 1
        if len(rest) > 2 and rest[1] == "y":
            unit = 1 if rest[2] in ("un", "una") else _SMALL.get(rest[2], 0)
            if 0 < unit < 10:
                return total + unit, used + 2
    elif rest and rest[0] in _SMALL and not (used and rest[0] == "cero"):
        total, used = total + _SMALL[rest[0]], used + 1
    return total, used


def match_digits(text: str, start: int) -> list[tuple[int, int, str]]:
    """Read a number in digits at a place of a text.

    Spanish writes thousands with points and decimals with a comma; a single point is taken for a decimal one
    too. Anything else (`12.10.2024`) is several numbers.

    Returns:
        For each number its start, end and value: digits, with one `,` if it has decimals. Empty if no digit
        is there.
    """
    match = _DIGITS.match(text, start)
    if match is None:
        return []
    found = match.group()
    if _THOUSANDS.fullmatch(found):
        return [(match.start(), match.end(), found.replace(".", ""))]
    parts = list(re.finditer(r"\d+", found))
    if len(parts) == 2:
        return [(match.start(), match.end(), found.replace(".", ","))]
    return [(start + part.start(), start + part.end(), part.group()) for part in parts]
