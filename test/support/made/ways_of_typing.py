# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Ways in which people type one sentence."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable


def _without_accents(text: str) -> str:
    return "".join(c for c in unicodedata.normalize("NFD", text) if unicodedata.category(c) != "Mn")


def _without_marks(text: str) -> str:
    return re.sub(r"[¿?¡!,.…]", "", text)


WAYS_OF_TYPING: dict[str, Callable[[str], str]] = {
    "as published": lambda text: text,
    "without accents": _without_accents,
    "without marks": _without_marks,
    "without either, in lower case": lambda text: _without_marks(_without_accents(text)).lower(),
    "without opening marks": lambda text: re.sub("[¿¡]", "", text),
    "in capitals": str.upper,
    "decomposed": lambda text: unicodedata.normalize("NFD", text),
    "with repeated marks": lambda text: text.replace("?", "???").replace("!", "!!"),
    "with a full stop": lambda text: text if text[-1] in "?!…" else text + ".",
    "with blanks around": lambda text: f"  {text}\t\n",
    "with an emoji": lambda text: text + " 😀",
}
