# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which signs show a number.

A number below a million is how many there are of a magnitude, then the language's gloss for hundred or
thousand, in falling order. Tens and units have one sign where the table has it; else they are their digits
side by side, the tens first.

What is no such number is read out digit by digit: longer ones (telephone numbers), those with a zero in
front, which are codes, and those of a magnitude for which there is no gloss.
"""

from __future__ import annotations

from collections.abc import Callable

from teo_sign_languages import Numbers

#: Digits of the largest number that has a name: 999,999.
LONGEST = 6

_HUNDRED, _THOUSAND = 100, 1000


def number_glosses(digits: str, numbers: Numbers, has: Callable[[str], bool]) -> tuple[str, ...]:
    """The signs of a number, in order.

    Args:
        digits: The number, 0 to 9 only.
        numbers: How the language puts numbers together.
        has: Whether a gloss has a sign of its own that may be used; not asked for single digits, which
            nothing could stand for.

    Returns:
        Glosses of the signs. The digits of the number if it is too long, begins with a zero, or there is no
        sign for a hundred or a thousand in it: half a number would be read as another one.
    """
    if len(digits) == 1 or has(digits):
        return (digits,)
    spelled = tuple(digits)
    if len(digits) > LONGEST or digits.startswith("0"):
        return spelled
    thousands, rest = divmod(int(digits), _THOUSAND)
    made = (*_how_many(thousands, numbers, has), numbers.thousand) if thousands else ()
    made += _below_thousand(rest, numbers, has)
    operators = {numbers.hundred, numbers.thousand} & set(made)
    return made if all(gloss and has(gloss) for gloss in operators) else spelled


def _how_many(count: int, numbers: Numbers, has: Callable[[str], bool]) -> tuple[str, ...]:
    """The signs before a hundred or a thousand."""
    return _below_thousand(count, numbers, has) if count > 1 or numbers.one_before else ()


def _below_thousand(value: int, numbers: Numbers, has: Callable[[str], bool]) -> tuple[str, ...]:
    """The signs of a part below a thousand; none for 0."""
    if value == 0:
        return ()
    if has(str(value)):
        return (str(value),)
    hundreds, rest = divmod(value, _HUNDRED)
    if hundreds:
        return (*_how_many(hundreds, numbers, has), numbers.hundred, *_below_thousand(rest, numbers, has))
    return tuple(str(rest))
