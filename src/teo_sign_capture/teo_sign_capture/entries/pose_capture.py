# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a `.pose` file to an entry of the table."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from pathlib import Path

from teo_description.robot import Robot
from teo_sign_capture.entries.bag_capture import DIGEST, Job, Saved, Settings, check_free, save_captured
from teo_sign_capture.entries.capture_picture import save_capture_picture
from teo_sign_capture.entries.sign_entry import Origin, make_sign
from teo_sign_capture.entries.similar_signs import similar_sign_warnings
from teo_sign_capture.entries.take import capture_take
from teo_sign_capture.lifting.clip import lift_clip
from teo_sign_capture.recordings.pose_file import read_pose_file

# Said in the notes of every entry.
LIFTED = (
    "Lifted from a clip that one camera took: what is forward follows from the lengths of limbs and bones, "
    "and the errors given are against that."
)


def capture_pose_file(
    robot: Robot, path: Path, job: Job, settings: Settings, *, recorded: str | None = None
) -> Saved:
    """Capture a sign from a clip and save it.

    Args:
        robot: The robot.
        path: The clip.
        job: The sign; `bags` is not looked at.
        settings: Where to and how.
        recorded: Day of the recording, YYYY-MM-DD; None if not known.

    Raises:
        LutError: "exists", "not_written", what is wrong with the file (`read_pose_file`), or why it cannot be
            captured (`capture_take`).
    """
    check_free(job.gloss, settings)
    clip = read_pose_file(path, person=job.person)
    take = capture_take(robot, lift_clip(clip, recorded=recorded), cut=job.cut, handedness=job.handedness)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:DIGEST]
    origin = Origin(
        source=f"{path.name}, sha256 {digest}, {clip.layout}",
        standing=settings.standing or "recorded",
        licence=settings.licence,
        notes=" ".join(filter(None, (settings.notes, LIFTED))),
    )
    captured = make_sign(robot, job.gloss, [take], origin, kind=settings.kind, accept=settings.accept)
    similar = similar_sign_warnings(robot, captured.sign, settings.table)
    path_saved = save_captured(captured, settings)
    saved = Saved(captured=captured, path=path_saved, picture=None, warnings=similar)
    if settings.pictures is None:
        return saved
    picture = settings.pictures / f"{captured.sign.gloss}.png"
    try:
        settings.pictures.mkdir(parents=True, exist_ok=True)
        save_capture_picture(picture, captured, None, settings.cache)
    except OSError as error:
        return replace(
            saved,
            warnings=(
                *similar,
                f"{picture}: not drawn: {error}",
            ),
        )
    return replace(saved, picture=picture)
