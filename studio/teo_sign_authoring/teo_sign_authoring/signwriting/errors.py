# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Why a sign in SignWriting is refused."""

from __future__ import annotations


class UnreadableError(Exception):
    """A sign that cannot be read.

    Attributes:
        code: Stable name of the reason, such as "movement".
    """

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code
