# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Files of signs: a SignPuddle export (SPML), or a table of term and Formal SignWriting.

People type "carcel 2", "¿quien? 13" or "Mar (azul)" for a term: as a gloss it is the word with its accents,
in capitals, without marks; variants are told apart by a number that is added.
"""

from __future__ import annotations

import csv
import re
import unicodedata
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from teo_common.text_folding import strip_marks
from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, load_language
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_signs.errors import LutError
from teo_signs.sign_schema import MAX_GLOSS_LENGTH

# The whole LSE dictionary of SignPuddle, 8,300 entries with texts and sources, is about 5 MB.
MOST_BYTES = 64_000_000
_MOST_ENTRIES = 100_000

_COLUMNS = ["term", "fsw"]
# How a term of an SPML entry that is the sign itself begins.
_FSW = re.compile(r"(?:A(?:S[0-9a-f]{5})+)?[BLMR]\d{3}x\d{3}(?:S[0-9a-f]{5}\d{3}x\d{3})+")
# What XML of our own machine has no use for, and an attacker has.
_ENTITY = re.compile(rb"<!ENTITY", re.IGNORECASE)


@dataclass(frozen=True, kw_only=True)
class DictionaryEntry:
    """A sign as a dictionary has it.

    Attributes:
        term: What it means, as people of the dictionary have typed it.
        fsw: The sign in Formal SignWriting; empty if the entry has none.
        number: Its number in the file, from 1.
    """

    term: str
    fsw: str
    number: int


def read_dictionary(path: Path) -> list[DictionaryEntry]:
    """All entries of a file, in its order.

    Raises:
        LutError: "unreadable", "too_large", "not_utf8", "not_spml", "not_tsv", "no_entries".
    """
    try:
        size = path.stat().st_size
        if size > MOST_BYTES:
            raise LutError("too_large", f"{path.name}: expected at most {MOST_BYTES} bytes, got {size}")
        data = path.read_bytes()
    except OSError as error:
        raise LutError(
            "unreadable", f"{path.name}: expected a file to read, got: {error.strerror}"
        ) from error
    spml = path.suffix.lower() in (".spml", ".xml") or data.lstrip()[:1] == b"<"
    entries = _spml(path, data) if spml else _tsv(path, data)
    if not entries:
        raise LutError("no_entries", f"{path.name}: expected entries of a dictionary, got none")
    if len(entries) > _MOST_ENTRIES:
        raise LutError(
            "too_large", f"{path.name}: expected at most {_MOST_ENTRIES} entries, got {len(entries)}"
        )
    return entries


def _spml(path: Path, data: bytes) -> list[DictionaryEntry]:
    if _ENTITY.search(data):
        raise LutError("not_spml", f"{path.name}: expected SPML without entities of its own, got <!ENTITY")
    try:
        root = ElementTree.fromstring(data)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise LutError("not_spml", f"{path.name}: expected SPML, an XML file, got: {error}") from error
    if root.tag != "spml":
        raise LutError("not_spml", f"{path.name}: expected the element spml, got {root.tag}")
    entries: list[DictionaryEntry] = []
    for number, entry in enumerate(root.iter("entry"), start=1):
        terms = [(term.text or "").strip() for term in entry.iter("term")]
        signs = [term for term in terms if _FSW.fullmatch(term)]
        words = [term for term in terms if term and not _FSW.fullmatch(term)]
        entries.append(
            DictionaryEntry(term=words[0] if words else "", fsw=signs[0] if signs else "", number=number)
        )
    return entries


def _tsv(path: Path, data: bytes) -> list[DictionaryEntry]:
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise LutError("not_utf8", f"{path.name}: expected UTF-8, got byte {data[error.start]:#x}") from error
    lines = [line for line in text.splitlines() if line.strip()]
    rows = list(csv.reader(lines, delimiter="\t", quoting=csv.QUOTE_NONE))
    if rows and [cell.strip().lower() for cell in rows[0]] == _COLUMNS:
        rows = rows[1:]
    entries = []
    for number, row in enumerate(rows, start=1):
        if len(row) != len(_COLUMNS):
            raise LutError(
                "not_tsv", f"{path.name}: entry {number}: expected term, tab, FSW; got {len(row)} columns"
            )
        entries.append(DictionaryEntry(term=row[0].strip(), fsw=row[1].strip(), number=number))
    return entries


_VARIANT = re.compile(r"\s*\d+$")
_REMARK = re.compile(r"\([^)]*\)")
_WORD = re.compile(r"[^\W\d_]+")


class GlossNames:
    """Gives terms their glosses."""

    def __init__(self, *, language: str = DEFAULT_LANGUAGE, any_term: bool = False) -> None:
        """Load the words of the spoken language.

        Args:
            language: Code of the sign language.
            any_term: Whether words that are not known are taken as they are typed.

        Raises:
            LutError: "unknown_language", "invalid_language"; "no_words" if the language has no words and
                they are asked for.
        """
        try:
            text = load_language(language).text
        except LanguageError as error:
            raise LutError(error.code, str(error)) from error
        self._morphology = Morphology.load(text) if (text / "morphology").is_dir() else None
        if self._morphology is None and not any_term:
            raise LutError("no_words", f"expected --any-term for {language}, a language without known words")
        self._any_term = any_term

    def gloss(self, term: str) -> str | None:
        """The gloss of a term without the number of its variant; None if it is not a known one."""
        plain = _VARIANT.sub("", _REMARK.sub(" ", unicodedata.normalize("NFC", term))).strip()
        words = _WORD.findall(plain)
        if not words or re.search(r"\d", plain):
            return None
        written = [self._known(word.lower()) for word in words]
        if None in written and not self._any_term:
            return None
        gloss = "_".join((spelled or word).upper() for spelled, word in zip(written, words, strict=True))
        return gloss if len(gloss) <= MAX_GLOSS_LENGTH else None

    def _known(self, word: str) -> str | None:
        """A word with its accents; None if it is not known."""
        if self._morphology is None:
            return None
        readings = self._morphology.readings(word)
        headwords = [each for each in readings if strip_marks(each.lemma) == strip_marks(word)]
        for reading in headwords:
            # A guess keeps the word as typed and says that it is none.
            if reading.exact or reading.lemma != word:
                return reading.lemma.lower()
        if any(reading.exact for reading in readings):
            return word
        for reading in readings:
            if reading.lemma == word or reading.tag in ("X", "NAME"):
                continue
            try:
                written = self._morphology.inflect(reading.lemma, reading.tag)
            except TranslationError:
                continue
            if strip_marks(written) == strip_marks(word):
                return written
        return None


def numbered(glosses: list[str | None]) -> list[str | None]:
    """Glosses told apart: the first of a name keeps it, the others are NAME_2, NAME_3."""
    seen: dict[str, int] = {}
    told: list[str | None] = []
    for gloss in glosses:
        if gloss is None:
            told.append(None)
            continue
        seen[gloss] = seen.get(gloss, 0) + 1
        told.append(gloss if seen[gloss] == 1 else f"{gloss}_{seen[gloss]}")
    return told
