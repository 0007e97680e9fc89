# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a sign is captured from: a bag of skeletons or images, a video, or a clip of a person's points.

Skeletons of a bag's images are found by the retriever, in a process of its own, and kept in a cache.
"""

from __future__ import annotations

import functools
import hashlib
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from rosbags.highlevel import AnyReader

from teo_sign_capture.recordings.own_process import Progress, not_retrieved, work_apart
from teo_sign_capture.recordings.pose_file import PoseClip, read_pose_file
from teo_sign_capture.recordings.skeleton_bag import TRUTH, TYPE, is_rendered, read_skeletons
from teo_sign_capture.recordings.video import VIDEO_SUFFIXES, find_points_apart, is_video
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
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


_BAG_SUFFIXES = (".mcap", ".db3", ".bag")
_POSE_SUFFIX = ".pose"
_IMAGES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage")
_CHUNK = 1 << 20


@dataclass(frozen=True, kw_only=True)
class Recording:
    """A recording that exists and holds something to capture.

    Attributes:
        path: The bag, the video or the `.pose` file.
        digest: SHA-256 of its content, hexadecimal.
        has_skeletons: Whether it holds what was found in images, or only the images.
        is_flat: Whether one camera took it without depth: a video, or points of one.
        rendered: Whether a program drew it.
        slop: Greatest difference between the stamps of colour and depth, where skeletons are made of images
            [s].
    """

    path: Path
    digest: str
    has_skeletons: bool
    is_flat: bool
    rendered: bool
    slop: float = DEFAULT_SLOP

    @property
    def name(self) -> str:
        """Name for people, and for the provenance."""
        return self.path.name


def default_cache() -> Path:
    """Where skeletons are kept that were found in images (XDG base directories)."""
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "teo_lut_executor" / "skeletons"


def open_recording(path: Path, *, slop: float = DEFAULT_SLOP) -> Recording:
    """Look into a bag; a video or a `.pose` file is only told by its name.

    Args:
        path: The bag.
        slop: Greatest difference between the stamps of colour and depth [s].

    Raises:
        LutError: "no_bag" if there is none, "unreadable_bag", or "no_skeletons" if it holds neither
            skeletons nor images.
    """
    if is_video(path) or _is_pose_file(path):
        return Recording(
            path=path,
            digest=digest_of(path),
            has_skeletons=_is_pose_file(path),
            is_flat=True,
            rendered=False,
        )
    if not is_bag(path):
        raise LutError(
            "no_bag",
            "expected the folder of a bag or a file "
            f"{', '.join((*_BAG_SUFFIXES, *VIDEO_SUFFIXES, _POSE_SUFFIX))}, got {path}",
        )
    kinds, begins = _topics(path)
    skeletons = any(kind == TYPE and not topic.startswith(TRUTH) for topic, kind in kinds.items())
    if not skeletons and not any(kind in _IMAGES for kind in kinds.values()):
        raise LutError(
            "no_skeletons",
            f"{path.name}: expected a topic of colour and one of depth images, or one of skeletons; got "
            f"{', '.join(sorted(kinds)) or 'nothing'}",
        )
    return Recording(
        path=path,
        digest=digest_of(path),
        has_skeletons=skeletons,
        is_flat=False,
        rendered=is_rendered(kinds, begins),
        slop=slop,
    )


def is_bag(path: Path) -> bool:
    """Whether a path is a file or a folder as bags are; a folder without metadata.yaml holds bags at most."""
    if path.is_dir():
        return (path / "metadata.yaml").is_file()
    return path.is_file() and path.suffix in _BAG_SUFFIXES


def is_recording(path: Path) -> bool:
    """Whether a path is anything that a sign can be captured from."""
    return is_bag(path) or is_video(path) or _is_pose_file(path)


def _is_pose_file(path: Path) -> bool:
    """Whether a path is a file of a person's points."""
    return path.is_file() and path.suffix == _POSE_SUFFIX


def digest_of(path: Path) -> str:
    """SHA-256 of a bag's messages: of its storage files, in order of their names."""
    files = (
        sorted(file for file in path.iterdir() if file.suffix in _BAG_SUFFIXES) if path.is_dir() else [path]
    )
    digest = hashlib.sha256()
    try:
        for file in files:
            with file.open("rb") as stream:
                while chunk := stream.read(_CHUNK):
                    digest.update(chunk)
    except OSError as error:
        raise LutError("unreadable_bag", f"{path}: expected a bag to read, got: {error.strerror}") from error
    return digest.hexdigest()


