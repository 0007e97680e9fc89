# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the capture of a sign ended, in words and numbers that pass between processes and programs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from teo_sign_capture.entries.bag_capture import Saved
from teo_sign_capture.entries.gates import RefusedError, Verdict
from teo_sign_capture.recognition.sign_index import SimilarSign
from teo_signs.errors import LutError
from teo_signs.sign import gloss_key

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
