"""The exceptions of signs: of the table, and of sentences that cannot be signed."""

from __future__ import annotations


class _CodedError(Exception):
    """A sentence for people beside a stable reason for programs."""

    def __init__(self, code: str, message: str) -> None:
        """Keep the reason beside the sentence.

        Args:
            code: Stable reason, lower-case words joined by underscores.
            message: A sentence for people: what was expected, what came, what to do.
        """
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[type[_CodedError], tuple[str, str]]:
        """Pickle with both arguments: the error can pass from one process to another."""
        return type(self), (self.code, str(self))


class LutError(_CodedError):
    """A table or an entry that cannot be used.

    Attributes:
        code: Stable reason, fit for a program to compare: see the table in `LUT.md`.
    """


class PlanError(_CodedError):
    """A sentence that cannot be signed.

    Attributes:
        code: Stable reason, fit for a program to compare: see the table of codes in the README of
            `teo_lut_executor`.
    """
