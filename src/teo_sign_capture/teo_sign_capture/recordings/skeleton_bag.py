# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The track of a person from a bag of skeletons."""

from __future__ import annotations

import datetime
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from teo_sign_capture.tracks.skeleton_track import (
    BODY,
    FACE,
    HAND,
    SHOULDER,
    Keypoints,
    SkeletonTrack,
    in_body_axes,
    seen,
)
from teo_signs.errors import LutError
from teo_skeleton_retriever.bags.bag_reader import Bag
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.skeleton_3d import CAMERA_UP

TYPE = "teo_sign_msgs/msg/SkeletonArray"
# Begins the topics in which a renderer says where everything truly was.
TRUTH = "/truth/"

_PARTS = {"body": BODY, "left_hand": HAND, "right_hand": HAND, "face": FACE}
# [m] Between the shoulder joints, median of the frames: of a child of three, and half as much again as of the
# broadest of 27 rendered people. Depth in centimetres makes it a tenth or a hundred times.
_NARROWEST, _BROADEST = 0.15, 0.66
# Stature over that distance, for words: 1.70 m over 0.36 m.
_STATURE = 4.7
# Stamps before this count from the start of a clock that knows no day, as in simulation.
_EARLIEST = datetime.datetime(2000, 1, 1, tzinfo=datetime.UTC)
# [s] The synthetic signer's takes all begin at this moment of 2023 (`teo_synthetic_signer.take.take_files`,
# which loads for seconds what draws them), and last no longer: skeletons that were found in its images carry
# no other sign.
_RENDERED_FROM, _LONGEST = 1_700_000_000.0, 3600.0


def is_rendered(topics: Iterable[str], begins: float) -> bool:
    """Whether a program drew what a bag holds, and nobody stood before a camera on any day.

    Args:
        topics: Of the bag; a renderer's tell the truth about its images.
        begins: Stamp of its first message [s].
    """
    told = any(topic.startswith(TRUTH) for topic in topics)
    return told or _RENDERED_FROM <= begins < _RENDERED_FROM + _LONGEST


def read_skeletons(path: Path, *, topic: str | None = None, signer: int | None = None) -> SkeletonTrack:
    """Read a person's skeletons, in the axes of the person's trunk.

    Args:
        path: A ROS 2 bag: its folder, or its .mcap or .db3 file. Of one that was cut off, the rest is read.
        topic: Topic of `SkeletonArray`; None takes the bag's only one that is no truth of a renderer, or
            ``/skeletons`` if there are several.
        signer: Id of the person; None follows whoever is marked as the signer.

    Raises:
        LutError: "unreadable_bag", "no_skeletons", "no_person", "no_torso", "bad_stamps", or "wrong_depth" of
            a body no person has.
    """
    opened = open_bag(path)
    chosen = _topic(opened, path, topic)
    messages = [found.message for found in opened.messages([chosen])]
    if not messages:
        told = opened.problem or "none"
        raise LutError("no_skeletons", f"{path.name}: expected messages on {chosen}, got {told}")
    begins = stamp_of(messages[0])
    recorded = None if is_rendered(opened.kinds, begins) else _day(begins)
    track = track_of_people(messages, source=path.name, signer=signer, recorded=recorded)
    _check_size(track)
    return replace(track, damage=opened.problem)


def open_bag(path: Path) -> Bag:
    """Open a bag; of one that was cut off, what is before the cut.

    Raises:
        LutError: "unreadable_bag".
    """
    try:
        return Bag(path)
    except RetrieverError as error:
        raise LutError("unreadable_bag", f"{path}: expected a bag, got: {error.sentence}") from error


def _check_size(track: SkeletonTrack) -> None:
    """Refuse a person of a size that only a wrong unit of depth gives."""
    shoulders = track.body.positions[:, SHOULDER["left"]] - track.body.positions[:, SHOULDER["right"]]
    breadth = float(np.nanmedian(np.linalg.norm(shoulders, axis=1)))
    if not _NARROWEST <= breadth <= _BROADEST:
        raise LutError(
            "wrong_depth",
            f"{track.source}: expected shoulders {_NARROWEST:g} to {_BROADEST:g} m apart, got {breadth:.2g}, "
            f"as of somebody {_STATURE * breadth:.3g} m tall: depth must be in millimetres (16UC1) "
            "or metres (32FC1)",
        )


