# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From text as it arrives to text in one form of Unicode, without invisible characters."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from teo_sign_translator.errors import TranslationError

#: Longest text that is translated [characters]. Spelled letter by letter, this is over an hour of signing
#: already; it also bounds the time that one text can keep the translator from the next (measured on one core:
#: 0.1 s for prose, 3 s for the worst that was tried, 10,000 clauses of one letter).
MAX_TEXT_LENGTH = 20_000

_REPLACEMENTS = str.maketrans(
    {
        **dict.fromkeys("“”„‟«»‹›〝〞＂", '"'),
        **dict.fromkeys("‘’‚‛′´`ʼʹˈ＇", "'"),
        **dict.fromkeys("‐‑‒⁃", "-"),
        **dict.fromkeys("，、", ","),
        **dict.fromkeys("。．", "."),
        **dict.fromkeys("？⁇؟", "?"),
        **dict.fromkeys("！‼", "!"),
        **dict.fromkeys("\u2028\u2029\u0085\r\v\f", "\n"),
        "：": ":",
        "；": ";",
        "＋": "+",
        "％": "%",
        "＝": "=",
        "＠": "@",
        "＆": "&",
        "＄": "$",
    }
)

_DRAWN_OUT = re.compile(r"([^\W\d_])\1{2,}")

# What Spanish keyboards give is in that form already; most texts are.
_IN_ONE_FORM = re.compile("[ -_a-~áéíóúüñÁÉÍÓÚÜÑ¿¡ºª€…\n]*")


@dataclass(frozen=True, slots=True)
class CleanText:
    """Text in one form of Unicode, without what cannot be seen.

    Attributes:
        text: Composed (NFC); printable characters, spaces and line feeds only.
        ignored: Characters that were taken out because nothing in them can be signed, in order, e.g. control
            characters.
    """

    text: str
    ignored: tuple[str, ...]


def clean(text: str) -> CleanText:
    """Bring a text into one form: NFC, straight quotes, plain letters and digits, no control characters.

    Accents, capitals and marks stay: they carry meaning. Presentation forms of letters and digits (full
    width, ligatures, superscripts, Roman numeral signs) become plain ones; `ª` and `º` stay.

    Raises:
        TranslationError: "text_too_long", "broken_encoding" (lone surrogates or U+FFFD: the sender's bytes
            were not UTF-8).
    """
    if len(text) > MAX_TEXT_LENGTH:
        raise TranslationError(
            "text_too_long",
            f"expected at most {MAX_TEXT_LENGTH} characters, got {len(text)}: send it in parts",
        )
    broken = next((c for c in text if "\ud800" <= c <= "\udfff" or c == "\ufffd"), None)
    if broken is not None:
        raise TranslationError(
            "broken_encoding",
            f"expected text in UTF-8, got U+{ord(broken):04X} instead: check the sender's encoding",
        )
    if _IN_ONE_FORM.fullmatch(text):
        return CleanText(text, ())
    kept: list[str] = []
    ignored: list[str] = []
    for character in unicodedata.normalize("NFC", text.replace("\r\n", "\n").translate(_REPLACEMENTS)):
        category = unicodedata.category(character)
        if category[0] == "Z" or character == "\t":
            kept.append(" ")
        elif category == "Cf":  # joiners, direction marks, soft hyphens: invisible, and nothing is lost
            continue
        elif category[0] == "C" and character != "\n":
            kept.append(" ")
            ignored.append(character)
        elif category[0] in "LN" and character not in "ªº":
            kept.append(_plain(character))
        else:
            kept.append(character)
    return CleanText(unicodedata.normalize("NFC", "".join(kept)), tuple(ignored))


def _plain(character: str) -> str:
    """The plain letters or digits that a presentation form stands for; itself if there are none."""
    if character.isascii():
        return character
    digit = unicodedata.digit(character, None)
    if digit is not None:
        return str(digit)
    return unicodedata.normalize("NFKC", character).replace("⁄", "/")


def is_drawn_out(word: str) -> bool:
    """Whether a letter stands three times in a row, as in `"holaaaa"`: no Spanish word is written so."""
    return _DRAWN_OUT.search(word) is not None


def shortened(word: str, times: int = 1) -> str:
    """A drawn-out word with each such letter once, or twice: `"leeeer"` is `"ler"` or `"leer"`."""
    return _DRAWN_OUT.sub(lambda match: match[1] * times, word)
