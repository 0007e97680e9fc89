"""The one exception of this package."""

from __future__ import annotations


class TranslationError(Exception):
    """Something that cannot be translated, loaded or trained.

    Attributes:
        code: Stable reason for programs, e.g. `"empty_text"`; the codes are listed in the package's README.
    """

    def __init__(self, code: str, message: str) -> None:
        """Keep the code beside the sentence.

        Args:
            code: Stable reason, lower case with underscores.
            message: A sentence for people: what was expected, what came, what to do.
        """
        super().__init__(message)
        self.code = code
