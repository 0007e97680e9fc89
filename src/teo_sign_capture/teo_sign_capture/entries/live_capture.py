# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A recording of live skeletons as a bag, and from there as any other."""

from __future__ import annotations

import datetime
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from teo_description.robot import Robot
from teo_sign_capture.entries.bag_capture import Job, Saved, Settings, capture_bags
from teo_sign_capture.recordings.recording import default_cache
from teo_signs.errors import LutError
from teo_signs.sign import gloss_key


def keep_and_capture(
    robot: Robot, gloss: str, messages: Sequence[Any], recordings: Path, settings: Settings
) -> Saved:
    """Write a recording beside the others, then capture it.

    A recording that is no good is kept as well: it shows what went wrong.

    Args:
        robot: The robot.
        gloss: Name of the sign.
        messages: `SkeletonArray` of the recording, in order.
        recordings: Directory of recordings.
        settings: Of the capture.

    Raises:
        LutError: "not_written", or what `capture_bags` raises.
    """
    now = datetime.datetime.now().strftime("%Y%m%dT%H%M%S")
    path = recordings / f"{gloss_key(gloss)}-{now}.mcap"
    try:
        recordings.mkdir(parents=True, exist_ok=True)
        write_skeletons(path, messages)
    except OSError as error:
        raise LutError(
            "not_written", f"{recordings}: expected a directory to write to, got: {error}"
        ) from error
    return capture_bags(robot, Job(gloss=gloss, bags=(path,)), settings)


def default_recordings() -> Path:
    """Where recordings are kept if nobody says otherwise."""
    return default_cache().parent / "recordings"


def write_skeletons(path: Path, messages: Sequence[Any]) -> None:
    """Write `SkeletonArray` messages as a bag, whole or not at all."""
    from teo_skeleton_retriever.output.skeleton_bag import skeleton_bag

    with skeleton_bag(path) as bag:
        for message in messages:
            stamp = message.header.stamp
            bag.write(message, stamp.sec * 1_000_000_000 + stamp.nanosec)
