# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What was accepted, begun and ended, in a file that outlives the process.

A line for each event is written at once: a checksum, and JSON. It reaches the disk when the system likes: the
file outlives a process that is killed, not a power cut. A last line that is torn is passed over. What a full
disk does not take is written later.
"""

from __future__ import annotations

import fcntl
import json
import zlib
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import asdict
from io import FileIO
from pathlib import Path
from typing import Any, NamedTuple

from teo_lut_executor.execution.interface import Sentence
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_signs.tokens import Kind, Token

# Messages that are recognised when they come again: ten times as many as a translator keeps for an executor
# that begins late, since several may keep as many.
_MOST_MESSAGES = 1000


class MessageKey(NamedTuple):
    """Names one publication of a sentence; the same sentence published again has another.

    Attributes:
        published: When, as the publisher's system clock had it [ns].
        utterance_id: Of the sentence's text.
        sentence_index: Of the sentence in it.
    """

    published: int
    utterance_id: str
    sentence_index: int


class Kept(NamedTuple):
    """A sentence that was accepted and not ended.

    Attributes:
        sentence: The sentence.
        accepted: When [s], by the system's clock.
        attempts: How often it was begun.
    """

    sentence: Sentence
    accepted: float
    attempts: int


class Journal:
    """Writes down what becomes of sentences.

    Attributes:
        left: What the executor before this one accepted and did not end.
        unread: Lines of its journal that are spoilt: `begin` keeps such a journal, beside the new one.
        problem: Why not all is written, and would be forgotten if this process were killed; empty if all is.
    """

    def __init__(self, path: Path | None) -> None:
        """Open the journal of one executor, and read what the one before it left.

        Args:
            path: The file; it is made with its folder if it is not there. It stays as it is until `begin`:
                what was left is still there if this executor is killed before it has taken it over. None
                keeps nothing.

        Raises:
            BlockingIOError: Another executor uses it.
        """
        self.left: tuple[Kept, ...] = ()
        self.unread = 0
        self.problem = ""
        self._path = path
        self._messages: dict[MessageKey, None] = {}
        self._files = ExitStack()
        self._file: FileIO | None = None
        self._unwritten = b""
        self._awaits_place = False
        if path is None:
            return
        self._new = path.with_suffix(".new")
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            lock = self._files.enter_context(path.with_suffix(".lock").open("w"))
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            before = _Contents(path)
            self.left, self.unread = tuple(before.kept.values()), before.unread
            self._messages = before.messages
            self._file = self._files.enter_context(self._new.open("wb", buffering=0))
        except BlockingIOError:
            self.close()
            raise
        except OSError as error:
            self.problem = str(error)
        for message in self._messages:
            self._write({"message": message})

    @property
    def kept(self) -> bool:
        """Whether there is a journal."""
        return self._path is not None

    def begin(self) -> None:
        """Take the place of the journal before, now that all it left was accepted anew or ended."""
        self._awaits_place = True
        self._save()

    def knows(self, message: MessageKey) -> bool:
        """Whether a message was accepted or refused before, perhaps by an executor before this one."""
        return message in self._messages

    def accepted(
        self,
        ticket: int,
        sentence: Sentence,
        now: float,
        *,
        attempts: int = 0,
        message: MessageKey | None = None,
    ) -> None:
        """A sentence waits to be signed.

        Args:
            ticket: Names it in `begun` and `ended`.
            sentence: The sentence.
            now: Time of the system's clock [s].
            attempts: How often it was begun already.
            message: That it came with; None if it came as a goal.
        """
        entry = {"accepted": ticket, "time": now, "attempts": attempts, "sentence": asdict(sentence)}
        if message is not None:
            _remember(self._messages, message)
            entry["message"] = message
        self._write(entry)

    def refused(self, message: MessageKey) -> None:
        """What came with a message is not accepted, and that was told."""
        _remember(self._messages, message)
        self._write({"message": message})

    def begun(self, ticket: int) -> None:
        """The robot begins to sign it."""
        self._write({"begun": ticket})

    def ended(self, ticket: int) -> None:
        """It was signed, or it was told that it is not."""
        self._write({"ended": ticket})

    def close(self) -> None:
        """Write no more."""
        self._files.close()
        self._file = None

    def _write(self, entry: dict[str, Any]) -> None:
        if self._file is not None:
            text = json.dumps(entry).encode()
            self._unwritten += b"%08x %s\n" % (zlib.crc32(text), text)
            self._save()

    def _save(self) -> None:
        """Write what is not written yet; once all is, the place of the journal before can be taken."""
        if self._file is None or self._path is None:
            return
        try:
            while self._unwritten:
                self._unwritten = self._unwritten[self._file.write(self._unwritten) :]
            if self._awaits_place:
                if self.unread:
                    self._path.replace(self._path.with_suffix(".spoilt"))
                self._new.replace(self._path)
                self._awaits_place = False
        except OSError as error:
            self.problem = str(error)
        else:
            self.problem = ""


class _Contents:
    """What a journal says.

    Attributes:
        kept: Sentences that were accepted and not ended, in their order, by their ticket.
        messages: The latest that were accepted or refused, in their order.
        unread: Lines that are spoilt, or of another version; the others count.
    """

    def __init__(self, path: Path) -> None:
        self.kept: dict[int, Kept] = {}
        self.messages: dict[MessageKey, None] = {}
        self.unread = 0
        lines = path.read_bytes().split(b"\n") if path.exists() else [b""]
        for line in lines[:-1]:  # behind the last end of a line is nothing, or a line that is torn
            checksum, _, text = line.partition(b" ")
            try:
                if int(checksum, 16) != zlib.crc32(text):
                    raise ValueError(checksum)
                self._add(json.loads(text))
            except (ValueError, KeyError, TypeError):
                self.unread += 1

    def _add(self, entry: Mapping[str, Any]) -> None:
        if "message" in entry:
            published, utterance_id, sentence_index = entry["message"]
            _remember(self.messages, MessageKey(int(published), str(utterance_id), int(sentence_index)))
        if "accepted" in entry:
            sentence = _sentence(entry["sentence"])
            self.kept[entry["accepted"]] = Kept(sentence, float(entry["time"]), int(entry["attempts"]))
        elif "begun" in entry:
            before = self.kept[entry["begun"]]
            self.kept[entry["begun"]] = before._replace(attempts=before.attempts + 1)
        elif "ended" in entry:
            self.kept.pop(entry["ended"], None)


def _remember(messages: dict[MessageKey, None], message: MessageKey) -> None:
    """Add a message, and forget the oldest if there are too many."""
    messages[message] = None
    if len(messages) > _MOST_MESSAGES:
        del messages[next(iter(messages))]


def _sentence(entry: dict[str, Any]) -> Sentence:
    tokens = tuple(
        Token(**{**token, "kind": Kind(token["kind"]), "source_words": tuple(token["source_words"])})
        for token in entry.pop("tokens")
    )
    form = entry.pop("form")
    form = SentenceForm(type=SentenceType(form["type"]), negated=form["negated"])
    return Sentence(tokens=tokens, form=form, **entry)
