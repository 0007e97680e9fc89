# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What was accepted, begun and ended, in a file that outlives the process.

A line of JSON for each event is written at once. It reaches the disk when the system likes: the file outlives
a process that is killed, not a power cut. A last line that is torn is passed over.
"""

from __future__ import annotations

import fcntl
import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

from teo_common.atomic_files import write_atomically
from teo_lut_executor.execution.events import Sentence
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_signs.tokens import Kind, Token


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
    """Writes down what becomes of sentences."""

    def __init__(self, path: Path) -> None:
        """Open the journal of one executor, and take over what the one before it left.

        Args:
            path: The file; it is made with its folder if it is not there.

        Raises:
            OSError: It cannot be read or written, or another executor uses it (`BlockingIOError`).
        """
        path.parent.mkdir(parents=True, exist_ok=True)
        self._lock = path.with_suffix(".lock").open("w")
        fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        self.left = tuple(_left(path))
        write_atomically(path, b"")
        self._file = path.open("a", encoding="utf-8", buffering=1)  # a line at a time

    def accepted(self, ticket: int, sentence: Sentence, now: float, *, attempts: int = 0) -> None:
        """A sentence waits to be signed; `now` is of the system's clock [s]."""
        entry = {"accepted": ticket, "time": now, "attempts": attempts, "sentence": asdict(sentence)}
        self._write(entry)

    def begun(self, ticket: int) -> None:
        """The robot begins to sign it."""
        self._write({"begun": ticket})

    def ended(self, ticket: int) -> None:
        """It was signed, or it was told that it is not."""
        self._write({"ended": ticket})

    def close(self) -> None:
        """Write no more."""
        self._file.close()
        self._lock.close()

    def _write(self, entry: dict[str, Any]) -> None:
        self._file.write(json.dumps(entry, ensure_ascii=False) + "\n")


def _left(path: Path) -> Iterator[Kept]:
    """Sentences of a journal that were accepted and not ended, in their order."""
    kept: dict[int, Kept] = {}
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines() if path.exists() else []
    for line in lines:
        try:
            entry = json.loads(line)
            if "accepted" in entry:
                sentence = _sentence(entry["sentence"])
                kept[entry["accepted"]] = Kept(sentence, float(entry["time"]), int(entry["attempts"]))
            elif "begun" in entry:
                before = kept[entry["begun"]]
                kept[entry["begun"]] = before._replace(attempts=before.attempts + 1)
            else:
                kept.pop(entry["ended"], None)
        except (ValueError, KeyError, TypeError):
            continue  # torn, or of another version: the others still count
    yield from kept.values()


def _sentence(entry: dict[str, Any]) -> Sentence:
    tokens = tuple(
        Token(**{**token, "kind": Kind(token["kind"]), "source_words": tuple(token["source_words"])})
        for token in entry.pop("tokens")
    )
    form = entry.pop("form")
    form = SentenceForm(type=SentenceType(form["type"]), negated=form["negated"])
    return Sentence(tokens=tokens, form=form, **entry)
