# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which signs show a number.

A number below a million is how many there are of a magnitude, then its operator CIEN or MIL, in falling
order: 352,000 is 3 100 5 2 1000. So Fuentes describes it for Catalan Sign Language (Sintagma 12, pages 19
to 35), and Fernández Viader and Fuentes (TISLR 9, 2008) find the same system in Spanish Sign Language
with other hands. A single hundred or thousand is the operator alone. Fuentes leaves CIEN out before tens
and units (8,756 is 8 MIL 7 5 6); here it stays, as in Spanish, so that no zero has to be made: 305 is 3
100 5. Tens and units have one sign where the table has it; else they are their digits side by side, the
tens first, as SignPuddle's entry "veintidós" writes 22 and as 20 to 50 themselves are made in DILSE: the
digit, then the ring that is 0.

What is no such number is read out digit by digit: longer ones (telephone numbers), and those with a zero in
front, which are codes.
"""

from __future__ import annotations

from collections.abc import Callable

#: Digits of the largest number that has a name: 999,999.
LONGEST = 6

_HUNDRED, _THOUSAND = 100, 1000


def number_glosses(digits: str, has: Callable[[str], bool]) -> tuple[str, ...]:
    """The signs of a number, in order.

    Args:
        digits: The number, 0 to 9 only.
        has: Whether a number has a sign of its own that may be used; not asked for single digits,
            which nothing could stand for.

    Returns:
        Glosses of number signs. The digits of the number if it is too long, begins with a zero, or an
        operator has no sign: half a number would be read as another one.
    """
    if len(digits) == 1 or has(digits):
        return (digits,)
    spelled = tuple(digits)
    if len(digits) > LONGEST or digits.startswith("0"):
        return spelled
    thousands, rest = divmod(int(digits), _THOUSAND)
    made: tuple[str, ...] = ()
    if thousands:
        made = (*(_below_thousand(thousands, has) if thousands > 1 else ()), str(_THOUSAND))
    made += _below_thousand(rest, has)
    operators = {str(_HUNDRED), str(_THOUSAND)} & set(made)
    return made if all(has(operator) for operator in operators) else spelled


def _below_thousand(value: int, has: Callable[[str], bool]) -> tuple[str, ...]:
    """The signs of a part below a thousand; none for 0."""
    if value == 0:
        return ()
    if has(str(value)):
        return (str(value),)
    hundreds, rest = divmod(value, _HUNDRED)
    made: tuple[str, ...] = ()
    if hundreds:
        made = (*((str(hundreds),) if hundreds > 1 else ()), str(_HUNDRED))
    if rest:
        made += (str(rest),) if has(str(rest)) else tuple(str(rest))
    return made
