# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What recognisers of speech have heard, which nobody has confirmed yet."""

from __future__ import annotations

from teo_console.errors import ConsoleError
from teo_console.protocol.from_page import TEXT_LENGTH
from teo_console.protocol.to_page import Spoken

# What a recogniser says while nobody looks is not worth keeping beyond a few sentences.
MOST_WAITING = 5


class SpokenTexts:
    """Texts that wait for a page to confirm or discard them."""

    def __init__(self) -> None:
        """Begin without a text."""
        self._waiting: dict[str, Spoken] = {}
        self._count = 0

    def hear(self, text: str) -> None:
        """Take a text.

        Raises:
            ConsoleError: "empty_speech", "speech_too_long": nothing is kept of it.
        """
        text = " ".join(text.split())
        if not text:
            raise ConsoleError("empty_speech", "expected words on the topic speech, got none")
        if len(text) > TEXT_LENGTH:
            raise ConsoleError(
                "speech_too_long",
                f"expected at most {TEXT_LENGTH} characters on the topic speech, got {len(text)}",
            )
        self._count += 1
        self._waiting[str(self._count)] = Spoken(id=str(self._count), text=text)
        while len(self._waiting) > MOST_WAITING:
            del self._waiting[next(iter(self._waiting))]

    def take(self, spoken: str) -> Spoken:
        """Give a text and keep it no longer: of two pages, the first that confirms or discards has it.

        Raises:
            ConsoleError: "not_waiting": another page was first, or there was none.
        """
        try:
            return self._waiting.pop(spoken)
        except KeyError:
            raise ConsoleError(
                "not_waiting", f"expected a text that waits, got {spoken!r}: another page may have taken it"
            ) from None

    @property
    def waiting(self) -> tuple[Spoken, ...]:
        """What waits, the oldest first."""
        return tuple(self._waiting.values())
