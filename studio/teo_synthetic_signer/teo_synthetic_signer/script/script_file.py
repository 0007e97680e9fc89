# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The file of a script: YAML, every error with its line and field."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import yaml
from pydantic import ValidationError

from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.script.keys import Key
from teo_synthetic_signer.script.script_schema import KeyText, RepeatText, ScriptText
from teo_synthetic_signer.script.scripts import about, script
from teo_synthetic_signer.script.signs import HANGING

# By which a script's file is told from a script's name.
SUFFIXES = (".yaml", ".yml")
# A minute of signing is 50 kB; this is no script.
_MOST_BYTES = 2_000_000
# [s] Of a script: 18,000 frames take 40 min to render.
_LONGEST = 600.0
# What pydantic puts between the fields of a path where a field can be of several kinds.
_UNIONS = ("ArmText", "ShapeText", "KeyText", "RepeatText", "ThumbText", "str", "literal['hanging']")


class Script(NamedTuple):
    """A script from a file."""

    keys: tuple[Key, ...]
    about: str


def script_of(name: str) -> Script:
    """Give a script by its name, or from its file if that ends as files of scripts do.

    Raises:
        SyntheticError: As `script` or `read_script`.
    """
    if name.lower().endswith(SUFFIXES):
        return read_script(Path(name))
    return Script(script(name), about(name))


def read_script(path: Path) -> Script:
    """Read and check a script.

    Raises:
        SyntheticError: "unreadable_script", "script_too_large", "not_yaml", "bad_script"; the message begins
            with file and line and names the field.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        message = f"{path.name}: expected a file to read, got: {error.strerror}"
        raise SyntheticError("unreadable_script", message) from error
    if len(data) > _MOST_BYTES:
        message = f"{path.name}: expected at most {_MOST_BYTES} bytes, got {len(data)}"
        raise SyntheticError("script_too_large", message)
    try:
        source = data.decode("utf-8")
        root = yaml.compose(source, Loader=yaml.SafeLoader)
        content = yaml.safe_load(source)
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        message = f"{path.name}: expected YAML in UTF-8, got: {' '.join(str(error).split())}"
        raise SyntheticError("not_yaml", message) from error
    if not isinstance(root, yaml.MappingNode):
        raise SyntheticError("bad_script", f"{path.name}:1: expected fields such as 'keys:', got none")
    try:
        text = ScriptText.model_validate(content)
    except ValidationError as error:
        where, expected = _first_error(error)
        raise _refusal(path, root, where, expected) from error
    flat = _flattened(text.keys)
    for side in ("right", "left"):
        if getattr(flat[0], side) is None:
            raise _refusal(path, root, ["keys", 0], f"the first key to say where the {side} arm is")
    keys: list[Key] = []
    for key in flat:
        keys.append(key.key(keys[-1] if keys else Key(), HANGING))
    duration = sum(key.move + key.hold for key in keys)
    if duration > _LONGEST:
        raise _refusal(path, root, ["keys"], f"a script of at most {_LONGEST:g} s, got {duration:.0f} s")
    return Script(tuple(keys), text.about)


def _flattened(keys: list[KeyText | RepeatText]) -> list[KeyText]:
    flat: list[KeyText] = []
    for key in keys:
        flat += key.keys * key.times if isinstance(key, RepeatText) else [key]
    return flat


def _first_error(error: ValidationError) -> tuple[list[int | str], str]:
    """Choose the error that is deepest in the text: where a field can be of kinds, of the nearest one."""
    found = []
    for one in error.errors():
        where = [part for part in one["loc"] if part not in _UNIONS and "[" not in str(part)]
        expected = str(one["msg"]).removeprefix("Value error, ")
        if isinstance(one["input"], (str, int, float)) and "got" not in expected:
            expected = f"{expected}; got {one['input']!r}"
        found.append((where, expected))
    return max(found, key=lambda one: len(one[0]))


def _refusal(path: Path, root: yaml.Node, where: list[int | str], expected: str) -> SyntheticError:
    field = ".".join(map(str, where)) or "script"
    return SyntheticError("bad_script", f"{path.name}:{_line(root, where)}: {field}: {expected}")


def _line(node: yaml.Node, path: list[int | str]) -> int:
    """Line of the deepest part of a path that the text has, from 1."""
    line = int(node.start_mark.line) + 1
    for part in path:
        if isinstance(node, yaml.MappingNode):
            found = next((pair for pair in node.value if pair[0].value == part), None)
            if found is None:
                break
            line, node = int(found[0].start_mark.line) + 1, found[1]
        elif isinstance(node, yaml.SequenceNode) and isinstance(part, int) and part < len(node.value):
            node = node.value[part]
            line = int(node.start_mark.line) + 1
        else:
            break
    return line
