# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Real LSE sentences as their annotators write them (RADIS), and which of their signs are words."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

from teo_sign_translator.data_files import read_rows

#: Points at people; all other pointing is no word.
_PRONOUNS = {"INDX.PRO:1sg": "YO", "INDX.PRO:2sg": "TÚ"}
#: Pointing, classifiers and other depicting signs, gestures, buoys; signs that were broken off, depicted
#: actions, and what the face alone says.
_NO_WORD = re.compile(r"INDX.*|cl\..*|G([(:].*)?|B\.L.*|.*-|.*\[AC\]|\(.*\)|[a-z]+")
#: Form and variant of a sign: `LISTO(1M)`, `PERA2`.
_FORM = re.compile(r"\(.*?\)|\d+$")


class AnnotatedSentence(NamedTuple):
    """A sentence that a person signed.

    Attributes:
        spanish: Its translation.
        signs: Glosses of the signs that are words, in the order of signing; may be empty.
    """

    spanish: str
    signs: tuple[str, ...]


def read_annotated(path: Path) -> list[AnnotatedSentence]:
    """Read a table of identifier, Spanish and annotation, under a line of headings.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    rows = [fields for _, fields in read_rows(path, columns=3)][1:]
    return [
        # Brackets are the annotators': people write the words alone.
        AnnotatedSentence(re.sub(r"[()]", "", spanish).strip(), word_signs(annotation))
        for _, spanish, annotation in rows
    ]


def word_signs(annotation: str) -> tuple[str, ...]:
    """The signs of an annotation that are words."""
    signs = (_PRONOUNS.get(sign, "" if _NO_WORD.fullmatch(sign) else sign) for sign in annotation.split())
    return tuple(_FORM.sub("", sign) for sign in signs if sign)
