"""Features of phrases: how a rule looks them up, and when a rule may be taken."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from teo_sign_translator.corpus.grammar import Rule
from teo_sign_translator.corpus.tokens import Phrase


def looked_up(value: str, features: Mapping[str, str], slots: Mapping[str, Phrase]) -> str:
    """A value as written, or the feature it names: `$V.object` of slot V, `$pol` handed down; "" for none."""
    if not value.startswith("$"):
        return value
    name, dot, key = value[1:].partition(".")
    return slots[name].features.get(key, "") if dot else features.get(name, "")


def fits(rule: Rule, features: Mapping[str, str]) -> bool:
    """Whether the features handed down are what the rule wants."""
    return all(allows(allowed, features.get(key, "-").split(",")) for key, allowed in rule.when)


def allows(allowed: Sequence[str], given: Sequence[str]) -> bool:
    """Whether one of the values is allowed; where values are forbidden (`!neg`), whether none is given."""
    forbidden = [value[1:] for value in allowed if value.startswith("!")]
    if forbidden:
        return not any(value in forbidden for value in given)
    return any(value in allowed for value in given)
