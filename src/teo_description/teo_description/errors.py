"""The exception of this package."""

from __future__ import annotations


class DescriptionError(Exception):
    """Something about the robot was asked for or given wrongly.

    Attributes:
        code: Stable reason for programs, for example ``unknown_joint``.
    """

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code
