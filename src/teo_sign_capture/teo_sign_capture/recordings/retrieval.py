# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Skeletons of a bag of colour and depth images, by the retriever."""

from __future__ import annotations

import functools
from pathlib import Path

from teo_sign_capture.recordings.own_process import Progress, not_retrieved, work_apart
from teo_signs.errors import LutError
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP


def retrieve_apart(
    bag: Path, out: Path, on_progress: Progress | None = None, *, slop: float = DEFAULT_SLOP
) -> tuple[str, ...]:
    """Find people in the images of a bag and write their skeletons, in a process of its own.

    Args:
        bag: The bag.
        out: MCAP file to write; its folder exists.
        on_progress: Told of the number of messages read and that of all.
        slop: Greatest difference between the stamps of colour and depth [s].

    Returns:
        What could not be used of the images, a sentence each.

    Raises:
        LutError: The code of the retriever's error ("no_depth", "no_camera_info", ...) or of what was wrong
            with all images; "not_retrieved" where there is none, or the process died.
        OSError: `out` cannot be written.
    """
    return work_apart(functools.partial(_retrieve, slop=slop), bag, out, on_progress)


def _retrieve(bag: Path, out: Path, on_progress: Progress | None, slop: float) -> tuple[str, ...]:
    # Imported here: MediaPipe and what it needs are to be loaded by the process that runs it.
    from teo_skeleton_retriever.errors import RetrieverError, TopicError
    from teo_skeleton_retriever.recording import retrieve_recording

    try:
        report = retrieve_recording(bag, out=out, slop=slop, on_progress=on_progress)
    except TopicError as error:
        option = f"--{error.argument.replace('_', '-')}"
        hint = f"if it has another name, run `retrieve {option} NAME` first"
        raise LutError(error.code, f"{bag.name}: {error.sentence}: {hint}") from None
    except RetrieverError as error:
        raise LutError(error.code, f"{bag.name}: {error.sentence}") from None
    if not report.images:
        for code, sentence in report.reasons.items():
            raise LutError(code, f"{bag.name}: {sentence}")
        raise not_retrieved(bag, report.complaints[0])
    if report.nobody:
        raise LutError("nobody_in_space", f"{bag.name}: {report.nobody}")
    return report.complaints
