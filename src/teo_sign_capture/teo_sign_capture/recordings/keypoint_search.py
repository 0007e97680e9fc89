# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""People found in the images of a recording, in a process of its own.

MediaPipe is native code: what it breaks, keeps in memory or says ends with that process, which can be stopped
at any moment. A pool of `concurrent.futures` cannot stop a task that runs.
"""

from __future__ import annotations

import functools
import os
import sys
import tempfile
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from multiprocessing import current_process, get_context
from multiprocessing.connection import Connection
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from teo_common.arrays import Array
from teo_common.atomic_files import write_atomically
from teo_sign_capture.recordings.pose_file import pose_file
from teo_sign_capture.recordings.video import Image, VideoImage, count_images, video_images
from teo_sign_capture.tracks.skeleton_track import BODY, HAND
from teo_signs.errors import LutError
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP

if TYPE_CHECKING:
    from teo_skeleton_retriever.detectors.detector import Detector
    from teo_skeleton_retriever.layouts.person_2d import Person2D

# Loaded by MediaPipe, in a second, to draw; nothing is drawn in the process.
_NOT_NEEDED = ("matplotlib", "matplotlib.pyplot")

# Told how much is done, of how much.
Progress = Callable[[int, int], None]
# Takes a recording and the file to write; returns what could not be used, a sentence each.
_Work = Callable[[Path, Path, Progress | None], tuple[str, ...]]


def _work_apart(
    work: _Work, recording: Path, out: Path, on_progress: Progress | None = None
) -> tuple[str, ...]:
    """Do work on a recording in a process of its own. The work is a function that the process can import.

    Raises:
        LutError: What the work raises; "not_retrieved" where the process died.
        OSError: `out` cannot be written.
    """
    if current_process().daemon:  # a worker of Dask: in a process of its own already, and may start none
        return work(recording, out, on_progress)
    context = get_context("spawn")  # a fork would take over locks and threads of whatever runs here
    receiver, sender = context.Pipe(duplex=False)
    with tempfile.NamedTemporaryFile(prefix="retrieve-", suffix=".txt") as said:
        process = context.Process(target=_serve, args=(work, recording, out, sender, said.name))
        process.start()
        sender.close()
        try:
            while True:
                result = receiver.recv()
                if isinstance(result, Exception):
                    raise result
                if isinstance(result, list):
                    return tuple(result)
                if on_progress is not None:
                    on_progress(*result)
        except EOFError:
            process.join()
            last = Path(said.name).read_text("utf-8", errors="replace").strip().splitlines()[-1:]
            raise _not_retrieved(recording, last[0] if last else f"exit status {process.exitcode}") from None
        finally:
            process.kill()
            process.join()
            receiver.close()


def _not_retrieved(recording: Path, reason: str) -> LutError:
    """The error of a recording in whose images nothing was found."""
    return LutError("not_retrieved", f"{recording.name}: expected skeletons of its images, got: {reason}")


def _serve(work: _Work, recording: Path, out: Path, sender: Connection, said: str) -> None:
    """Body of the process: sends the progress, then a list of complaints or the error."""
    sys.modules.update({name: ModuleType(name) for name in _NOT_NEEDED})
    native = os.open(said, os.O_WRONLY | os.O_APPEND)
    os.dup2(native, 1)
    os.dup2(native, 2)  # what MediaPipe's libraries say is for nobody, unless they end the process
    try:
        sender.send(list(work(recording, out, lambda done, total: sender.send((done, total)))))
    except (LutError, OSError) as error:
        sender.send(error)


def find_skeletons(
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
    return _work_apart(functools.partial(_find_skeletons, slop=slop), bag, out, on_progress)


def _find_skeletons(bag: Path, out: Path, on_progress: Progress | None, slop: float) -> tuple[str, ...]:
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
        raise _not_retrieved(bag, report.complaints[0])
    if report.nobody:
        raise LutError("nobody_in_space", f"{bag.name}: {report.nobody}")
    return report.complaints


# Between two images that are farther apart than so many usual periods nothing is known.
_LONGEST_GAP = 2.5
# Share of the time between two images within which a moment is that of the nearer one.
_AT_IT = 0.05
POINTS = BODY + 2 * HAND
# Who is farther away in the next image is somebody else, in sizes of a person [1]: raised arms move the
# middle of a body by a fifth, and whoever stands beside is half a size away at least.
_FARTHEST = 0.5


def find_points(video: Path, out: Path, on_progress: Progress | None = None) -> tuple[str, ...]:
    """Find the person in a video and write a `.pose` file, in a process of its own.

    The file is one as other programs write and read them (BODY_25 and hands of 21 points, in OpenPose's
    names), so that a video goes the way of every clip. Depths are as the detector imagines them: of the body
    in about the scale of the picture, of hands in metres.

    Args:
        video: The video.
        out: File to write; its folder exists.
        on_progress: Told of the number of images read and about that of all.

    Returns:
        That there are several people, in a sentence, if there are.

    Raises:
        LutError: What `video_images` raises, "too_short" for fewer than two images, "no_person" if nobody is
            seen in any, "not_retrieved" where the process died.
        OSError: `out` cannot be written.
    """
    return _work_apart(_find_points, video, out, on_progress)


def _find_points(video: Path, out: Path, on_progress: Progress | None) -> tuple[str, ...]:
    # Imported here: MediaPipe and what it needs are to be loaded by the process that runs it.
    from teo_skeleton_retriever.detectors import make_detector
    from teo_skeleton_retriever.errors import RetrieverError

    times: list[float] = []
    found: list[Array] = []
    size, several = (0, 0), 0
    who: Person2D | None = None
    total = count_images(video)
    try:
        detector = make_detector("mediapipe")
        try:
            for time, image, people in _detected(detector, video_images(video)):
                times.append(time)
                person = _followed(people, who)
                found.append(person_points(person) if person else np.zeros((POINTS, 4)))
                who, several = person or who, several + (len(people) > 1)
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
    if not several:
        return ()
    return (
        f"expected one person, got several in {several} of {len(times)} images: the one who is nearest at "
        "first is followed; if that is not the signer, film the signer alone",
    )


def _followed(people: Sequence[Person2D], before: Person2D | None) -> Person2D | None:
    """Of the people of an image, the nearest first, the one who was followed before; None if nobody is."""
    if before is None or not len(before.body):
        return people[0] if people else None
    middle, size = _place(before)

    def away(person: Person2D) -> float:
        """How far off that person would have moved, in their own sizes [1]."""
        there, now = _place(person)
        return float(np.linalg.norm(there - middle)) / max(size, now, 1.0)

    nearest = min(people, key=away, default=None)
    return None if nearest is None or away(nearest) > _FARTHEST else nearest


def _place(person: Person2D) -> tuple[Array, float]:
    """The middle of a person's keypoints of the body that are seen, and the diagonal around them [px]."""
    seen = person.body[person.body[:, 2] > 0.0, :2] if len(person.body) else np.zeros((0, 2))
    if not len(seen):
        return np.zeros(2), 0.0
    return seen.mean(axis=0), float(np.linalg.norm(np.ptp(seen, axis=0)))


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


def person_points(person: Person2D) -> Array:
    """A person of the detector: x, y, depth, confidence of body, left and right hand. Shape (67, 4)."""
    points = np.zeros((POINTS, 4))
    body, left, right = np.split(points, [BODY, BODY + HAND])
    for part, keypoints in ((body, person.body), (left, person.left_hand), (right, person.right_hand)):
        if len(keypoints):
            part[:, [0, 1, 3]] = keypoints
    if person.body_depth is not None:
        body[:, 2] = person.body_depth
    for part, shape in ((left, person.left_hand_world), (right, person.right_hand_world)):
        if shape is not None:
            part[:, 2] = shape[:, 2]
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
