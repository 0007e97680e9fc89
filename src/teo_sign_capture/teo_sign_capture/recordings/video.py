# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Films: the images of a video file with their times, and a film of a sign from a webcam.

PyAV reads a video, as it gives each image the time that the file says: phones change their rate with the
light, and a sign must not change its pace with it. OpenCV opens a webcam, as it knows the cameras of Linux,
macOS and Windows by their number.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_signs.errors import LutError
from teo_signs.sign import gloss_key

Image = NDArray[np.uint8]

VIDEO_SUFFIXES = (".mp4", ".mov", ".webm", ".m4v", ".mkv", ".avi")
# [s] As much as a `.pose` file may hold at 25 images a second: a film of many signs is cut first.
LONGEST = 240.0
# [Hz] What is faster is thinned to this: the fastest shakes of hands have 5 to 7 Hz.
FASTEST = 30.0
# Titles and names beside the images say nothing of the sign, and telephones write them in any encoding:
# QuickTime's Spanish names its handlers in Mac Roman.
_METADATA_ERRORS = "replace"
# [px] Longer sides are scaled down to this: a hand then still has 100 pixels where a person fills the height.
_LONGEST_SIDE = 1280
# Share of an image's period by which it may come early and still count.
_EARLY = 0.25


class VideoImage(NamedTuple):
    """One image of a video.

    Attributes:
        time: From the first image [s].
        image: RGB, upright. Shape (height, width, 3).
    """

    time: float
    image: Image


def is_video(path: Path) -> bool:
    """Whether a path is a file as videos are."""
    return path.is_file() and path.suffix.lower() in VIDEO_SUFFIXES


def count_images(path: Path) -> int:
    """About how many images `video_images` gives; 0 where the file does not say."""
    import av

    try:
        with av.open(str(path), metadata_errors=_METADATA_ERRORS) as container:
            stream = container.streams.best("video")
            if stream is None:
                return 0
            length = float(container.duration or 0) / av.time_base
            rate = min(float(stream.average_rate or FASTEST), FASTEST)
    except (av.FFmpegError, OSError):
        return 0
    return int(length * rate)


def video_images(path: Path) -> Iterator[VideoImage]:
    """Read a video, at most `FASTEST` images a second.

    Raises:
        LutError: "unreadable_video" if it is none or damaged, "too_long" beyond `LONGEST`.
    """
    import av  # loads for half a second what only videos need

    try:
        with av.open(str(path), metadata_errors=_METADATA_ERRORS) as container:
            stream = container.streams.best("video")  # a cover is a stream of images too
            if stream is None:
                raise LutError(
                    "unreadable_video", f"{path.name}: expected a video, got a file without images"
                )
            stream.thread_type = "AUTO"
            begins, last = None, -np.inf
            for frame in container.decode(stream):
                if frame.time is None:
                    continue
                begins = frame.time if begins is None else begins
                time = frame.time - begins
                if time > LONGEST:
                    raise LutError(
                        "too_long",
                        f"{path.name}: expected a film of at most {LONGEST:g} s, got a longer one: "
                        "cut it into signs first",
                    )
                if time - last < (1.0 - _EARLY) / FASTEST:
                    continue
                last = time
                yield VideoImage(time, _upright(frame))
    except (av.FFmpegError, OSError) as error:
        raise LutError(
            "unreadable_video",
            f"{path.name}: expected a whole video ({', '.join(VIDEO_SUFFIXES)}), got one that cannot be "
            f"read: {error}",
        ) from error


def _upright(frame: object) -> Image:
    """An image as players show it: phones are held upright and note so beside the images."""
    image: Image = frame.to_ndarray(format="rgb24")  # type: ignore[attr-defined]  # PyAV's VideoFrame
    image = np.rot90(image, round(frame.rotation / 90.0) % 4)  # type: ignore[attr-defined]  # counter-clockwise
    share = _LONGEST_SIDE / max(image.shape[:2])
    if share < 1.0:
        size = (round(image.shape[1] * share), round(image.shape[0] * share))
        return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    return np.ascontiguousarray(image)


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
) -> None:
    """Count down, film, and write the film with the times at which its images came.

    Args:
        camera: Number of the webcam, 0 the usual one; or what else OpenCV can open.
        out: MP4 file to write; its folder is made.
        seconds: How long to film [s].
        on_state: Told "3", "2", "1", "sign now" and "done".
        countdown: [s].

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


def _count_down(opened: cv2.VideoCapture, countdown: int, on_state: Callable[[str], None]) -> None:
    """Show images to nobody meanwhile: a camera finds its exposure, and keeps no old images."""
    for left in range(countdown, 0, -1):
        on_state(str(left))
        until = time.monotonic() + 1.0
        while time.monotonic() < until and opened.read()[0]:
            pass
        time.sleep(max(until - time.monotonic(), 0.0))
