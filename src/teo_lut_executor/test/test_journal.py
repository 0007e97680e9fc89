# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import resource
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from teo_lut_executor.execution.interface import Sentence
from teo_lut_executor.execution.journal import Journal, Kept, MessageKey
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_signs.tokens import parse_printed

QUESTION = SentenceForm(type=SentenceType.YES_NO_QUESTION, negated=True)


def sentence(text: str) -> Sentence:
    return Sentence(
        tokens=parse_printed(text), utterance_id=text, index=1, count=2, form=QUESTION, text=f"¿{text}?"
    )


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "folder" / "executor.jsonl"


def begun(path: Path) -> Journal:
    """A journal in place of the one before."""
    journal = Journal(path)
    journal.begin()
    return journal


def test_what_was_accepted_and_not_ended_is_left_with_every_field(path: Path) -> None:
    journal = begun(path)
    assert journal.left == ()
    for ticket, text in enumerate(("TÚ", "A-N _ 352", "AYUDAR[2>1]")):
        journal.accepted(ticket, sentence(text), 10.0 + ticket)
    journal.begun(0)
    journal.ended(0)
    journal.begun(1)
    journal.close()
    assert Journal(path).left == (
        Kept(sentence("A-N _ 352"), 11.0, 1),
        Kept(sentence("AYUDAR[2>1]"), 12.0, 0),
    )


def test_a_torn_last_line_costs_that_line_alone(path: Path) -> None:
    journal = begun(path)
    journal.accepted(1, sentence("TÚ"), 1.0)
    journal.accepted(2, sentence("A"), 2.0)
    journal.close()
    path.write_bytes(path.read_bytes()[:-20])
    assert [kept.sentence.utterance_id for kept in Journal(path).left] == ["TÚ"]


def test_what_is_taken_over_is_not_left_twice_nor_lost_if_it_is_not_taken_over(path: Path) -> None:
    first = begun(path)
    first.accepted(1, sentence("TÚ"), 1.0)
    first.close()
    Journal(path).close()  # killed before it had taken over
    second = begun(path)
    second.close()
    assert len(second.left) == 1 and Journal(path).left == ()


def test_a_message_is_known_after_a_restart_whether_it_was_accepted_or_refused(path: Path) -> None:
    first = begun(path)
    accepted, refused, other = (MessageKey(1700000000123456789, "text", index) for index in range(3))
    first.accepted(1, sentence("TÚ"), 1.0, message=accepted)
    first.ended(1)
    first.refused(refused)
    first.close()
    for _ in range(2):  # by the next executor, and by the one after that
        journal = begun(path)
        assert [journal.knows(key) for key in (accepted, refused, other)] == [True, True, False]
        assert journal.left == ()
        journal.close()


def test_the_latest_thousand_messages_are_known(path: Path) -> None:
    journal = begun(path)
    for time in range(1001):
        journal.refused(MessageKey(time, "text", 0))
    journal.close()
    again = Journal(path)
    assert [again.knows(MessageKey(time, "text", 0)) for time in (0, 1, 1000)] == [False, True, True]
    again.close()


def test_two_executors_do_not_share_a_journal(path: Path) -> None:
    journal = Journal(path)
    with pytest.raises(BlockingIOError):
        Journal(path)
    journal.close()


@contextmanager
def full_disk(size: int) -> Iterator[None]:
    """Files of this process grow to this size [bytes] and no further."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def test_what_a_full_disk_does_not_take_is_known_told_and_written_when_it_does(path: Path) -> None:
    journal = begun(path)
    message = MessageKey(1, "text", 0)
    journal.accepted(1, sentence("A"), 1.0)
    with full_disk(path.stat().st_size + 40):  # a part of the next line
        journal.accepted(2, sentence("TÚ"), 2.0, message=message)
        journal.ended(1)
        assert "large" in journal.problem and journal.knows(message)
    journal.begun(2)
    assert journal.problem == ""
    journal.close()
    assert Journal(path).left == (Kept(sentence("TÚ"), 2.0, 1),)


def test_the_journal_of_before_is_known_and_stays_while_a_full_disk_takes_no_other(path: Path) -> None:
    first = begun(path)
    message = MessageKey(1, "text", 0)
    first.accepted(1, sentence("TÚ"), 1.0, message=message)
    first.close()
    with full_disk(0):
        second = begun(path)
        second.accepted(2, sentence("A"), 2.0)
        assert second.kept and second.problem and second.knows(message)
        second.close()
    assert [kept.sentence.utterance_id for kept in Journal(path).left] == ["TÚ"]


def test_a_journal_whose_folder_cannot_be_made_is_kept_in_memory(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    journal = begun(tmp_path / "file" / "executor.jsonl")
    journal.accepted(1, sentence("TÚ"), 1.0, message=MessageKey(1, "text", 0))
    assert journal.kept and journal.problem and journal.knows(MessageKey(1, "text", 0))


def test_spoilt_lines_are_counted_and_their_journal_set_aside(path: Path) -> None:
    journal = begun(path)
    for ticket, text in enumerate(("TÚ", "A", "N")):
        journal.accepted(ticket, sentence(text), 1.0)
    journal.close()
    spoilt = path.read_bytes().replace(b'"utterance_id": "A"', b'"utterance_id": 123')
    path.write_bytes(spoilt)
    journal = begun(path)
    assert [kept.sentence.utterance_id for kept in journal.left] == ["TÚ", "N"]
    assert journal.unread == 1
    assert path.with_suffix(".spoilt").read_bytes() == spoilt
    journal.close()
    assert Journal(path).unread == 0