def stamp_of(message: Any) -> float:
    """When the image of a `SkeletonArray` was taken [s]."""
    return float(message.header.stamp.sec) + 1e-9 * float(message.header.stamp.nanosec)


def write_skeletons(path: Path, messages: Sequence[Any]) -> None:
    """Write `SkeletonArray` messages as a bag, whole or not at all."""
    from teo_skeleton_retriever.output.skeleton_bag import skeleton_bag

    with skeleton_bag(path) as bag:
        for message in messages:
            stamp = message.header.stamp
            bag.write(message, stamp.sec * 1_000_000_000 + stamp.nanosec)


def track_of_people(
    messages: Sequence[Any], *, source: str, signer: int | None = None, recorded: str | None = None
) -> SkeletonTrack:
    """A person's track from messages, wherever they come from.

    Args:
        messages: `SkeletonArray` in their order, one at least.
        source: Name of where they come from.
        signer: Id of the person; None follows whoever is marked as the signer.
        recorded: Day of the recording if it is known.

    Raises:
        LutError: "no_person", "no_torso", "bad_stamps" or "unreadable_bag".
    """
    skeletons = [_person(message.skeletons, signer) for message in messages]
    if all(skeleton is None for skeleton in skeletons):
        raise LutError("no_person", _nobody(source, [message.skeletons for message in messages], signer))
    stamps = np.array([stamp_of(message) for message in messages])
    return in_body_axes(
        times=stamps - stamps[0],
        **{name: _keypoints(skeletons, name, size) for name, size in _PARTS.items()},
        source=source,
        recorded=recorded,
        up=CAMERA_UP,
    )


def _topic(bag: Bag, path: Path, wanted: str | None) -> str:
    there = sorted(topic for topic, kind in bag.kinds.items() if kind == TYPE)
    if wanted is not None:
        if wanted in there:
            return wanted
        raise LutError(
            "no_skeletons",
            f"{path.name}: expected skeletons on {wanted}, got them on {', '.join(there) or 'no topic'}",
        )
    tracked = [topic for topic in there if not topic.startswith(TRUTH)]
    if len(tracked) == 1:
        return tracked[0]
    if "/skeletons" in tracked:
        return "/skeletons"
    raise LutError(
        "no_skeletons",
        f"{path.name}: expected one topic of skeletons, got {', '.join(there) or 'none'}: make them from the "
        "images with `ros2 run teo_skeleton_retriever retrieve`, or name the topic",
    )


def _person(skeletons: Any, signer: int | None) -> Any | None:
    wanted = (one for one in skeletons if (one.is_signer if signer is None else one.id == signer))
    return next(wanted, None)


def _nobody(source: str, people: Sequence[Any], signer: int | None) -> str:
    ids = sorted({skeleton.id for found in people for skeleton in found})
    where = f"in one of {len(people)} frames"
    if not ids:
        return f"{source}: expected a person {where}, got nobody: were head and arms in the picture?"
    wanted = "a person who is marked as the signer" if signer is None else f"the person with id {signer}"
    seen = f"the {'id' if len(ids) == 1 else 'ids'} {', '.join(map(str, ids))}"
    return f"{source}: expected {wanted} {where}, got {seen}: name who signs with --person"


def _keypoints(skeletons: list[Any], part: str, size: int) -> Keypoints:
    frames = len(skeletons)
    positions, status = np.full((frames, size, 3), np.nan), np.zeros((frames, size), np.uint8)
    sigma, confidence = np.full((2, frames, size), np.nan)
    for frame, skeleton in enumerate(skeletons):
        points = [] if skeleton is None else getattr(skeleton, part)
        if not points:
            continue
        if len(points) != size:
            raise LutError(
                "unreadable_bag",
                f"expected {size} keypoints of the {part.replace('_', ' ')} or none, "
                f"got {len(points)} in frame {frame}",
            )
        status[frame] = [point.status for point in points]
        positions[frame] = [(point.position.x, point.position.y, point.position.z) for point in points]
        sigma[frame] = np.sqrt(np.mean(np.square([point.sigma for point in points]), axis=1))
        confidence[frame] = [point.confidence for point in points]
    positions[(status == 0) | ~seen(positions)] = np.nan
    return Keypoints(positions=positions, sigma=sigma, confidence=confidence, status=status)


def _day(stamp: float) -> str | None:
    moment = datetime.datetime.fromtimestamp(stamp, tz=datetime.UTC)
    return moment.date().isoformat() if moment >= _EARLIEST else None
