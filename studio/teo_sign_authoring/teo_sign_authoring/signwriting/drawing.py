# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs of a dictionary as drawings: one SVG with a `symbol` for each gloss, which needs no font to be shown.

Outlines come from the fonts of the package `signwriting` (Sutton SignWriting, SIL Open Font License 1.1).
"""

from __future__ import annotations

import json
import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import quoteattr

import signwriting
from fontTools.pens.svgPathPen import SVGPathPen  # type: ignore[import-untyped]  # ships no types
from fontTools.ttLib import TTFont  # type: ignore[import-untyped]  # ships no types
from signwriting.formats.fsw_to_swu import key2id, symbol_fill, symbol_line

from teo_common.atomic_files import write_atomically
from teo_sign_authoring.signwriting.dictionary_file import DictionaryEntry
from teo_sign_authoring.signwriting.written_sign import read_fsw

# A source that is an entry of the dictionary itself, as `lut import --signwriting` and the shipped scores
# name it: 'SignPuddle LSE dictionary (puddle 55), entry "abrir 1"'. What was only derived from entries names
# them otherwise: their drawings show other signs.
_NAMED = re.compile(r'SignPuddle\b[^"]*, entry "([^"]+)"')
# Units of the fonts' outlines for each unit of FSW: an em of 300 is written 30 high.
_UNITS = 10
_MARGIN = 1  # [FSW] Outlines reach a fraction of a unit over the symbols' whole sizes.
_HEAD = """<!-- SPDX-FileCopyrightText: 1974-2014 Center for Sutton Movement Writing, Inc. -->
<!-- SPDX-License-Identifier: OFL-1.1 -->
<!-- Made by draw_signwriting. -->
"""


@dataclass(frozen=True, kw_only=True)
class WrittenEntry:
    """An entry of the look-up table, and the dictionary's term and Formal SignWriting for it."""

    gloss: str
    term: str
    fsw: str


def named_term(source: str) -> str | None:
    """The dictionary's entry that a source names as the sign's own; None if it names none."""
    named = _NAMED.match(source)
    return named.group(1) if named else None


def find_written(
    terms: Mapping[str, str], entries: Iterable[DictionaryEntry]
) -> tuple[list[WrittenEntry], dict[str, str]]:
    """Look entries up in a dictionary.

    Returns:
        What was found, and why not of the other glosses: "not_found", or "several" where the dictionary
        writes a term in several ways and nothing tells which is meant.
    """
    ways: defaultdict[str, set[str]] = defaultdict(set)
    for entry in entries:
        if entry.fsw:
            ways[unicodedata.normalize("NFC", entry.term)].add(entry.fsw)
    found, missing = [], {}
    for gloss, term in terms.items():
        match sorted(ways.get(unicodedata.normalize("NFC", term), ())):
            case []:
                missing[gloss] = "not_found"
            case [fsw]:
                found.append(WrittenEntry(gloss=gloss, term=term, fsw=fsw))
            case _:
                missing[gloss] = "several"
    return found, missing


class Pen:
    """Draws signs."""

    def __init__(self) -> None:
        """Read the fonts: lines, and what is white inside them."""
        self._lines, self._fills = (_Outlines(f"SuttonSignWriting{kind}.ttf") for kind in ("Line", "Fill"))

    def draw(self, entry: WrittenEntry) -> str:
        """A sign as a `symbol` of SVG, in units of FSW: white inside, lines in the text's colour.

        Raises:
            LutError: "bad_fsw", "unknown_symbol".
        """
        symbols = read_fsw(entry.fsw)
        parts = []
        for symbol in symbols:
            number = key2id(symbol.key)
            x, y = symbol.corner
            inside = self._fills.path(symbol_fill(number))
            parts.append(
                f'<g transform="translate({x:g} {y:g}) scale({1 / _UNITS} {-1 / _UNITS})">'
                + (f'<path fill="#fff" d="{inside}"/>' if inside else "")
                + f'<path d="{self._lines.path(symbol_line(number))}"/></g>'
            )
        left, top = (min(symbol.corner[axis] for symbol in symbols) - _MARGIN for axis in (0, 1))
        right, bottom = (
            max(symbol.corner[axis] + symbol.size[axis] for symbol in symbols) + _MARGIN for axis in (0, 1)
        )
        box = f"{left:g} {top:g} {right - left:g} {bottom - top:g}"
        return f'<symbol id={quoteattr(entry.gloss)} viewBox="{box}">{"".join(parts)}</symbol>\n'


class _Outlines:
    """Outlines of a font's symbols, as paths of SVG."""

    def __init__(self, name: str) -> None:
        font = TTFont(Path(signwriting.__file__).parent / "visualizer" / name)
        self._names = font.getBestCmap()
        self._glyphs = font.getGlyphSet()

    def path(self, character: str) -> str:
        """The outline of a character, empty if there is nothing to draw."""
        pen = SVGPathPen(self._glyphs)
        self._glyphs[self._names[ord(character)]].draw(pen)
        return str(pen.getCommands())


def write_drawings(folder: Path, drawings: Mapping[WrittenEntry, str]) -> None:
    """Write drawings.svg, then signs.json, which has each gloss's entry and FSW: it names only what is drawn.

    Raises:
        OSError: They cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    svg = f'{_HEAD}<svg xmlns="http://www.w3.org/2000/svg">\n{"".join(drawings.values())}</svg>\n'
    signs = {each.gloss: {"entry": each.term, "fsw": each.fsw} for each in drawings}
    write_atomically(folder / "drawings.svg", svg.encode())
    write_atomically(folder / "signs.json", (json.dumps(signs, ensure_ascii=False, indent=1) + "\n").encode())
