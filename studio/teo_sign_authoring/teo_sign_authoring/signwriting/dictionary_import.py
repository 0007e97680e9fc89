# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A dictionary in SignWriting into the table: every sign that can be read, and why the others cannot.

Signs are made in processes of this machine, each file written whole or not at all. What the table has is
left as it is, and what a report says was refused is not tried again, so that an import that was stopped goes
on where it was.
"""

from __future__ import annotations

import functools
import json
import multiprocessing
import os
import signal
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from threading import Thread
from typing import Any, Literal

import yaml
from msgspec.structs import replace as changed
from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]  # ships no types

from teo_common.atomic_files import write_atomically
from teo_description.robot import Robot
from teo_sign_authoring.notation.score_retarget import score_sign
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_authoring.signwriting.compiler import TOUCHING, Compilation, compile_fsw
from teo_sign_authoring.signwriting.dictionary_file import DictionaryEntry, GlossNames, numbered
from teo_signs.errors import LutError
from teo_signs.look_up_table import held_entry
from teo_signs.sign import Sign
from teo_signs.sign_file import read_sign, save_sign
from teo_signs.sign_schema import STANDINGS

_WIDE = 10_000  # [characters] nothing is broken into lines


def score_text(score: Score) -> str:
    """The text of a compiled score, a lexical one without forms, which `read_score` reads."""
    content = score.model_dump(exclude_none=True, exclude_defaults=True)
    lines = [f"{name}: {_flow(content[name])}" for name in ("gloss", "standing", "source", "hands")]
    lines += [f"{name}: {_flow(content[name])}" for name in ("face", "notes") if content.get(name)]
    lines.append("steps:")
    for step in content["steps"]:
        fields = {name: step[name] for name in _ORDER if name in step}
        if not fields:
            continue
        for index, (name, value) in enumerate(fields.items()):
            lines.append(f"  {'- ' if index == 0 else '  '}{name}: {_flow(value)}")
    return "\n".join(lines) + "\n"


_ORDER = ("time", "left", "right", "arc", "circle", "wiggle", "head", "hold")


def _flow(value: Any) -> str:
    text: str = yaml.safe_dump(
        value, default_flow_style=True, allow_unicode=True, width=_WIDE, sort_keys=False
    )
    return text.removesuffix("\n").removesuffix("\n...").strip()


# [cm] Hands stay so far off what they touch where TEO would otherwise run into itself: its wrists are wide.
_GAPS = (TOUCHING, 4.0, 8.0)
# [mm] A hand farther from its place is somewhere else: TEO's chin and mouth are 28 mm apart, its chest 100
# mm wide.
_MOST_OFF_PLACE = 120.0

Result = Literal["whole", "with_losses", "as_before", "refused", "skipped"]
# What says nothing of the sign: it is tried again.
_PASSING = frozenset({"crashed", "not_written"})


@dataclass(frozen=True, kw_only=True)
class ImportSettings:
    """How a dictionary is imported.

    Attributes:
        table: Directory of the table.
        holding: The directories whose entries it holds.
        language: Code of the language whose signs they are.
        scores: Directory for the scores as well; None for none.
        replace: Whether entries that are there are made anew, unless they are better founded.
        source: What the entries name as their source, before the term.
        licence: Terms of the dictionary.
    """

    table: Path
    holding: tuple[Path, ...]
    language: str
    scores: Path | None
    replace: bool
    source: str
    licence: str


@dataclass(frozen=True, kw_only=True)
class ImportJob:
    """One sign to import.

    Attributes:
        entry: The dictionary's.
        gloss: Its name in the table; None if the term is no word of the language.
    """

    entry: DictionaryEntry
    gloss: str | None


@dataclass(frozen=True, kw_only=True)
class ImportOutcome:
    """How the import of one entry ended.

    Attributes:
        number: The entry's number in the file.
        term: Its term.
        fsw: The sign as it is written.
        gloss: The name in the table; empty if it got none.
        result: Whether it was written.
        code: Why it was refused or skipped; empty if it was neither.
        message: What is lost, or why it was refused or skipped; empty if nothing is.
    """

    number: int
    term: str
    fsw: str
    gloss: str
    result: Result
    code: str = ""
    message: str = ""


def find_jobs(entries: Sequence[DictionaryEntry], names: GlossNames, only: Sequence[str]) -> list[ImportJob]:
    """Every entry with its gloss.

    Args:
        entries: Of the dictionary.
        names: Gives terms their glosses.
        only: Glosses that are wanted, with their variants' numbers; all if empty.

    Raises:
        LutError: "unknown_sign" if one that is wanted is not there.
    """
    glosses = numbered([names.gloss(entry.term) for entry in entries])
    jobs = [ImportJob(entry=entry, gloss=gloss) for entry, gloss in zip(entries, glosses, strict=True)]
    unknown = sorted(set(only) - set(glosses))
    if unknown:
        raise LutError(
            "unknown_sign", f"expected glosses of the dictionary's terms, got {', '.join(unknown)}"
        )
    return [job for job in jobs if not only or job.gloss in only]


def run_import(
    jobs: Sequence[ImportJob],
    settings: ImportSettings,
    workers: int,
    on_done: Callable[[ImportOutcome], None],
) -> list[ImportOutcome]:
    """Import signs; one that fails stops no other.

    Returns:
        The outcomes, in the order of the file.
    """
    outcomes: list[ImportOutcome] = []
    if workers == 1:
        for job in jobs:
            outcomes.append(_import_entry(job, settings))
            on_done(outcomes[-1])
        return outcomes
    context = multiprocessing.get_context("spawn")  # a fork would take over locks of whatever runs here
    with ProcessPoolExecutor(workers, mp_context=context, initializer=_begin_work) as pool:
        futures = {pool.submit(_import_entry, job, settings): job for job in jobs}
        try:
            for future in as_completed(futures):
                try:
                    outcome = future.result()
                except Exception as error:  # the process died: out of memory, or killed
                    message = f"expected a process that ends well, got {type(error).__name__} {error}"
                    outcome = _outcome(futures[future], "refused", message, "crashed")
                outcomes.append(outcome)
                on_done(outcome)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return sorted(outcomes, key=lambda outcome: outcome.number)


def _begin_work() -> None:
    """Prepare a process: one thread, Ctrl-C is the import's to hear, and it does not outlive the import."""
    threadpool_limits(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    importing = multiprocessing.parent_process()
    assert importing is not None

    def end_with_it() -> None:
        importing.join()
        os._exit(1)

    Thread(target=end_with_it, daemon=True).start()


def _import_entry(job: ImportJob, settings: ImportSettings) -> ImportOutcome:
    """Import one sign, in whatever process this is."""
    if job.gloss is None:
        return _outcome(job, "skipped", f"expected a known word, got {job.entry.term!r}", "unknown_term")
    if not job.entry.fsw:
        message = "expected a sign in Formal SignWriting, got an entry without one"
        return _outcome(job, "skipped", message, "no_sign")
    try:
        kept = _kept(job.gloss, settings)
        if kept:
            return _outcome(job, "as_before", kept)
        compilation, sign = _made(job, job.gloss, settings)
        if settings.scores is not None:
            settings.scores.mkdir(parents=True, exist_ok=True)
            write_atomically(settings.scores / f"{job.gloss}.yaml", score_text(compilation.score).encode())
        save_sign(settings.table, sign, replace=settings.replace)
    except LutError as error:
        return _outcome(job, "refused", str(error), error.code)
    except OSError as error:
        return _outcome(job, "refused", f"expected a place to write to, got: {error}", "not_written")
    except Exception as error:  # a mistake of ours in one of thousands is no reason to lose the others
        return _outcome(job, "refused", f"{type(error).__name__}: {error}", "crashed")
    return _outcome(job, "with_losses" if compilation.losses else "whole", "; ".join(compilation.losses))


def _made(job: ImportJob, gloss: str, settings: ImportSettings) -> tuple[Compilation, Sign]:
    """The score and the sign, with hands as near to what they touch as TEO can hold them.

    Raises:
        LutError: Why it cannot be made.
    """
    refused: tuple[Score, LutError] | None = None
    for gap in _GAPS:
        compilation = compile_fsw(
            gloss, job.entry.fsw, source=f'{settings.source}, entry "{job.entry.term}"', gap=gap
        )
        if refused is not None and compilation.score.steps == refused[0].steps:
            raise refused[1]  # hands that touch nothing are as they were
        try:
            sign = score_sign(_robot(), compilation.score, language=settings.language)
        except LutError as error:
            if error.code == "self_collision" and gap != _GAPS[-1]:
                refused = compilation.score, error
                continue
            raise
        off = sign.quality["place_error_mm"]
        if off > _MOST_OFF_PLACE:
            raise LutError(
                "off_place",
                f"{gloss}: expected a hand at most {_MOST_OFF_PLACE / 10.0:.0f} cm from its place, got "
                f"{off / 10.0:.0f} cm",
            )
        provenance = changed(sign.provenance, licence=settings.licence, notes="; ".join(compilation.losses))
        return compilation, replace(sign, provenance=provenance)
    raise AssertionError("the last gap returns or raises")


def _kept(gloss: str, settings: ImportSettings) -> str:
    """Why the entry that is there stays; empty if there is none, or it is to be replaced."""
    path = held_entry(settings.holding, gloss)
    if path is None:
        return ""
    if not settings.replace:
        return "the table has it"
    standing = read_sign(path).provenance.standing
    if STANDINGS.index(standing) < STANDINGS.index("described"):
        return f"the table has it better founded: {standing}"
    return ""


def _outcome(job: ImportJob, result: Result, message: str, code: str = "") -> ImportOutcome:
    return ImportOutcome(
        number=job.entry.number,
        term=job.entry.term,
        fsw=job.entry.fsw,
        gloss=job.gloss or "",
        result=result,
        code=code,
        message=message,
    )


@functools.cache
def _robot() -> Robot:
    """One for each process: loading it takes longer than a sign."""
    return Robot.load()


def write_report(path: Path, outcomes: Sequence[ImportOutcome]) -> None:
    """Write what became of entries, whole or not at all, as a list of JSON objects.

    Raises:
        LutError: "not_written".
    """
    text = json.dumps([asdict(outcome) for outcome in outcomes], ensure_ascii=False, indent=1) + "\n"
    try:
        write_atomically(path, text.encode())
    except OSError as error:
        raise LutError("not_written", f"--report: expected a place to write to, got: {error}") from error


def known_outcomes(
    path: Path, jobs: Sequence[ImportJob], settings: ImportSettings
) -> dict[int, ImportOutcome]:
    """What a report of before says of entries that are as they were, by number: made and there, or refused.

    Raises:
        LutError: "bad_report" if the file is none.
    """
    if not path.exists() or settings.replace:
        return {}
    try:
        told = [ImportOutcome(**each) for each in json.loads(path.read_bytes())]
    except (OSError, ValueError, TypeError) as error:
        raise LutError(
            "bad_report", f"--report: expected a report of an import, or no file, got {path.name}: {error}"
        ) from error
    written = {job.entry.number: (job.entry.term, job.entry.fsw, job.gloss or "") for job in jobs}
    return {
        outcome.number: outcome
        for outcome in told
        if written.get(outcome.number) == (outcome.term, outcome.fsw, outcome.gloss)
        and outcome.code not in _PASSING
        and (outcome.code or held_entry(settings.holding, outcome.gloss) is not None)
    }
