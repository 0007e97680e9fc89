# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Images of a video file with their times, and the person's points in them, kept as a `.pose` file.

PyAV reads a video, as it gives each image the time that the file says: phones change their rate with the
light, and a sign must not change its pace with it. The retriever's detector finds the points. The file is one
as other programs write and read them (BODY_25 and hands of 21 points, in OpenPose's names), so that a video
goes the way of every clip. Only hands have depths, as the detector imagines them.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_common.atomic_files import write_atomically
from teo_sign_capture.recordings.own_process import Progress, work_apart
from teo_sign_capture.recordings.pose_layouts import OPENPOSE
from teo_sign_capture.tracks.skeleton_track import BODY, HAND
from teo_signs.errors import LutError

Image = NDArray[np.uint8]

VIDEO_SUFFIXES = (".mp4", ".mov", ".webm", ".m4v", ".mkv", ".avi")
# [s] As much as a `.pose` file may hold at 25 images a second: a film of many signs is cut first.
LONGEST = 240.0
# [Hz] What is faster is thinned to this: the fastest shakes of hands have 5 to 7 Hz.
FASTEST = 30.0
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


def _count_images(path: Path) -> int:
    """About how many images `video_images` gives; 0 where the file does not say."""
    import av

    try:
        with av.open(str(path)) as container:
            stream = container.streams.video[0]
            length = float(container.duration or 0) / av.time_base
            rate = min(float(stream.average_rate or FASTEST), FASTEST)
    except (av.FFmpegError, IndexError, OSError):
        return 0
    return int(length * rate)


def video_images(path: Path) -> Iterator[VideoImage]:
    """Read a video, at most `FASTEST` images a second.

    Raises:
        LutError: "unreadable_video" if it is none or damaged, "too_long" beyond `LONGEST`.
    """
    import av  # loads for half a second what only videos need

    try:
        with av.open(str(path)) as container:
            if not container.streams.video:
                raise LutError(
                    "unreadable_video", f"{path.name}: expected a video, got a file without images"
                )
            stream = container.streams.video[0]
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
    import cv2

    image: Image = frame.to_ndarray(format="rgb24")  # type: ignore[attr-defined]  # PyAV's VideoFrame
    image = np.rot90(image, round(frame.rotation / 90.0) % 4)  # type: ignore[attr-defined]  # counter-clockwise
    share = _LONGEST_SIDE / max(image.shape[:2])
    if share < 1.0:
        size = (round(image.shape[1] * share), round(image.shape[0] * share))
        return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    return np.ascontiguousarray(image)


if TYPE_CHECKING:
    from teo_skeleton_retriever.detectors.detector import Detector
    from teo_skeleton_retriever.layouts.person_2d import Person2D

# Between two images that are farther apart than so many usual periods nothing is known.
_LONGEST_GAP = 2.5
# Share of the time between two images within which a moment is that of the nearer one.
_AT_IT = 0.05
_POINTS = BODY + 2 * HAND


def find_points_apart(video: Path, out: Path, on_progress: Progress | None = None) -> tuple[str, ...]:
    """Find the person in a video and write a `.pose` file, in a process of its own.

    Args:
        video: The video.
        out: File to write; its folder exists.
        on_progress: Told of the number of images read and about that of all.

    Returns:
        Nothing: a video is used whole or refused.

    Raises:
        LutError: What `video_images` raises, "too_short" for fewer than two images, "no_person" if nobody is
            seen in any, "not_retrieved" where the process died.
        OSError: `out` cannot be written.
    """
    return work_apart(_find, video, out, on_progress)


def _find(video: Path, out: Path, on_progress: Progress | None) -> tuple[str, ...]:
    # Imported here: MediaPipe and what it needs are to be loaded by the process that runs it.
    from teo_skeleton_retriever.detectors import make_detector
    from teo_skeleton_retriever.errors import RetrieverError

    times: list[float] = []
    found: list[Array] = []
    size = (0, 0)
    total = _count_images(video)
    try:
        detector = make_detector("mediapipe")
        try:
            for time, image, people in _detected(detector, video_images(video)):
                times.append(time)
                found.append(_points(people[0]) if people else np.zeros((_POINTS, 4)))
                size = (image.shape[1], image.shape[0])
                if on_progress is not None:
                    on_progress(len(times), max(total, len(times)))
        finally:
            detector.close()
    except RetrieverError as error:
        raise LutError(error.code, f"{video.name}: {error.sentence}") from None
    if len(times) < 2:
        raise LutError("too_short", f"{video.name}: expected two images or more, got {len(times)}")
    points = np.array(found)
    if not points[..., 3].any():
        raise LutError(
            "no_person",
            f"{video.name}: expected a person in one of {len(times)} images, got nobody: were head and "
            "arms in the picture?",
        )
    write_atomically(out, pose_file(*evenly(np.array(times), points), size))
    return ()


def _detected(
    detector: Detector, images: Iterable[VideoImage]
) -> Iterator[tuple[float, Image, tuple[Person2D, ...]]]:
    """Images in order with the people in them, as many looked at at once as the detector can."""
    # Two of MediaPipe's images at a time take two thirds of the time of one after the other on two cores.
    waiting: deque[tuple[VideoImage, Future[tuple[Person2D, ...]]]] = deque()

    def first() -> tuple[float, Image, tuple[Person2D, ...]]:
        shown, people = waiting.popleft()
        return shown.time, shown.image, people.result()

    with ThreadPoolExecutor(detector.images_at_once) as threads:
        for shown in images:
            waiting.append((shown, threads.submit(detector.detect, shown.image, shown.time)))
            if len(waiting) > detector.images_at_once:
                yield first()
        while waiting:
            yield first()


def _points(person: object) -> Array:
    """A person of the detector: x, y, depth, confidence of body, left and right hand. Shape (67, 4)."""
    points = np.zeros((_POINTS, 4))
    parts = (("body", 0, BODY), ("left_hand", BODY, HAND), ("right_hand", BODY + HAND, HAND))
    for part, start, count in parts:
        keypoints = getattr(person, part)
        if len(keypoints):
            points[start : start + count, [0, 1, 3]] = keypoints
        shape = getattr(person, f"{part}_world", None)
        if shape is not None:
            points[start : start + count, 2] = shape[:, 2]
    return points


def evenly(times: Array, points: Array) -> tuple[float, Array]:
    """Points at an even rate, as `.pose` files have them: straight between the images before and after.

    Args:
        times: [s], strictly increasing. Shape (n,), n at least 2.
        points: x, y, depth, confidence, 0 where not seen. Shape (n, k, 4).

    Returns:
        The rate [Hz], and points at it; not seen where either image is without them, or both are far apart.
        Shape (m, k, 4).
    """
    period = float(np.median(np.diff(times)))
    even = times[0] + period * np.arange(int(np.floor((times[-1] - times[0]) / period + 1e-6)) + 1)
    after = np.clip(np.searchsorted(times, even), 1, len(times) - 1)
    gap = times[after] - times[after - 1]
    share = np.clip((even - times[after - 1]) / gap, 0.0, 1.0)[:, None, None]
    first, second = points[after - 1], points[after]
    between = first + share * (second - first)
    near = (gap <= _LONGEST_GAP * period)[:, None]
    both = (first[..., 3] > 0.0) & (second[..., 3] > 0.0) & near
    # What is seen in one of the two images alone is where it was if that is all but at this moment.
    nearest = np.where(share > 0.5, second, first)
    at_it = np.minimum(share, 1.0 - share)[..., 0] < _AT_IT
    return 1.0 / period, np.where(both[..., None], between, np.where(at_it[..., None], nearest, 0.0))


def pose_file(rate: float, points: Array, size: tuple[int, int]) -> bytes:
    """A `.pose` file of one person.

    Args:
        rate: [Hz].
        points: x, y [px], depth away from the camera [m], confidence, 0 where not seen. Shape (n, 67, 4).
        size: Width and height of the picture [px].
    """
    from pose_format import Pose  # heavy, and needed by nothing but this
    from pose_format.numpy import NumPyPoseBody
    from pose_format.pose_header import PoseHeader, PoseHeaderComponent, PoseHeaderDimensions

    body = [OPENPOSE.body_points.get(row, f"unused_{row}") for row in range(BODY)]
    components = [
        PoseHeaderComponent(name, list(names), [], [], "XYZC")
        for name, names in (
            (OPENPOSE.body, body),
            (OPENPOSE.left_hand, OPENPOSE.hand_points),
            (OPENPOSE.right_hand, OPENPOSE.hand_points),
        )
    ]
    header = PoseHeader(0.2, PoseHeaderDimensions(*size, 0), components)
    seen = points[:, None, :, 3]
    data = np.ma.masked_array(points[:, None, :, :3], np.repeat(seen[..., None] <= 0.0, 3, axis=3))
    stream = BytesIO()
    Pose(header, NumPyPoseBody(rate, data, seen)).write(stream)
    return stream.getvalue()
