# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Images in, people in space out: the detector and the retriever in a row, and why nobody may be in space."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, cast

import numpy as np

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.rgbd_image import RgbdImage
from teo_skeleton_retriever.detectors import Detector
from teo_skeleton_retriever.detectors.detector import RETRIEVER_GROUP, DetectionFrame, people_left_out, plugin
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_skeleton_retriever.layouts.skeleton_3d import Skeleton
from teo_skeleton_retriever.retriever import Retriever
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters

# [m] Half of a room's depths are neither nearer nor farther than these: a camera sees no trunk from nearer
# than 0.4 m, and none measures farther than 20 m. Ten times too near, as of centimetres, is the wrong unit in
# rooms of up to 4 m, a thousand times too near or a hundred too far in any.
_NEAREST = 0.4
_FARTHEST = 50.0
# [px] Every eighth of every eighth row says how much is known and where the middle lies, in 0.1 ms.
_EVERY = 8


def _depth_summary(depth: DepthArray) -> tuple[float, float]:
    """Give the part of an image's pixels that have a depth, 0 to 1, and their median [m]; NaN if none has.

    Args:
        depth: [m], NaN where unknown. Shape (height, width).
    """
    some = depth[::_EVERY, ::_EVERY]
    known = some[some > 0.0]  # of NaN nothing is true
    return len(known) / some.size, float(np.median(known)) if len(known) else float("nan")


def depth_fault(share: float, median: float) -> str:
    """Say what is wrong with depth that can be of no room, and what to do; empty if nothing is.

    Args:
        share: Part of the pixels with a depth, 0 to 1; NaN if there was no image.
        median: Of the depths [m]; NaN if there is none.
    """
    if share == 0.0:
        return (
            "no pixel of the depth image has a depth: is it on, and is the topic the one aligned to colour?"
        )
    if median < _NEAREST:
        return f"median depth {median:.2g} m: units? 16UC1 is to be in millimetres"
    if median > _FARTHEST:
        return f"median depth {median:.0f} m: units? 32FC1 is to be in metres"
    return ""


def nobody_in_space(
    *, images: int, most_people: int, share: float, median: float, least_images: int | None
) -> str:
    """Say what was seen where nobody could be placed in space, and the likely cause.

    Args:
        images: Number of images that were looked at.
        most_people: Whom the detector saw at once, at most.
        share: Part of the pixels with a depth, 0 to 1.
        median: Of the depths [m]; NaN if there is none.
        least_images: In which someone must be seen to become a person; None if that is not known.
    """
    people = "1 person" if most_people == 1 else f"{most_people} people"
    seen = f"{people} in colour, nobody in space, in {images} image{'s' * (images != 1)}: "
    if fault := depth_fault(share, median):
        return seen + fault
    if least_images is not None and images < least_images:
        return seen + (
            f"someone becomes a person after {least_images} images in which they are seen, against flickers "
            "of the detector: -p newcomer_images=1 takes everybody at once"
        )
    return seen + (
        f"median depth {median:.2f} m, none where people are: is depth aligned to colour, and are they "
        "between min_depth and max_depth? Or nobody was seen for newcomer_images images in a second"
    )


# Whose processing can be asked for: our own, or that of the original skeletonRetriever.
COMPAT_MODES = ("", "skeleton_retriever")


@dataclass(frozen=True, eq=False)
class Retrieved:
    """What was found in one image.

    Attributes:
        people: What the detector saw, in pixels.
        skeletons: Everybody who is followed, in space.
        depth_share: Part of the pixels with a depth, 0 to 1.
        depth_median: Of the depths [m]; NaN if there is none.
        detector_time: What the detector took [s].
        own_time: What all after it took [s].
        people_left_out: How many more people the detector sees than it follows.
    """

    people: tuple[Person2D, ...]
    skeletons: tuple[Skeleton, ...]
    depth_share: float
    depth_median: float
    detector_time: float
    own_time: float
    people_left_out: int = 0


