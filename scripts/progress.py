# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Follows one text through the graph: which of its sentences have been signed, and how."""

from __future__ import annotations

from dataclasses import dataclass, field

from teo_sign_msgs.msg import ExecutorStatus, SignSentence, TokenTiming, TranslationStatus


@dataclass
class Progress:
    """What is known of the sentences of one text, from the messages that the nodes publish.

    The text is the one whose sentence is heard first; what others have signed meanwhile is not counted.
    """

    utterance: str = ""
    sentences: dict[int, SignSentence] = field(default_factory=dict)
    started: dict[int, ExecutorStatus] = field(default_factory=dict)
    refusals: list[str] = field(default_factory=list)
    untranslated: str = ""  # why the translator refused the text
    at_rest: bool = False

    def on_tokens(self, sentence: SignSentence) -> None:
        """Take a sentence that the translator published."""
        self.utterance = self.utterance or sentence.utterance_id
        if sentence.utterance_id != self.utterance:
            return
        self.sentences[sentence.sentence_index] = sentence

    def on_translation(self, outcome: TranslationStatus) -> None:
        """Take what became of a text, the first that is heard of."""
        if outcome.code and not self.utterance:
            self.utterance = outcome.utterance_id
            self.untranslated = f"{outcome.code}: {outcome.message}"

    def on_status(self, status: ExecutorStatus) -> None:
        """Take what the executor says it is doing."""
        if status.state == ExecutorStatus.STATE_IDLE:
            self.at_rest = bool(self.started or self.refusals)
        elif status.utterance_id != self.utterance:
            return
        elif status.state == ExecutorStatus.STATE_SIGNING:
            self.started[status.sentence_index] = status
            self.at_rest = False
        elif status.state == ExecutorStatus.STATE_REFUSED:
            self.refusals.append(f"{status.code}: {status.message}")
            self.at_rest = status.queued == 0

    @property
    def expected(self) -> int:
        """Number of sentences in the text; 0 while unknown."""
        return next((int(s.sentence_count) for s in self.sentences.values()), 0)

    @property
    def finished(self) -> bool:
        """True when every sentence was signed or refused, and the robot is at rest again."""
        return self.at_rest and 0 < self.expected <= len(self.started) + len(self.refusals)

    @property
    def signed(self) -> bool:
        """True when every sentence was signed."""
        return self.finished and not self.refusals and self.expected == len(self.started)

    def timing_at(self, index: int, elapsed: float) -> TokenTiming | None:
        """Give the token of a sentence that is signed `elapsed` seconds after its first point, if any."""
        for timing in self.started[index].timings:
            if timing.start <= elapsed <= timing.start + timing.duration:
                return timing
        return None