def track_of(
    recording: Recording,
    *,
    cache: Path,
    topic: str | None = None,
    person: int | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> tuple[SkeletonTrack, tuple[str, ...]]:
    """The person of a bag; skeletons are made of the images if they are not in the cache yet.

    Args:
        recording: The bag.
        cache: Directory in which skeletons found in images are kept, by the digest of the bag.
        topic: Topic of the skeletons; None finds it.
        person: Id of the person; None for the signer.
        on_progress: Told how many messages of how many are looked at, while skeletons are made.

    Returns:
        The person, and what could not be used of the images, a sentence each.

    Raises:
        LutError: Of `read_skeletons`, or of `retrieve_apart`: "no_depth", "no_camera_info", ...
    """
    bag, warnings = recording.path, ""
    if not recording.has_skeletons and topic is None:
        bag = _cached(recording, cache)
        find = functools.partial(retrieve_apart, slop=recording.slop)
        _fill_cache(recording.path, bag, find, on_progress)
        warnings = _warnings_of(bag).read_text("utf-8") if _warnings_of(bag).is_file() else ""
    track = read_skeletons(bag, topic=topic, signer=person)
    # A rendered recording has stamps, but no day on which anybody stood before a camera.
    recorded = None if recording.rendered else track.recorded
    return replace(track, source=recording.name, recorded=recorded), tuple(warnings.splitlines())


def points_of(
    recording: Recording,
    *,
    cache: Path,
    person: int | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> PoseClip:
    """The person's points in a video or a `.pose` file; a video is looked at unless the cache has them.

    Args:
        recording: The video or file.
        cache: Directory in which points found in videos are kept, by the digest of the video.
        person: Which of several people of a `.pose` file, from 0.
        on_progress: Told how many images of how many are looked at.

    Raises:
        LutError: Of `find_points_apart` or `read_pose_file`.
    """
    file = recording.path
    if not recording.has_skeletons:
        file = _cached(recording, cache)
        _fill_cache(recording.path, file, find_points_apart, on_progress)
    return replace(read_pose_file(file, person=person), source=recording.name)


def skeletons_of(recording: Recording, cache: Path) -> Path:
    """The bag that holds a recording's skeletons, once `track_of` has read them: in the cache, or itself."""
    cached = _cached(recording, cache)
    return cached if cached.is_file() and not recording.has_skeletons else recording.path


def _cached(recording: Recording, cache: Path) -> Path:
    # Other pairs of colour and depth make other skeletons.
    paired = "" if recording.slop == DEFAULT_SLOP else f"-slop{recording.slop:g}"
    suffix = _POSE_SUFFIX if recording.is_flat else ".mcap"
    return cache / f"{recording.path.stem}-{recording.digest[:12]}{paired}{suffix}"


def _warnings_of(skeletons: Path) -> Path:
    return skeletons.with_suffix(".txt")


def _topics(path: Path) -> tuple[dict[str, str], float]:
    """Types of a bag's topics, and when its first message was received [s]."""
    try:
        with AnyReader([path]) as reader:
            return {one.topic: one.msgtype for one in reader.connections}, 1e-9 * reader.start_time
    except Exception as error:  # the library raises what unpacking wrong bytes happens to raise
        raise LutError(
            "unreadable_bag", f"{path}: expected a whole bag, got: {type(error).__name__} {error}"
        ) from error


def _fill_cache(
    recording: Path,
    out: Path,
    find: Callable[[Path, Path, Progress | None], tuple[str, ...]],
    on_progress: Progress | None,
) -> None:
    """Find the people in images unless that was done, and write beside them what could not be used."""
    if out.is_file():
        return
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        # Two captures of one recording at a time must not write one file.
        with tempfile.TemporaryDirectory(dir=out.parent, prefix=".") as folder:
            made = Path(folder) / f"found{out.suffix}"
            complaints = find(recording, made, on_progress)
            if complaints:  # what is left of a recording that was cut off is worth a look
                _warnings_of(made).write_text("\n".join(complaints), "utf-8")
                _warnings_of(made).replace(_warnings_of(out))
            made.replace(out)
    except OSError as error:
        raise LutError(
            "not_written", f"{out.parent}: expected a directory to write to, got: {error}"
        ) from error