@dataclass(frozen=True, eq=False)
class Detection:
    """What the detector saw in one image.

    Attributes:
        image: In which it looked.
        people: Whom it saw, in pixels.
        time: What it took [s].
        people_left_out: How many more it sees than it follows.
    """

    image: RgbdImage
    people: tuple[Person2D, ...]
    time: float
    people_left_out: int = 0


class FrameRetriever(Protocol):
    """What follows people in space."""

    def process(self, frame: DetectionFrame) -> tuple[Skeleton, ...]:
        """Take one image."""

    def lock_signer(self, track_id: int | None) -> None:
        """Follow this person as the signer; None chooses by the rule again."""

    @property
    def newcomer_images(self) -> int | None:
        """Images in which someone must be seen to become a person; None if the question is another."""


def make_retriever(
    parameters: RetrieverParameters,
    compat: str,
    compat_options: Sequence[str] = (),
    *,
    recorded: bool = False,
) -> FrameRetriever:
    """Make what follows people in space.

    Args:
        parameters: Of ours.
        compat: One of `COMPAT_MODES`; another than ours is a plugin.
        compat_options: Of that plugin.
        recorded: Whether images are of a recording, whose first one counts at once.

    Raises:
        RetrieverError: No such mode or option, or the plugin is not installed.
    """
    if compat not in COMPAT_MODES:
        raise RetrieverError("unknown_choice", f"compat: expected one of {COMPAT_MODES}, got {compat!r}")
    if compat:
        return cast(FrameRetriever, plugin(RETRIEVER_GROUP, compat)(parameters, compat_options))
    if any(compat_options):
        raise RetrieverError("bad_option", "expected compat with compat_options, got none")
    return Retriever(parameters, recorded=recorded)


class ImageRetriever:
    """A detector and a retriever in a row.

    `detect` may run in one thread, or as many as the detector allows, while `follow` runs in another.
    """

    def __init__(self, detector: Detector, retriever: FrameRetriever) -> None:
        self._detector = detector
        self._retriever = retriever
        self.known_ids: frozenset[int] = frozenset()
        """Who was in the last image that was processed."""

    def replace(self, retriever: FrameRetriever) -> None:
        """Go on with other parameters; everybody followed so far is forgotten."""
        self._retriever = retriever

    def lock_signer(self, track_id: int | None) -> None:
        """Follow this person as the signer; None chooses by the rule again."""
        self._retriever.lock_signer(track_id)

    @property
    def newcomer_images(self) -> int | None:
        """Images in which someone must be seen to become a person; None if it is the original's question."""
        return self._retriever.newcomer_images

    def process(self, image: RgbdImage) -> Retrieved:
        """Take one image.

        Raises:
            RetrieverError: The detector cannot tell, or the parts do not fit together; the next image may be
                given all the same.
        """
        return self.follow(self.detect(image))

    def detect(self, image: RgbdImage) -> Detection:
        """Take one image, the first half; see `process`."""
        began = time.perf_counter()
        people = self._detector.detect(image.color, image.stamp)
        took = time.perf_counter() - began
        return Detection(image, people, took, people_left_out(self._detector))

    def follow(self, detected: Detection) -> Retrieved:
        """Take one image, the second half; see `process`."""
        began = time.perf_counter()
        image, people = detected.image, detected.people
        skeletons = self._retriever.process(
            DetectionFrame(stamp=image.stamp, people=people, depth=image.depth, camera=image.camera)
        )
        self.known_ids = frozenset(skeleton.track_id for skeleton in skeletons)
        share, median = _depth_summary(image.depth)
        return Retrieved(
            people,
            skeletons,
            share,
            median,
            detected.time,
            time.perf_counter() - began,
            detected.people_left_out,
        )

    def close(self) -> None:
        """Release what the detector holds."""
        self._detector.close()
