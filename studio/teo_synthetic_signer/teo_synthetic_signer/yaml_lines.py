# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""YAML that people write, with the line of each field: scripts, and the scores of signs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import yaml

from teo_synthetic_signer.errors import SyntheticError


class YamlLines:
    """A file's content, and where each part of it stands.

    Attributes:
        content: What YAML makes of the file: a mapping.
    """

    def __init__(self, path: Path, *, most_bytes: int, fields: str) -> None:
        """Read the file.

        Args:
            path: The file.
            most_bytes: Greatest size of such a file [B].
            fields: What is expected in it, for people: "fields such as 'keys:'".

        Raises:
            SyntheticError: "unreadable", "too_large", "not_utf8", "not_yaml", "no_fields"; the sentence
                begins with the file.
        """
        self._name = path.name
        try:
            data = path.read_bytes()
        except OSError as error:
            raise self._error("unreadable", f"expected a file to read, got: {error.strerror}") from error
        if len(data) > most_bytes:
            raise self._error("too_large", f"expected at most {most_bytes} bytes, got {len(data)}")
        try:
            loader = yaml.CSafeLoader(data.decode("utf-8"))
            root = loader.get_single_node()
            self.content: Any = None if root is None else loader.construct_document(root)
        except UnicodeDecodeError as error:
            raise self._error("not_utf8", f"expected UTF-8, got byte {data[error.start]:#x}") from error
        except yaml.YAMLError as error:
            raise self._error("not_yaml", f"expected YAML, got: {' '.join(str(error).split())}") from error
        if not isinstance(root, yaml.MappingNode):
            raise SyntheticError("no_fields", f"{path.name}:1: expected {fields}, got none")
        self._root: yaml.Node = root

    def place(self, field: Sequence[int | str]) -> str:
        """File and line of a field, or of the deepest part of the way to it that the file has."""
        node, line = self._root, int(self._root.start_mark.line) + 1
        for part in field:
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
        return f"{self._name}:{line}"

    def _error(self, code: str, sentence: str) -> SyntheticError:
        return SyntheticError(code, f"{self._name}: {sentence}")
