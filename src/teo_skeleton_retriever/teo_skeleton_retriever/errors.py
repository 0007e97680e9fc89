# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the retriever raises: a stable reason and a sentence."""

from __future__ import annotations

from teo_common.errors import CodedError


class RetrieverError(CodedError):
    """What this package raises; its code says what is wrong, its text is the code and the sentence."""

    @property
    def sentence(self) -> str:
        """What was expected, what came and what to do, for people."""
        return str(self.args[0])

    def __str__(self) -> str:
        return f"{self.code}: {self.sentence}"


class TopicError(RetrieverError):
    """A topic of a bag that is to be named, as none or several may be meant.

    Attributes:
        argument: What names it: "color_topic", "depth_topic" or "camera_info_topic".
    """

    def __init__(self, code: str, sentence: str, argument: str) -> None:
        super().__init__(code, sentence)
        self.argument = argument

    def __reduce__(self) -> tuple[type[TopicError], tuple[str, ...]]:
        return type(self), (self.code, self.sentence, self.argument)
