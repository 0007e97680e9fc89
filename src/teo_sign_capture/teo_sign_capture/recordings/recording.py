# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a sign is captured from, read as a track: a bag of skeletons or images, a video, or a `.pose` file.

What the retriever finds in images is kept in a cache.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from teo_sign_capture.recordings.keypoint_search import Progress, find_points, find_skeletons
from teo_sign_capture.recordings.pose_file import read_pose_file
from teo_sign_capture.recordings.skeleton_bag import TRUTH, TYPE, is_rendered, open_bag, read_skeletons
from teo_sign_capture.recordings.video import VIDEO_SUFFIXES, is_video
from teo_sign_capture.tracks.skeleton_track import FACE, Keypoints, SkeletonTrack, in_body_axes
from teo_signs.errors import LutError
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP
from teo_skeleton_retriever.layouts.person_layout import BODY as PERSON_BODY
from teo_skeleton_retriever.layouts.person_layout import LEFT_HAND, RIGHT_HAND
from teo_skeleton_retriever.lifting.clip import PoseClip
from teo_skeleton_retriever.lifting.lifted_person import lift_clip

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
            digest=_digest_of(path),
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
    bag = open_bag(path)
    kinds = bag.kinds
    skeletons = any(kind == TYPE and not topic.startswith(TRUTH) for topic, kind in kinds.items())
    if not skeletons and not any(kind in _IMAGES for kind in kinds.values()):
        raise LutError(
            "no_skeletons",
            f"{path.name}: expected a topic of colour and one of depth images, or one of skeletons; got "
            f"{', '.join(sorted(kinds)) or 'nothing'}",
        )
    return Recording(
        path=path,
        digest=_digest_of(path),
        has_skeletons=skeletons,
        is_flat=False,
        rendered=is_rendered(kinds, 1e-9 * bag.begins),
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


def _digest_of(path: Path) -> str:
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
    recorded: str | None = None,
    on_progress: Progress | None = None,
) -> tuple[SkeletonTrack, tuple[str, ...]]:
    """The person of a recording, lifted into space where no depth was recorded.

    Args:
        recording: The recording.
        cache: Directory in which what was found in images is kept, by the digest of the recording.
        topic: Topic of a bag's skeletons; None finds it.
        person: Id of the person, or which of several people of a `.pose` file, from 0; None for the signer.
        recorded: Day of a video or `.pose` file, YYYY-MM-DD; None if not known. Bags know it.
        on_progress: Told how many images of how many are looked at, while keypoints are found.

    Returns:
        The person, and what could not be used of the recording, a sentence each.

    Raises:
        LutError: Of `read_skeletons`, `read_pose_file` and `in_body_axes`, and where keypoints are looked for
            of `find_skeletons` ("no_depth", "no_camera_info", ...) or `find_points`.
    """
    found, warnings = recording.path, ""
    if not recording.has_skeletons and (recording.is_flat or topic is None):
        found = _cached(recording, cache)
        _fill_cache(recording, found, on_progress)
        warnings = _warnings_of(found).read_text("utf-8") if _warnings_of(found).is_file() else ""
    if recording.is_flat:
        clip = replace(read_pose_file(found, person=person), source=recording.name)
        return lifted_track(clip, recorded=recorded), tuple(warnings.splitlines())
    track = read_skeletons(found, topic=topic, signer=person)
    # A rendered recording has stamps, but no day on which anybody stood before a camera.
    day = None if recording.rendered else track.recorded
    told = [*warnings.splitlines(), *([f"{recording.name}: {track.damage}"] if track.damage else ())]
    return replace(track, source=recording.name, recorded=day), tuple(told)


def lifted_track(clip: PoseClip, *, recorded: str | None = None) -> SkeletonTrack:
    """Lift a clip into space, and bring it into the axes of the trunk.

    Args:
        clip: A person seen from in front, one shoulder and one hand at least in some frames.
        recorded: Day of the recording, YYYY-MM-DD; None if not known.

    Raises:
        LutError: "no_torso", see `in_body_axes`.
    """
    person = lift_clip(clip)
    frames = len(person.positions)
    rows = {"body": PERSON_BODY, "left_hand": LEFT_HAND, "right_hand": RIGHT_HAND}
    parts = {
        name: Keypoints(
            positions=person.positions[:, part],
            sigma=person.sigma[:, part],
            confidence=person.confidence[:, part],
            status=person.status[:, part],
        )
        for name, part in rows.items()
    }
    return in_body_axes(
        times=np.arange(frames, dtype=np.float64) / clip.rate,
        **parts,
        face=Keypoints.lost(frames, FACE),
        source=clip.source,
        recorded=recorded,
        up=(0.0, 0.0, 1.0),
    )


def skeletons_of(recording: Recording, cache: Path) -> Path:
    """The bag that holds a recording's skeletons, once `track_of` has read them: in the cache, or itself."""
    cached = _cached(recording, cache)
    return cached if cached.is_file() and not recording.has_skeletons else recording.path


def _cached(recording: Recording, cache: Path) -> Path:
    # Other pairs of colour and depth make other skeletons.
    paired = "" if recording.slop == DEFAULT_SLOP else f"-slop{recording.slop:g}"
    # Films that were looked at before bodies had depths are looked at anew.
    suffix = f"-depths{_POSE_SUFFIX}" if recording.is_flat else ".mcap"
    return cache / f"{recording.path.stem}-{recording.digest[:12]}{paired}{suffix}"


def _warnings_of(skeletons: Path) -> Path:
    return skeletons.with_suffix(".txt")


def _fill_cache(recording: Recording, out: Path, on_progress: Progress | None) -> None:
    """Find the people in images unless that was done, and write beside them what could not be used."""
    if out.is_file():
        return
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        # Two captures of one recording at a time must not write one file.
        with tempfile.TemporaryDirectory(dir=out.parent, prefix=".") as folder:
            made = Path(folder) / f"found{out.suffix}"
            if recording.is_flat:
                complaints = find_points(recording.path, made, on_progress)
            else:
                complaints = find_skeletons(recording.path, made, on_progress, slop=recording.slop)
            if complaints:  # what is left of a recording that was cut off is worth a look
                _warnings_of(made).write_text("\n".join(complaints), "utf-8")
                _warnings_of(made).replace(_warnings_of(out))
            made.replace(out)
    except OSError as error:
        raise LutError(
            "not_written", f"{out.parent}: expected a directory to write to, got: {error}"
        ) from error
