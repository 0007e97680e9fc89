# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The base of errors that people read and programs compare."""

from __future__ import annotations

from typing import Any


class CodedError(Exception):
    """A sentence for people beside a stable reason for programs.

    Attributes:
        code: Stable reason, lower-case words joined by underscores.
    """

    def __init__(self, code: str, message: str) -> None:
        """Keep the reason beside the sentence.

        Args:
            code: Stable reason, lower-case words joined by underscores.
            message: A sentence for people: what was expected, what came, what to do.
        """
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[type[CodedError], tuple[Any, ...]]:
        """Its arguments, so that the error can pass from one process to another."""
        return type(self), (self.code, *self.args)
