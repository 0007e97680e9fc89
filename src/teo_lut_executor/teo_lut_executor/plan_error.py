"""The exception of the planner."""

from __future__ import annotations


class PlanError(Exception):
    """A sentence that cannot be signed.

    Attributes:
        code: Stable reason, fit for a program to compare: see the table of codes in the package's README.
    """

    def __init__(self, code: str, message: str) -> None:
        """Keep the reason beside the sentence.

        Args:
            code: Stable reason, lower-case words joined by underscores.
            message: A sentence for people: what was expected, what came, what to do.
        """
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[type[PlanError], tuple[str, str]]:
        """Both arguments, so that the error can pass from one process to another."""
        return type(self), (self.code, str(self))
