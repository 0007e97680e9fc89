"""Numbers as Spanish words."""

from __future__ import annotations

from teo_sign_translator.tables import words_of

_UNITS = words_of(
    "cero uno dos tres cuatro cinco seis siete ocho nueve diez once doce trece catorce quince dieciséis "
    "diecisiete dieciocho diecinueve veinte veintiuno veintidós veintitrés veinticuatro veinticinco "
    "veintiséis veintisiete veintiocho veintinueve"
)
_TENS = words_of("treinta cuarenta cincuenta sesenta setenta ochenta noventa")
_HUNDREDS = words_of(
    "ciento doscientos trescientos cuatrocientos quinientos seiscientos setecientos ochocientos novecientos"
)

#: One more than the largest number that is written in words here.
LIMIT = 10_000


def number_words(value: int) -> str:
    """A number from 0 to 9999 in words, as counted: `31` is `"treinta y uno"`."""
    if value >= 1000:
        thousands, rest = divmod(value, 1000)
        words = "mil" if thousands == 1 else f"{number_words(thousands)} mil"
        return f"{words} {number_words(rest)}" if rest else words
    if value == 100:
        return "cien"
    if value > 100:
        hundreds, rest = divmod(value, 100)
        return f"{_HUNDREDS[hundreds - 1]} {number_words(rest)}" if rest else _HUNDREDS[hundreds - 1]
    if value < 30:
        return _UNITS[value]
    tens, units = divmod(value, 10)
    return f"{_TENS[tens - 3]} y {_UNITS[units]}" if units else _TENS[tens - 3]
