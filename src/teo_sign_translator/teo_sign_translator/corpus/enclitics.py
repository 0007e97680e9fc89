"""Clitic pronouns: their order, and how they hang on a verb."""

from __future__ import annotations

import re
from collections.abc import Sequence

from teo_sign_translator.morphology.accents import syllables, unaccented

#: Reflexive pronoun by person.
REFLEXIVES = {"1s": "me", "2s": "te", "3s": "se", "1p": "nos", "2p": "os", "3p": "se"}

_ORDER = {"se": 0, "te": 1, "os": 1, "me": 2, "nos": 2}
_LAST = 3
_THIRD_ACCUSATIVE = frozenset(("lo", "la", "los", "las"))
_ACUTE = dict(zip("aeiou", "áéíóú", strict=True))


def in_order(clitics: Sequence[str]) -> tuple[str, ...]:
    """Clitics as they stand before or behind a verb: `("lo", "le")` is `("se", "lo")`."""
    ordered = tuple(sorted(clitics, key=lambda clitic: _ORDER.get(clitic, _LAST)))
    if len(ordered) > 1 and set(ordered) & _THIRD_ACCUSATIVE:
        changed = ["se" if clitic in ("le", "les") else clitic for clitic in ordered]
        return tuple(sorted(changed, key=lambda clitic: _ORDER.get(clitic, _LAST)))
    return ordered


def attach(form: str, clitics: Sequence[str]) -> str:
    """Verb form and clitics in one word: `"da"` with me, lo is `"dámelo"`."""
    if not clitics:
        return form
    stressed, place = _stress(form)
    if clitics[0] == "os" and form.endswith("d") and form != "id":
        if form.endswith("id"):  # vestid, vestíos
            return form[:-2] + "íos"
        form, stressed = form[:-1], stressed[:-1]
    if clitics[0] in ("nos", "se") and form.endswith("mos"):
        form, stressed = form[:-1], stressed[:-1]
    behind = len(syllables(form[place + 1 :])) + sum(len(syllables(clitic)) for clitic in clitics)
    hiatus = form[place] in "íú"
    plain = form if hiatus else stressed
    if behind >= 2 and not hiatus:
        plain = plain[:place] + _ACUTE[plain[place]] + plain[place + 1 :]
    return plain + "".join(clitics)


def _stress(form: str) -> tuple[str, int]:
    """The form without accent, and where its stressed vowel is."""
    for place, letter in enumerate(form):
        if letter in "áéíóú":
            return unaccented(form), place
    nuclei = list(re.finditer(r"(?<![qg])[iuü]?[aeo][iuy]?(?![aeo])|[iuü]?[aeo]|[iuü]+", form))
    last = form[-1] in "aeiouns" and len(nuclei) > 1
    start, end = nuclei[-2 if last else -1].span()
    strong = next((place for place in range(start, end) if form[place] in "aeo"), end - 1)
    return form, strong
