# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A film of a sign from a webcam.

OpenCV opens it, which knows the cameras of Linux, macOS and Windows by their number.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from datetime import datetime
from pathlib import Path

import cv2

from teo_signs.errors import LutError
from teo_signs.sign import gloss_key

# [s] Between the start and the film: to take the hands from the keyboard to rest.
COUNTDOWN = 3


def film_name(folder: Path, gloss: str) -> Path:
    """Where the film of a sign that is made now is kept."""
    return folder / f"{gloss_key(gloss)}-{datetime.now():%Y%m%d-%H%M%S}.mp4"


def film_webcam(
    camera: int | str,
    out: Path,
    *,
    seconds: float,
    on_state: Callable[[str], None],
    countdown: int = COUNTDOWN,
) -> Path:
    """Count down, film, and write the film with the times at which its images came.

    Args:
        camera: Number of the webcam, 0 the usual one; or what else OpenCV can open.
        out: MP4 file to write; its folder is made.
        seconds: How long to film [s].
        on_state: Told "3", "2", "1", "sign now" and "done".
        countdown: [s].

    Returns:
        `out`.

    Raises:
        LutError: "no_camera" if there is none of that number or it gives no image; "not_written".
    """
    from teo_skeleton_retriever.errors import RetrieverError
    from teo_skeleton_retriever.output.overlay import overlay_video

    # A camera that is not there is said below, in one sentence.
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    opened = cv2.VideoCapture(camera)
    try:
        if not opened.isOpened():
            raise LutError(
                "no_camera",
                f"expected a webcam of number {camera}, got none that opens: plug one in, try --camera 1, "
                "or film the sign with a phone and give its film instead",
            )
        out.parent.mkdir(parents=True, exist_ok=True)
        _count_down(opened, countdown, on_state)
        on_state("sign now")
        count, begins = 0, time.monotonic()
        with overlay_video(out) as film:
            while (now := time.monotonic() - begins) < seconds:
                there, image = opened.read()
                if not there:
                    break
                film.add(cv2.cvtColor(image, cv2.COLOR_BGR2RGB), now)
                count += 1
    except (RetrieverError, OSError) as error:
        raise LutError("not_written", f"{out}: expected a place to write a film to, got: {error}") from error
    finally:
        opened.release()
    if not count:
        raise LutError(
            "no_camera", f"expected images of webcam {camera}, got none: is another program using it?"
        )
    on_state("done")
    return out


def _count_down(opened: cv2.VideoCapture, countdown: int, on_state: Callable[[str], None]) -> None:
    """Show images to nobody meanwhile: a camera finds its exposure, and keeps no old images."""
    for left in range(countdown, 0, -1):
        on_state(str(left))
        until = time.monotonic() + 1.0
        while time.monotonic() < until and opened.read()[0]:
            pass
        time.sleep(max(until - time.monotonic(), 0.0))
