# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writes the messages as JSON Schema: `python -m teo_console.protocol.schema > protocol.schema.json`."""

from __future__ import annotations

import json
from typing import Any

import msgspec

from teo_console.protocol.from_page import FromPage
from teo_console.protocol.to_page import ToPage


def schema() -> dict[str, Any]:
    """Both directions, with the types that they share under `$defs`."""
    (from_page, to_page), definitions = msgspec.json.schema_components((FromPage, ToPage))
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Messages of the console's websocket",
        "$defs": {**definitions, "FromPage": from_page, "ToPage": to_page},
        "description": "A page sends FromPage, the node ToPage.",
    }


def schema_text() -> str:
    """The schema as its file has it."""
    return json.dumps(schema(), indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    print(schema_text(), end="")
