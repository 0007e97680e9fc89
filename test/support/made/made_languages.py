# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A second sign language for tests: the default one's data under another code, and a table of its own."""

from __future__ import annotations

import json
from pathlib import Path

from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.sign import Sign
from teo_signs.sign_file import save_sign

# ISO 639-3 keeps qaa to qtz for local use.
CODE = "qaa"


def make_language(data_home: Path, signs: dict[str, Sign] | None = None) -> Path:
    """Make a language of the user's own.

    Args:
        data_home: Where it is found, XDG_DATA_HOME.
        signs: Its table for TEO; by default the default language's letters and HOLA.

    Returns:
        Its folder.
    """
    ssp = load_language(DEFAULT_LANGUAGE)
    folder = data_home / "teo" / "languages" / CODE
    table = folder / "tables" / "teo"
    table.mkdir(parents=True)
    text = (ssp.directory / "language.yaml").read_text("utf-8")
    text = text.replace(f"code: {ssp.code}", f"code: {CODE}").replace("formerly", "# formerly")
    (folder / "language.yaml").write_text(text, "utf-8")
    for part in ("text", "models", "scores"):
        (folder / part).symlink_to(ssp.directory / part)
    if signs is None:
        for gloss in (*ssp.alphabet.letters, "HOLA"):
            entry = json.loads((ssp.table("teo") / f"{gloss}.json").read_text("utf-8"))
            (table / f"{gloss}.json").write_text(json.dumps(entry | {"language": CODE}), "utf-8")
    for sign in (signs or {}).values():
        save_sign(table, sign)
    return folder
