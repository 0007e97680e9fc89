"""Clitic pronouns and their order; `morphology.enclitics` hangs them on a verb."""

from __future__ import annotations

from collections.abc import Sequence

#: Reflexive pronoun by person.
REFLEXIVES = {"1s": "me", "2s": "te", "3s": "se", "1p": "nos", "2p": "os", "3p": "se"}

_ORDER = {"se": 0, "te": 1, "os": 1, "me": 2, "nos": 2}
_LAST = 3
_THIRD_ACCUSATIVE = frozenset(("lo", "la", "los", "las"))


def in_order(clitics: Sequence[str]) -> tuple[str, ...]:
    """Clitics as they stand before or behind a verb: `("lo", "le")` is `("se", "lo")`."""
    ordered = tuple(sorted(clitics, key=lambda clitic: _ORDER.get(clitic, _LAST)))
    if len(ordered) > 1 and set(ordered) & _THIRD_ACCUSATIVE:
        changed = ["se" if clitic in ("le", "les") else clitic for clitic in ordered]
        return tuple(sorted(changed, key=lambda clitic: _ORDER.get(clitic, _LAST)))
    return ordered
