# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""All answers as files: JSON, which `lut review` reads, and CSV for tables."""

from __future__ import annotations

import csv
import datetime
import io
from collections.abc import Sequence

import msgspec

from teo_console.review.series import Answer

FORMAT = "teo-review-1"
# Spreadsheets take a cell that begins so for a formula (OWASP, "CSV injection").
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def as_json(answers: Sequence[Answer]) -> bytes:
    """The export that `lut review` reads."""
    exported = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
    content = {"format": FORMAT, "exported": exported, "answers": answers}
    return msgspec.json.format(msgspec.json.encode(content), indent=1) + b"\n"


def as_csv(answers: Sequence[Answer]) -> bytes:
    """A row for each answer, flags with spaces between them; an apostrophe before what would be a formula."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(Answer.__struct_fields__)
    for answer in answers:
        row = {**msgspec.structs.asdict(answer), "flags": " ".join(answer.flags)}
        writer.writerow([_cell(value) for value in row.values()])
    return out.getvalue().encode()


def _cell(value: object) -> object:
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, str) and value.startswith(_FORMULA):
        return f"'{value}"
    return value
