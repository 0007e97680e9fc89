"""The exception of the look-up table."""

from __future__ import annotations


class LutError(Exception):
    """A table or an entry that cannot be used.

    Attributes:
        code: Stable reason, fit for a program to compare: see the table in `LUT.md`.
    """

    def __init__(self, code: str, message: str) -> None:
        """Keep the reason beside the sentence.

        Args:
            code: Stable reason, lower-case words joined by underscores.
            message: A sentence for people: which file and field, what was expected, what came.
        """
        super().__init__(message)
        self.code = code
