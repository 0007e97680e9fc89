# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From recordings to an entry of the table: what commands, batch, live capture and node do."""

from __future__ import annotations

import datetime
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]  # ships no types

from teo_description.humanoid import DEFAULT_ROBOT
from teo_description.robot import Robot
from teo_sign_capture.entries.capture_picture import save_capture_film, save_capture_picture
from teo_sign_capture.entries.gates import RefusedError, Verdict
from teo_sign_capture.entries.sign_entry import Captured, Origin, make_sign
from teo_sign_capture.entries.take import Cut, SignTake, capture_take
from teo_sign_capture.recognition import SimilarSign, similar_signs
from teo_sign_capture.recordings.recording import (
    Recording,
    default_cache,
    open_recording,
    track_of,
)
from teo_sign_capture.recordings.skeleton_bag import write_skeletons
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.look_up_table import held_entry, holding_tables
from teo_signs.sign import gloss_key
from teo_signs.sign_file import read_sign, save_sign
from teo_signs.sign_schema import Handedness, Kind, Standing, check_gloss
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP

# Hexadecimal digits of SHA-256 that tell one recording from another.
_DIGEST = 16
_SOURCE = re.compile(r"sha256 ([0-9a-f]{16})(, cut \S+ to \S+ s)?")

# Said in the notes of every entry that one camera without depth took.
LIFTED = (
    "Lifted from a clip that one camera took: what is forward follows from the lengths of limbs and bones, "
    "and the errors given are against that."
)

# Told what is done, how much of it, of how much.
_StageProgress = Callable[[str, int, int], None]


@dataclass(frozen=True, kw_only=True)
class CaptureJob:
    """One sign to capture.

    Attributes:
        gloss: Its name.
        bags: Recordings of it, a take each.
        cut: The part of each recording to look at.
        handedness: Hands that make it; those that leave rest without.
        person: Id of the person; None for the signer.
    """

    gloss: str
    bags: tuple[Path, ...]
    cut: Cut = field(default_factory=Cut)
    handedness: Handedness | None = None
    person: int | None = None


@dataclass(frozen=True, kw_only=True)
class Settings:
    """What all captures of a run share.

    Attributes:
        table: Directory of the table.
        robot: Name of the robot whose table it is.
        language: Code of the sign language whose table it is.
        replace: Whether entries that are there already may be replaced.
        kind: Of the signs.
        standing: How well founded the forms are; None for "recorded", or "sketched" of what a program drew.
        licence: Terms of the recordings.
        notes: For every entry.
        accept: Whether signs beyond a gate are taken all the same, one level less well founded.
        recorded: Day of the recording of videos and clips, YYYY-MM-DD; None if not known. Bags know it.
        topic: Topic of the skeletons; None finds it.
        slop: Greatest difference between the stamps of colour and depth, where skeletons are made of images
            [s].
        cache: Directory of skeletons found in images.
        pictures: Directory of the pictures; None makes none.
        film: Whether a film is made beside each picture.
        trial: Directory that entries go to instead of the table, which stays as it is: to look at first.
    """

    table: Path
    robot: str = DEFAULT_ROBOT
    language: str = DEFAULT_LANGUAGE
    replace: bool = False
    kind: Kind = "lexical"
    standing: Standing | None = None
    licence: str = "not stated: ask the person who signs before passing it on"
    notes: str = ""
    accept: bool = False
    recorded: str | None = None
    topic: str | None = None
    slop: float = DEFAULT_SLOP
    cache: Path = field(default_factory=default_cache)
    pictures: Path | None = None
    film: bool = False
    trial: Path | None = None


@dataclass(frozen=True, kw_only=True)
class Saved:
    """What a capture left behind.

    Attributes:
        captured: The sign.
        path: Its entry.
        pictures: Demonstration and robot side by side, drawn and filmed, as far as asked for.
        similar: The signs of the table that look most like it.
        warnings: What could not be used, and which sign it may be confused with, a sentence each.
    """

    captured: Captured
    path: Path
    pictures: tuple[Path, ...]
    similar: tuple[SimilarSign, ...]
    warnings: tuple[str, ...]


def capture_bags(
    robot: Robot, job: CaptureJob, settings: Settings, on_progress: _StageProgress | None = None
) -> Saved:
    """Capture a sign from its takes and save it.

    Raises:
        LutError: "exists", "not_written", or why a recording is no good. Of several takes, those that are no
            good are left out, with the reason in the entry's notes.
    """
    check_free(job.gloss, settings)
    # The matrices are small: threads of linear algebra, one for each core in each process, only wait for each
    # other, on a busy machine for minutes.
    with threadpool_limits(1):
        return _captured(robot, job, settings, on_progress)


