# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The reviews in one SQLite file: reviewers, series of items, what each understood, and how each rated."""

from __future__ import annotations

import datetime
import secrets
import sqlite3
import unicodedata
from collections.abc import Sequence
from pathlib import Path

import msgspec

from teo_common.text_folding import folded
from teo_console.errors import ConsoleError
from teo_console.protocol import Motion
from teo_console.review.series import (
    Answer,
    Flag,
    ItemKind,
    NewItem,
    Rating,
    SeriesKind,
    blind_order,
)

# Version of the tables below; a file of a later one is not touched.
_SCHEMA_VERSION = 1
# Longest name, answer and comment [characters]: a line, a sentence, a paragraph.
NAME_LENGTH, ANSWER_LENGTH, COMMENT_LENGTH = 60, 200, 2000
# Most items of a series: an afternoon.
_MOST_ITEMS = 200
# How long to wait for another program that writes the file [s].
_BUSY = 5.0

_TABLES = """
CREATE TABLE reviewer (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, created TEXT NOT NULL);
CREATE TABLE series (
    id TEXT PRIMARY KEY, kind TEXT NOT NULL CHECK (kind IN ('review', 'comprehension')), title TEXT NOT NULL,
    seed INTEGER NOT NULL, created TEXT NOT NULL
);
CREATE TABLE item (
    id TEXT PRIMARY KEY, series TEXT NOT NULL REFERENCES series (id), place INTEGER NOT NULL,
    kind TEXT NOT NULL CHECK (kind IN ('sign', 'sentence')), meaning TEXT NOT NULL, language TEXT NOT NULL,
    motion_hash TEXT NOT NULL, motion BLOB NOT NULL, choices TEXT NOT NULL
);
CREATE TABLE answer (
    item TEXT NOT NULL REFERENCES item (id), reviewer INTEGER NOT NULL REFERENCES reviewer (id),
    understood TEXT NOT NULL, recognised INTEGER NOT NULL, at TEXT NOT NULL, PRIMARY KEY (item, reviewer)
);
CREATE TABLE rating (
    item TEXT NOT NULL, reviewer INTEGER NOT NULL,
    rating TEXT NOT NULL CHECK (rating IN ('right', 'understandable', 'wrong')), flags TEXT NOT NULL,
    comment TEXT NOT NULL, at TEXT NOT NULL, PRIMARY KEY (item, reviewer),
    FOREIGN KEY (item, reviewer) REFERENCES answer (item, reviewer)
);
"""


class Series(msgspec.Struct, frozen=True, kw_only=True):
    """A series by its name, and how much of it one reviewer has done."""

    id: str
    kind: SeriesKind
    title: str
    created: str
    items: int
    reviewers: int
    """How many have answered something."""


class Question(msgspec.Struct, frozen=True, kw_only=True):
    """What a reviewer is asked next. What the item means is not in it until the answer is given."""

    item: str
    place: int
    """From 1."""
    items: int
    kind: ItemKind
    motion: Motion
    choices: tuple[str, ...]
    understood: str | None = None
    """What the reviewer has said; None before that."""
    meaning: str | None = None
    """What it means; None before that, and always in a comprehension test."""


