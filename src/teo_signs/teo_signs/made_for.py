# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which language and robot signs are made for: those of another are neither read into a table nor written."""

from __future__ import annotations

import json
from pathlib import Path

from teo_sign_languages import DEFAULT_LANGUAGE, Language, LanguageError, load_language
from teo_signs.errors import LutError
from teo_signs.sign import Sign
from teo_signs.sign_schema import DEFAULT_ROBOT


def refuse_another(sign: Sign, entry: Path, language: Language, robot: str) -> None:
    """Refuse an entry that is not of the language or for the robot in use.

    Args:
        sign: The entry as read.
        entry: Its file, for the message.
        language: The language in use.
        robot: Name of the robot in use.

    Raises:
        LutError: "other_language" or "other_robot", with what to do.
    """
    code = language.code
    if sign.language not in (code, *language.formerly):
        raise LutError(
            "other_language",
            f"{entry}: language: expected {code}, the language in use, got {sign.language}; use this "
            f"table with language {sign.language} (`--language {sign.language}`), or a table of {code}: "
            "no command turns signs of one language into another's",
        )
    if sign.robot != robot:
        raise LutError(
            "other_robot",
            f"{entry}: robot: expected {robot}, the robot in use, got {sign.robot}; use this table "
            f"with robot {sign.robot} (`--robot {sign.robot}`), or make one for {robot}: `ros2 run "
            f"teo_lut_executor lut retarget --language {code} --robot {robot}`",
        )


def refuse_mixed(sign: Sign, path: Path) -> None:
    """Refuse to write a sign beside those of another language or robot: one of them tells for all.

    Args:
        sign: The sign.
        path: Its file, which need not be there.

    Raises:
        LutError: "other_language" or "other_robot".
    """
    beside = next((other for other in sorted(path.parent.glob("[!.]*.json")) if other != path), None)
    if beside is None:
        return
    try:
        entry = json.loads(beside.read_bytes())
        language, robot = entry.get("language", DEFAULT_LANGUAGE), entry.get("robot", DEFAULT_ROBOT)
    except (OSError, ValueError, AttributeError):  # a broken entry is named when it is asked for
        return
    if robot == sign.robot and _code(language) == _code(sign.language):
        return
    raise LutError(
        "other_language" if robot == sign.robot else "other_robot",
        f"{path}: expected a sign of {language} for {robot}, as those in {path.parent}, got one of "
        f"{sign.language} for {sign.robot}; give it a directory of its own",
    )


def _code(language: str) -> str:
    """The code of a language that may be named as it was formerly."""
    try:
        return load_language(language).code
    except LanguageError:  # one that is not installed here is like itself alone
        return language