def _captured(robot: Robot, job: CaptureJob, settings: Settings, on_progress: _StageProgress | None) -> Saved:
    recordings = [open_recording(bag, slop=settings.slop) for bag in job.bags]
    takes: list[SignTake] = []
    warnings: list[str] = []
    failed: list[LutError] = []
    tell = on_progress or (lambda *_: None)
    for number, recording in enumerate(recordings):

        def told(done: int, total: int, name: str = recording.name) -> None:
            tell(f"looking for keypoints in {name}", done, total)

        try:
            track, found = track_of(
                recording,
                cache=settings.cache,
                topic=settings.topic,
                person=job.person,
                recorded=settings.recorded,
                on_progress=told,
            )
            warnings += found
            tell(f"bringing {recording.name} onto {robot.humanoid.name.upper()}", number, len(recordings))
            takes.append(
                capture_take(robot, track, cut=job.cut, handedness=job.handedness, kind=settings.kind)
            )
        except LutError as error:
            failed.append(error)
    if not takes:
        raise failed[0]
    left_out = [f"Left out: {error.code}: {error}" for error in failed]
    origin = _origin(job, settings, recordings, left_out)
    tell("checking", 0, 1)
    captured = make_sign(
        robot,
        job.gloss,
        takes,
        origin,
        language=settings.language,
        kind=settings.kind,
        accept=settings.accept,
    )
    similar = similar_signs(robot, captured.sign, settings.table)
    alike = filter(None, (one.warning(captured.sign.gloss) for one in similar))
    saved = Saved(
        captured=captured,
        path=_save_captured(captured, settings),
        pictures=(),
        similar=similar,
        warnings=(*warnings, *left_out, *alike),
    )
    if settings.pictures is None:
        return saved
    tell("drawing", 0, 1)
    return _with_picture(saved, recordings, settings)


def is_captured(job: CaptureJob, table: Path) -> bool:
    """Whether the table's entry was made from these very recordings, cut like this."""
    path = table / f"{gloss_key(job.gloss)}.json"
    if not path.is_file():
        return False
    try:
        source = read_sign(path).provenance.source
        wanted = [_named(recording, job.cut) for recording in map(open_recording, job.bags)]
    except LutError:
        return False
    return _SOURCE.findall(source) == _SOURCE.findall("; ".join(wanted))


def check_free(gloss: str, settings: Settings) -> None:
    """Say that a gloss is taken, or none, before minutes are spent on it.

    Raises:
        LutError: "exists", "bad_gloss", or "not_written" if the table cannot be looked at.
    """
    try:
        check_gloss(gloss_key(gloss))
    except ValueError as error:
        raise LutError("bad_gloss", f"--gloss: expected {error}, got {gloss!r}") from error
    try:
        taken = held_entry(
            holding_tables(settings.table, language=settings.language, robot=settings.robot), gloss
        )
    except LutError as error:
        raise LutError("not_written", f"expected a place to write to, got: {error}") from error
    if taken is not None and not settings.replace and settings.trial is None:
        raise LutError(
            "exists",
            f"{taken.name}: expected a gloss that {taken.parent} does not hold, got {gloss!r}: --replace "
            "takes its place",
        )


def _origin(
    job: CaptureJob, settings: Settings, recordings: Sequence[Recording], left_out: Sequence[str]
) -> Origin:
    rendered = any(recording.rendered for recording in recordings)
    flat = any(recording.is_flat for recording in recordings)
    return Origin(
        source="; ".join(_named(recording, job.cut) for recording in recordings),
        standing=settings.standing or ("sketched" if rendered else "recorded"),
        licence=settings.licence,
        notes=" ".join(filter(None, (settings.notes, *left_out, LIFTED if flat else ""))),
    )


def _named(recording: Recording, cut: Cut) -> str:
    name = f"{recording.name}, sha256 {recording.digest[:_DIGEST]}"
    if cut == Cut():
        return name
    ends = (
        "beginning" if cut.start is None else f"{cut.start:g}",
        "end" if cut.end is None else f"{cut.end:g}",
    )
    return f"{name}, cut {ends[0]} to {ends[1]} s"


def _save_captured(captured: Captured, settings: Settings) -> Path:
    """Write the entry, and return where it is."""
    directory = settings.trial or settings.table
    replace_there = settings.replace or settings.trial is not None
    try:
        return save_sign(directory, captured.sign, replace=replace_there)
    except OSError as error:
        raise LutError(
            "not_written", f"{directory}: expected a directory to write to, got: {error}"
        ) from error


