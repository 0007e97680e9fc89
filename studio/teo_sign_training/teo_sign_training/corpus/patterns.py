# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The two linked right-hand sides of a rule, as written in the grammar files and as parsed.

Text: words and marks separated by spaces. `{X}` is what slot X says, `{V:S}` a verb agreeing with slot S,
`un~n` the paradigm word "un" agreeing with slot n.

Signs: `{X}` the glosses of slot X, `{n+V}` the same, which the head of slot V says too ("da miedo": MIEDO).
`GLOSS` is a gloss that no word says, `GLOSS=word+word` one that those words of the text side say (`word#2`
the second of them, `{X}` the head of a slot), `GLOSS=^` one that the verb's ending says, `GLOSS=@` one that a
clitic pronoun says.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from teo_sign_translator.errors import TranslationError

_SLOT = re.compile(r"\{(?P<slot>\w+)(?::(?P<agree>\w+))?\}")
_AGREEING = re.compile(r"(?P<word>\w+)~(?P<agree>\w+)")
_LITERAL = re.compile(r"'?\w+|[¿?¡!,.:]")
_GLOSS_SLOT = re.compile(r"\{(?P<slot>\w+)(?:\+(?P<also>\w+))?\}")
_GLOSS = re.compile(r"(?P<gloss>[A-ZÁÉÍÓÚÜÑ0-9_]+)(?:=(?P<sources>\S+))?")

#: Sources of a gloss that the verb's ending or a clitic says.
VERB, CLITIC = "^", "@"


@dataclass(frozen=True, slots=True)
class TextItem:
    """One item of the text side: a slot, an agreeing paradigm word or a literal.

    Attributes:
        slot: Name of the slot; empty for a word.
        word: The word or mark; empty for a slot.
        agree: Slot that it agrees with; empty if with none.
    """

    slot: str
    word: str
    agree: str


@dataclass(frozen=True, slots=True)
class GlossItem:
    """One item of the side of signs: a slot or a gloss.

    Attributes:
        slot: Name of the slot; else empty.
        also: Slot whose head says the glosses too; empty for none.
        gloss: The gloss; empty for a slot.
        sources: Words of the text side, `{slot}`s, `VERB` or `CLITIC`.
    """

    slot: str = ""
    also: str = ""
    gloss: str = ""
    sources: tuple[str, ...] = ()


def parse_text(text: str) -> tuple[TextItem, ...]:
    """Parse a text side.

    Raises:
        TranslationError: "invalid_grammar" naming the item.
    """
    items: list[TextItem] = []
    for written in text.split():
        if match := _SLOT.fullmatch(written):
            items.append(TextItem(match["slot"], "", match["agree"] or ""))
        elif match := _AGREEING.fullmatch(written):
            items.append(TextItem("", match["word"], match["agree"]))
        elif _LITERAL.fullmatch(written):
            items.append(TextItem("", written, ""))
        else:
            raise TranslationError(
                "invalid_grammar",
                f"expected a word, a mark, {{slot}}, {{verb:subject}} or word~slot, got '{written}'",
            )
    return tuple(items)


def parse_glosses(text: str) -> tuple[GlossItem, ...]:
    """Parse a side of signs.

    Raises:
        TranslationError: "invalid_grammar" naming the item.
    """
    items: list[GlossItem] = []
    for written in text.split():
        if match := _GLOSS_SLOT.fullmatch(written):
            items.append(GlossItem(match["slot"], match["also"] or ""))
        elif match := _GLOSS.fullmatch(written):
            sources = tuple(match["sources"].split("+")) if match["sources"] else ()
            items.append(GlossItem(gloss=match["gloss"], sources=sources))
        else:
            raise TranslationError(
                "invalid_grammar", f"expected GLOSS, GLOSS=word or {{slot}}, got '{written}'"
            )
    return tuple(items)
