# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a sign is captured from: a bag of skeletons, or a bag of images of which skeletons are made first."""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from rosbags.highlevel import AnyReader

from teo_sign_capture.recordings.retrieval import retrieve_apart
from teo_sign_capture.recordings.skeleton_bag import TRUTH, TYPE, is_rendered, read_skeletons
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_signs.errors import LutError
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP

BAG_SUFFIXES = (".mcap", ".db3", ".bag")
_IMAGES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage")
_CHUNK = 1 << 20


@dataclass(frozen=True, kw_only=True)
class Recording:
    """A bag that exists and holds something to capture.

    Attributes:
        path: The bag.
        digest: SHA-256 of its content, hexadecimal.
        has_skeletons: Whether it holds skeletons that were found in images, or only the images.
        rendered: Whether a program drew it.
        slop: Greatest difference between the stamps of colour and depth, where skeletons are made of images
            [s].
    """

    path: Path
    digest: str
    has_skeletons: bool
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
    """Look into a bag.

    Args:
        path: The bag.
        slop: Greatest difference between the stamps of colour and depth [s].

    Raises:
        LutError: "no_bag" if there is none, "unreadable_bag", or "no_skeletons" if it holds neither
            skeletons nor images.
    """
    if not is_bag(path):
        raise LutError(
            "no_bag", f"expected the folder of a bag or a file {', '.join(BAG_SUFFIXES)}, got {path}"
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
        rendered=is_rendered(kinds, begins),
        slop=slop,
    )


def is_bag(path: Path) -> bool:
    """Whether a path is a file or a folder as bags are; a folder without metadata.yaml holds bags at most."""
    if path.is_dir():
        return (path / "metadata.yaml").is_file()
    return path.is_file() and path.suffix in BAG_SUFFIXES


def digest_of(path: Path) -> str:
    """SHA-256 of a bag's messages: of its storage files, in order of their names."""
    files = (
        sorted(file for file in path.iterdir() if file.suffix in BAG_SUFFIXES) if path.is_dir() else [path]
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
    """The person of a recording; skeletons are made of the images if they are not in the cache yet.

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
        if not bag.is_file():
            _fill_cache(recording, bag, on_progress)
        warnings = _warnings_of(bag).read_text("utf-8") if _warnings_of(bag).is_file() else ""
    track = read_skeletons(bag, topic=topic, signer=person)
    # A rendered recording has stamps, but no day on which anybody stood before a camera.
    recorded = None if recording.rendered else track.recorded
    return replace(track, source=recording.name, recorded=recorded), tuple(warnings.splitlines())


def skeletons_of(recording: Recording, cache: Path) -> Path:
    """The bag that holds a recording's skeletons, once `track_of` has read them: in the cache, or itself."""
    cached = _cached(recording, cache)
    return cached if cached.is_file() and not recording.has_skeletons else recording.path


def _cached(recording: Recording, cache: Path) -> Path:
    # Other pairs of colour and depth make other skeletons.
    paired = "" if recording.slop == DEFAULT_SLOP else f"-slop{recording.slop:g}"
    return cache / f"{recording.path.stem}-{recording.digest[:12]}{paired}.mcap"


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


def _fill_cache(recording: Recording, out: Path, on_progress: Callable[[int, int], None] | None) -> None:
    """Make skeletons of a bag's images, and beside them a text of what could not be used."""
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        # Two captures of one bag at a time must not write one file.
        with tempfile.TemporaryDirectory(dir=out.parent, prefix=".") as folder:
            made = Path(folder) / "skeletons.mcap"
            complaints = retrieve_apart(recording.path, made, on_progress, slop=recording.slop)
            if complaints:  # what is left of a recording that was cut off is worth a look
                _warnings_of(made).write_text("\n".join(complaints), "utf-8")
                _warnings_of(made).replace(_warnings_of(out))
            made.replace(out)
    except OSError as error:
        raise LutError(
            "not_written", f"{out.parent}: expected a directory to write to, got: {error}"
        ) from error
