# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""YAML files whose content is a `msgspec.Struct`, checked while they are read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from teo_common.checked_content import Content, ContentError, converted

# Most bytes of a file: 75 times those of the longest that comes with the packages; more is no description.
_MOST_BYTES = 1_000_000


class YamlError(ValueError):
    """A file that cannot be used; its text says which, where, what was expected and what came.

    Attributes:
        field: Path of the wrong field, such as "hand.palm"; empty where the whole file is to blame.
    """

    def __init__(self, message: str, field: str = "") -> None:
        """Keep the field beside the sentence."""
        super().__init__(message)
        self.field = field


def read_checked_yaml(path: Path, kind: type[Content]) -> Content:
    """Read a file as a type.

    Args:
        path: The file.
        kind: What it holds, of structs, mappings, lists, tuples and plain values, each optional at most.

    Raises:
        YamlError: The file cannot be read, is no YAML in UTF-8, or does not hold that.
    """
    try:
        size = path.stat().st_size
        if size > _MOST_BYTES:
            raise YamlError(f"{path}: expected at most {_MOST_BYTES} bytes, got {size}")
        content: Any = yaml.load(path.read_text(encoding="utf-8"), Loader=yaml.CSafeLoader)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise YamlError(f"{path}: expected YAML in UTF-8: {error}") from error
    try:
        return converted(content, kind)
    except ContentError as error:
        field = ".".join(map(str, error.way))
        raise YamlError(": ".join(filter(None, (str(path), field, str(error)))), field) from error