class ReviewStore:
    """The file. Methods are called from one thread."""

    def __init__(self, path: Path) -> None:
        """Open the file, or make it.

        Raises:
            ConsoleError: "bad_reviews": it is no such file, or of a later version.
            OSError: Its folder cannot be made.
        """
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            self._database = sqlite3.connect(path, timeout=_BUSY, isolation_level=None)
            self._database.execute("PRAGMA foreign_keys = ON")
            (version,) = self._database.execute("PRAGMA user_version").fetchone()
            if version == 0:
                self._database.executescript(
                    f"BEGIN;{_TABLES}PRAGMA user_version = {_SCHEMA_VERSION};COMMIT;"
                )
        except sqlite3.Error as error:
            raise ConsoleError("bad_reviews", f"{path}: expected a file of reviews, got: {error}") from error
        if version > _SCHEMA_VERSION:
            self._database.close()
            raise ConsoleError(
                "bad_reviews",
                f"{path}: expected reviews of version {_SCHEMA_VERSION}, got {version}: use a newer console",
            )

    def close(self) -> None:
        """Close the file."""
        self._database.close()

    def reviewer(self, name: str) -> int:
        """The number of the reviewer of that name, who is made if there is none.

        Raises:
            ConsoleError: "bad_name".
        """
        name = " ".join(unicodedata.normalize("NFC", name).split())
        if not 1 <= len(name) <= NAME_LENGTH or not name.isprintable():
            raise ConsoleError(
                "bad_name", f"expected a name of 1 to {NAME_LENGTH} characters, got {len(name)}"
            )
        self._do("INSERT OR IGNORE INTO reviewer (name, created) VALUES (?, ?)", name, _now())
        ((number,),) = self._all("SELECT id FROM reviewer WHERE name = ?", name)
        return int(number)

    def add_series(self, kind: SeriesKind, title: str, items: Sequence[NewItem], seed: int) -> str:
        """Enter a series, whole or not at all, and return its name, which cannot be guessed.

        Raises:
            ConsoleError: "bad_series": no items, or too many.
        """
        if not 1 <= len(items) <= _MOST_ITEMS:
            raise ConsoleError("bad_series", f"expected 1 to {_MOST_ITEMS} items, got {len(items)}")
        series = secrets.token_urlsafe(9)
        rows = [
            (
                secrets.token_urlsafe(9),
                series,
                place,
                item.kind,
                item.meaning,
                item.language,
                item.motion_hash,
                msgspec.msgpack.encode(item.motion),
                _json(item.choices),
            )
            for place, item in enumerate(items)
        ]
        with self._database:
            self._do("BEGIN")
            self._do("INSERT INTO series VALUES (?, ?, ?, ?, ?)", series, kind, title, seed, _now())
            self._database.executemany("INSERT INTO item VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", rows)
        return series

    def series(self) -> list[Series]:
        """All series, the newest first."""
        rows = self._all(
            "SELECT id, kind, title, created, (SELECT count(*) FROM item WHERE series = series.id), "
            "(SELECT count(DISTINCT reviewer) FROM answer JOIN item ON item = item.id "
            "WHERE series = series.id) "
            "FROM series ORDER BY created DESC, rowid DESC"
        )
        return [
            Series(id=name, kind=kind, title=title, created=created, items=items, reviewers=reviewers)
            for name, kind, title, created, items, reviewers in rows
        ]

    def next_question(self, series: str, reviewer: int) -> Question | None:
        """What the reviewer is to answer or to rate next; None if all is done.

        Raises:
            ConsoleError: "unknown_series".
        """
        kind, seed = self._series(series)
        items = [item for (item,) in self._all("SELECT id FROM item WHERE series = ?", series)]
        answered = dict(self._all("SELECT item, understood FROM answer WHERE reviewer = ?", reviewer))
        rated = {item for (item,) in self._all("SELECT item FROM rating WHERE reviewer = ?", reviewer)}
        done = answered.keys() if kind == "comprehension" else rated
        order = blind_order(items, reviewer, seed)
        for place, item in enumerate(order, 1):
            if item not in done:
                return self._question(item, place, len(items), answered.get(item))
        return None

    def answer(self, item: str, reviewer: int, understood: str) -> str | None:
        """Enter what a reviewer understood, which stays as it is, and return what the item means.

        Returns:
            The gloss or the text; None in a comprehension test, which does not tell.

        Raises:
            ConsoleError: "unknown_item", "answered" (already), "bad_answer" (too long, or not one of those
                offered).
        """
        kind, meaning, choices = self._item(item)
        understood = " ".join(understood.split())
        if len(understood) > ANSWER_LENGTH:
            raise ConsoleError(
                "bad_answer", f"expected at most {ANSWER_LENGTH} characters, got {len(understood)}"
            )
        if choices and understood and understood not in choices:
            raise ConsoleError(
                "bad_answer", f"expected one of {', '.join(choices)}, or nothing; got {understood!r}"
            )
        recognised = bool(understood) and folded(understood) == folded(meaning)
        try:
            self._do(
                "INSERT INTO answer VALUES (?, ?, ?, ?, ?)", item, reviewer, understood, recognised, _now()
            )
        except sqlite3.IntegrityError as error:
            raise ConsoleError("answered", "expected one answer to each item, this one has yours") from error
        return None if kind == "comprehension" else meaning

    def rate(self, item: str, reviewer: int, rating: Rating, flags: Sequence[Flag], comment: str) -> None:
        """Enter how a reviewer finds an item that they have answered; a second rating replaces the first.

        Raises:
            ConsoleError: "unknown_item", "not_answered" (first say what was understood), "bad_answer" (the
                comment is too long).
        """
        self._item(item)
        if len(comment) > COMMENT_LENGTH:
            raise ConsoleError(
                "bad_answer", f"expected at most {COMMENT_LENGTH} characters, got {len(comment)}"
            )
        try:
            self._do(
                "INSERT OR REPLACE INTO rating VALUES (?, ?, ?, ?, ?, ?)",
                item,
                reviewer,
                rating,
                _json(sorted(set(flags))),
                comment,
                _now(),
            )
        except sqlite3.IntegrityError as error:
            raise ConsoleError(
                "not_answered", "expected what was understood before the rating, got a rating alone"
            ) from error

    def answers(self, series: str | None = None) -> list[Answer]:
        """All that was said, of one series or of all, in the order in which it was."""
        rows = self._all(
            "SELECT series.id, series.kind, item.kind, item.meaning, item.language, item.motion_hash, "
            "reviewer.name, item.choices != '[]', answer.understood, answer.recognised, "
            "coalesce(rating.at, answer.at), rating.rating, coalesce(rating.flags, '[]'), "
            "coalesce(rating.comment, '') "
            "FROM answer JOIN item ON answer.item = item.id JOIN series ON item.series = series.id "
            "JOIN reviewer ON answer.reviewer = reviewer.id "
            "LEFT JOIN rating ON rating.item = answer.item AND rating.reviewer = answer.reviewer "
            "WHERE ?1 IS NULL OR series.id = ?1 ORDER BY answer.at, answer.rowid",
            series,
        )
        names = Answer.__struct_fields__
        return [
            msgspec.convert(
                dict(zip(names, (*row[:12], msgspec.json.decode(row[12]), row[13]), strict=True)),
                Answer,
                strict=False,
            )
            for row in rows
        ]

    def meanings(self, series: str) -> list[str]:
        """What the items of a series mean, in the order in which they were entered.

        Raises:
            ConsoleError: "unknown_series".
        """
        self._series(series)
        return [
            meaning
            for (meaning,) in self._all("SELECT meaning FROM item WHERE series = ? ORDER BY place", series)
        ]

    def _series(self, series: str) -> tuple[SeriesKind, int]:
        rows = self._all("SELECT kind, seed FROM series WHERE id = ?", series)
        if not rows:
            raise ConsoleError(
                "unknown_series", "expected a series of this console, it knows none of that name"
            )
        return rows[0][0], rows[0][1]

    def _item(self, item: str) -> tuple[SeriesKind, str, tuple[str, ...]]:
        rows = self._all(
            "SELECT series.kind, meaning, choices FROM item JOIN series ON series = series.id "
            "WHERE item.id = ?",
            item,
        )
        if not rows:
            raise ConsoleError("unknown_item", "expected an item of a series, it knows none of that name")
        kind, meaning, choices = rows[0]
        return kind, meaning, tuple(msgspec.json.decode(choices))

    def _question(self, item: str, place: int, items: int, understood: str | None) -> Question:
        ((kind, meaning, motion, choices),) = self._all(
            "SELECT kind, meaning, motion, choices FROM item WHERE id = ?", item
        )
        return Question(
            item=item,
            place=place,
            items=items,
            kind=kind,
            motion=msgspec.msgpack.decode(motion, type=Motion),
            choices=tuple(msgspec.json.decode(choices)),
            understood=understood,
            meaning=None if understood is None else meaning,
        )

    def _do(self, statement: str, *values: object) -> None:
        self._database.execute(statement, values)

    def _all(self, statement: str, *values: object) -> list[tuple]:  # type: ignore[type-arg]  # as SQLite has it
        return self._database.execute(statement, values).fetchall()


def _now() -> str:
    return datetime.datetime.now(datetime.UTC).isoformat(timespec="milliseconds")


def _json(value: object) -> str:
    return msgspec.json.encode(value).decode()
