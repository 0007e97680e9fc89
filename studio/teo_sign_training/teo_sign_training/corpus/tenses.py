# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which tenses and modals a verb may be said in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from teo_sign_training.corpus.grammar import Shape


@dataclass
class Tenses:
    """Finds the shapes of a grammar that suit a place.

    Attributes:
        shapes: All of them.
        lists: Names of several shapes; `plans` are those of the present that speak of what is to come
            ("mañana voy").
    """

    shapes: Sequence[Shape]
    lists: Mapping[str, tuple[str, ...]]
    _found: dict[tuple[str, ...], tuple[Shape, ...]] = field(default_factory=dict)

    def fitting(self, mood: str, says: str, kind: str, only: str) -> tuple[Shape, ...]:
        """The shapes that suit a place.

        Args:
            mood: Of the clause.
            says: Time that a time word says; empty or "any" for none.
            kind: "event" or "state".
            only: Shapes or lists of them, separated by commas; groups joined by `&` must all allow a shape.
        """
        key = (mood, says, kind, only)
        if key not in self._found:
            allowed = [
                {name for each in part.split(",") for name in self.lists.get(each, (each,))}
                for part in only.split("&")
                if part
            ]
            self._found[key] = tuple(
                shape
                for shape in self.shapes
                if shape.mood == mood
                and all(shape.name in names for names in allowed)
                and (shape.kind != "event" or kind == "event")
                and _time_fits(says, shape, kind, self.lists.get("plans", ()))
            )
        return self._found[key]


def _time_fits(says: str, shape: Shape, kind: str, plans: Sequence[str]) -> bool:
    """Whether a tense goes with a time word."""
    if says in ("", "any"):
        return True
    if says == "past":
        return shape.time == "past" and shape.dated
    if says == "future":
        return shape.time == "future" or (shape.time == "present" and shape.name in plans and kind == "event")
    return shape.time == says
