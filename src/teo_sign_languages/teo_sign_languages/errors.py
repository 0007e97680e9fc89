# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The one exception of this package."""

from __future__ import annotations

from typing import Any

from teo_common.errors import CodedError


class LanguageError(CodedError):
    """A language that is not there ("unknown_language") or cannot be used ("invalid_language").

    Attributes:
        code: Stable reason.
        file: The file that is to blame; empty for "unknown_language".
        field: Its field, as a path such as "spoken.code"; empty where the whole file is to blame.
    """

    def __init__(self, code: str, message: str, file: str = "", field: str = "") -> None:
        """Keep file and field beside reason and sentence."""
        super().__init__(code, message)
        self.file = file
        self.field = field

    def __reduce__(self) -> tuple[type[LanguageError], tuple[Any, ...]]:
        """Its arguments, so that the error can pass from one process to another."""
        return type(self), (self.code, *self.args, self.file, self.field)
