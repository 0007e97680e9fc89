"""The package's one exception."""

from __future__ import annotations


class Ros2CliError(Exception):
    """A command cannot do what was asked of it.

    Its text is printed on the error stream as it is, and the command exits with status 1.

    Args:
        code: Stable reason in snake case, for programs and tests.
        sentence: What was expected, what came instead and, where there is one, the way out.
    """

    def __init__(self, code: str, sentence: str) -> None:
        super().__init__(sentence)
        self.code = code