def _with_picture(saved: Saved, recordings: Sequence[Recording], settings: Settings) -> Saved:
    """Draw; an entry that is saved is not lost with its picture."""
    assert settings.pictures is not None
    captured = saved.captured
    recording = next(one for one in recordings if one.name == captured.take.source)
    picture = settings.pictures / f"{captured.sign.gloss}.png"
    try:
        settings.pictures.mkdir(parents=True, exist_ok=True)
        save_capture_picture(picture, captured, recording, settings.cache)
        saved = replace(saved, pictures=(picture,))
        if settings.film:
            film = picture.with_suffix(".mp4")
            save_capture_film(film, captured, recording, settings.cache)
            saved = replace(saved, pictures=(picture, film))
    except OSError as error:
        return replace(saved, warnings=(*saved.warnings, f"{picture}: not drawn: {error}"))
    return saved


def keep_and_capture(
    robot: Robot, gloss: str, messages: Sequence[Any], recordings: Path, settings: Settings
) -> Saved:
    """Write a recording beside the others, then capture it.

    The messages are `SkeletonArray` in order, `recordings` is the directory of recordings. A recording that
    is no good is kept as well: it shows what went wrong.

    Raises:
        LutError: "not_written", or what `capture_bags` raises.
    """
    path = recordings / f"{gloss_key(gloss)}-{datetime.datetime.now():%Y%m%dT%H%M%S}.mcap"
    try:
        recordings.mkdir(parents=True, exist_ok=True)
        write_skeletons(path, messages)
    except OSError as error:
        raise LutError(
            "not_written", f"{recordings}: expected a directory to write to, got: {error}"
        ) from error
    return capture_bags(robot, CaptureJob(gloss=gloss, bags=(path,)), settings)


def default_recordings() -> Path:
    """Where recordings are kept if nobody says otherwise."""
    return default_cache().parent / "recordings"


CAPTURED, UNCHANGED, CRASHED = "captured", "unchanged", "crashed"


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """How the capture of one sign ended. `lut capture --json` prints these fields under these names.

    Attributes:
        gloss: The sign; empty where it never came to one.
        code: "captured", "unchanged", or why it failed.
        message: A sentence.
        recording: The take that leads; empty without an entry, as for the fields below.
        handedness: Hands that make the sign.
        stroke: Where the sign begins and ends in that recording [s].
        knots_count: Knots of the entry.
        standing: How well founded it is.
        quality: The entry's figures, each with its unit in its name.
        gates: How the sign stands at every gate; also of one that a gate refused.
        similar: The signs of the table that look most like it, the most alike first.
        notes: What a reader of the entry must know.
        warnings: What could not be used, and which sign it may be confused with, a sentence each.
        files: What was written: the entry first, then picture and film.
    """

    gloss: str
    code: str
    message: str
    recording: str = ""
    handedness: str = ""
    stroke: tuple[float, float] | None = None
    knots_count: int = 0
    standing: str = ""
    quality: Mapping[str, float] = field(default_factory=dict)
    gates: tuple[Verdict, ...] = ()
    similar: tuple[SimilarSign, ...] = ()
    notes: str = ""
    warnings: tuple[str, ...] = ()
    files: tuple[str, ...] = ()

    @property
    def failed(self) -> bool:
        """Whether there is no good entry now."""
        return self.code not in (CAPTURED, UNCHANGED)


def captured_outcome(saved: Saved) -> Outcome:
    """The outcome of a capture that left an entry."""
    sign, take = saved.captured.sign, saved.captured.take
    span = take.span
    return Outcome(
        gloss=sign.gloss,
        code=CAPTURED,
        message=f"{sign.handedness}, {sign.duration:.2f} s in {len(sign.times)} knots, from {span.start:.2f} "
        f"to {span.end:.2f} s of {take.source}",
        recording=take.source,
        handedness=sign.handedness,
        stroke=(round(span.start, 3), round(span.end, 3)),
        knots_count=len(sign.times),
        standing=sign.provenance.standing,
        quality=dict(sign.quality),
        gates=saved.captured.verdicts,
        similar=saved.similar,
        notes=sign.provenance.notes,
        warnings=saved.warnings,
        files=tuple(str(path) for path in (saved.path, *saved.pictures)),
    )


def failed_outcome(gloss: str | None, error: LutError) -> Outcome:
    """The outcome of a capture that was refused, with what the gates said where it came to them."""
    return Outcome(
        gloss=gloss_key(gloss) if gloss else "",
        code=error.code,
        message=str(error),
        gates=error.verdicts if isinstance(error, RefusedError) else (),
    )


def failures(outcomes: Iterable[Outcome]) -> list[Outcome]:
    """Those that left no good entry."""
    return [outcome for outcome in outcomes if outcome.failed]
