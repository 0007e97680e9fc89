# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which topics are recorded, played or converted."""

from __future__ import annotations

import re
from dataclasses import dataclass


def is_hidden(name: str) -> bool:
    """Tell whether a topic, service or node name is hidden: one of its parts begins with an underscore."""
    return any(part.startswith("_") for part in name.split("/") if part)


@dataclass(frozen=True)
class TopicSelection:
    """Decides by name and type whether a topic is taken.

    Args:
        everything: All topics, hidden ones apart.
        names: Full names that are taken, hidden or not.
        types: Types whose topics are taken.
        pattern: Topics whose name contains a match are taken.
        excluded_names: Full names that are not taken, whatever else says so.
        excluded_types: Types whose topics are not.
        excluded_pattern: Topics whose name contains a match are not.
        include_hidden: Hidden topics count as others do.
    """

    everything: bool = False
    names: frozenset[str] = frozenset()
    types: frozenset[str] = frozenset()
    pattern: re.Pattern[str] | None = None
    excluded_names: frozenset[str] = frozenset()
    excluded_types: frozenset[str] = frozenset()
    excluded_pattern: re.Pattern[str] | None = None
    include_hidden: bool = False

    def accepts(self, name: str, type_name: str) -> bool:
        """Tell whether a topic is taken."""
        if name in self.excluded_names or type_name in self.excluded_types:
            return False
        if self.excluded_pattern is not None and self.excluded_pattern.search(name):
            return False
        if name in self.names:
            return True
        if is_hidden(name) and not self.include_hidden:
            return False
        if self.everything or type_name in self.types:
            return True
        return self.pattern is not None and self.pattern.search(name) is not None

    @property
    def only_names(self) -> bool:
        """True if all that can be taken is named, so that looking for more may end once it is found."""
        return not self.everything and not self.types and self.pattern is None
