"""Numbers as signs."""

from __future__ import annotations

from teo_sign_translator.output.output_words import Draft
from teo_sign_translator.output.translation import Kind, Origin

# Between the whole and the decimal part of a number; "3,5" is read "tres coma cinco".
_DECIMAL_GLOSS = "COMA"


def number(value: str, typed: tuple[str, ...], confidence: float) -> list[Draft]:
    """A number as the signs of its digits; a decimal comma is a word between them.

    Hours and minutes of a time of day are two numbers; no minutes are not said.

    Args:
        value: Digits, with one `,` if it has decimals, or one `:` in a time of day.
        typed: Words of the text that it stands for.
        confidence: 0 to 1.
    """
    hours, _, minutes = value.partition(":")
    if minutes:
        said = [hours] if minutes == "00" else [hours, minutes]
        return [_digits(digits, typed, confidence) for digits in said]
    whole, _, decimals = value.partition(",")
    if not decimals:
        return [_digits(whole, typed, confidence)]
    comma = Draft(
        signs=(_DECIMAL_GLOSS,), kind=Kind.LEXICAL, confidence=confidence, words=typed, origin=Origin.NUMBER
    )
    return [_digits(whole, typed, confidence), comma, _digits(decimals, typed, confidence)]


def _digits(digits: str, typed: tuple[str, ...], confidence: float) -> Draft:
    return Draft(
        signs=tuple(digits), kind=Kind.NUMBER, confidence=confidence, words=typed, origin=Origin.NUMBER
    )
