# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Draws the console's signs in SignWriting as one SVG file, which is committed: the page needs no font.

Run it again after a change of `src/teo_console/web/signwriting/signs.json`, which has the Formal SignWriting
(draft-slevinski-formal-signwriting) of each gloss. Outlines come from the fonts of the package `signwriting`.
"""

from __future__ import annotations

import json
from pathlib import Path
from xml.sax.saxutils import quoteattr

import signwriting
from fontTools.pens.boundsPen import BoundsPen  # type: ignore[import-untyped]  # ships no types
from fontTools.pens.svgPathPen import SVGPathPen  # type: ignore[import-untyped]  # ships no types
from fontTools.ttLib import TTFont  # type: ignore[import-untyped]  # ships no types
from signwriting.formats.fsw_to_sign import fsw_to_sign
from signwriting.formats.fsw_to_swu import key2id, symbol_fill, symbol_line

FOLDER = Path(__file__).parents[1] / "src" / "teo_console" / "web" / "signwriting"
# Units of the fonts' outlines for each unit of FSW: an em of 300 is written 30 high.
UNITS = 10
HEAD = """<!-- SPDX-FileCopyrightText: 1974-2014 Center for Sutton Movement Writing, Inc. -->
<!-- SPDX-License-Identifier: OFL-1.1 -->
<!-- Made by scripts/draw_signwriting.py from signs.json. -->
"""


class Outlines:
    """Outlines of a font's symbols, as paths of SVG."""

    def __init__(self, name: str) -> None:
        """Read a font of the package `signwriting` by its file's name."""
        font = TTFont(Path(signwriting.__file__).parent / "visualizer" / name)
        self._names = font.getBestCmap()
        self._glyphs = font.getGlyphSet()

    def path(self, character: str) -> str:
        """The outline of a character, empty if there is nothing to draw."""
        pen = SVGPathPen(self._glyphs)
        self._glyphs[self._names[ord(character)]].draw(pen)
        return str(pen.getCommands())

    def size(self, character: str) -> tuple[float, float]:
        """How far it reaches to the right and down from its corner, in units of FSW."""
        pen = BoundsPen(self._glyphs)
        self._glyphs[self._names[ord(character)]].draw(pen)
        _, bottom, right, _ = pen.bounds
        return right / UNITS, -bottom / UNITS


def drawing(gloss: str, fsw: str, lines: Outlines, fills: Outlines) -> str:
    """One sign as a `symbol` of SVG, in units of FSW: white inside, lines in the text's colour."""
    parts, corners = [], []
    for each in fsw_to_sign(fsw)["symbols"]:
        x, y = each["position"]
        line, fill = (kind(key2id(each["symbol"])) for kind in (symbol_line, symbol_fill))
        width, height = lines.size(line)
        corners += [(x, y), (x + width, y + height)]
        place = f'transform="translate({x} {y}) scale({1 / UNITS} {-1 / UNITS})"'
        inside = fills.path(fill)
        parts.append(
            f"<g {place}>"
            + (f'<path fill="#fff" d="{inside}"/>' if inside else "")
            + f'<path d="{lines.path(line)}"/></g>'
        )
    left, top = (min(corner[axis] for corner in corners) - 1 for axis in (0, 1))
    right, bottom = (max(corner[axis] for corner in corners) + 1 for axis in (0, 1))
    box = f"{left:g} {top:g} {right - left:g} {bottom - top:g}"
    return f'<symbol id={quoteattr(gloss)} viewBox="{box}">{"".join(parts)}</symbol>\n'


def main() -> None:
    """Draw every sign."""
    signs = json.loads((FOLDER / "signs.json").read_text("utf-8"))["signs"]
    lines, fills = Outlines("SuttonSignWritingLine.ttf"), Outlines("SuttonSignWritingFill.ttf")
    drawn = "".join(drawing(gloss, each["fsw"], lines, fills) for gloss, each in signs.items())
    (FOLDER / "drawings.svg").write_text(
        f'{HEAD}<svg xmlns="http://www.w3.org/2000/svg">\n{drawn}</svg>\n', "utf-8"
    )


if __name__ == "__main__":
    main()
