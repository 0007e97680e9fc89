# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The interface of a detector, what it sees in an image, and detectors by name, which are plugins."""

from __future__ import annotations

import inspect
import math
from dataclasses import dataclass
from importlib.metadata import entry_points
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D

ImageArray = NDArray[np.uint8]


class Detector(Protocol):
    """Finds people in colour images, one image after the other."""

    @property
    def name(self) -> str:
        """What `make_detector` calls it."""

    @property
    def images_at_once(self) -> int:
        """From how many threads `detect` may be called at the same time."""

    def detect(self, image: ImageArray, stamp: float) -> tuple[Person2D, ...]:
        """Find the people of one image.

        Args:
            image: RGB. Shape (height, width, 3).
            stamp: When it was taken [s].

        Returns:
            BODY_25 bodies, hands and faces [px], in no particular order; empty if nobody is there.

        Raises:
            RetrieverError: The image is none, the detector is closed, or it cannot tell; the next image may
                be tried all the same.
        """

    def close(self) -> None:
        """Release what it holds; a second call does nothing."""


def people_left_out(detector: Detector) -> int:
    """How many more people a detector sees than it follows; 0 of one that follows everybody.

    A detector with a limit has a property of this name.
    """
    return int(getattr(detector, "people_left_out", 0))


def left_out_sentence(count: int) -> str:
    """Say that people are left out, and what to do; empty if none are."""
    if not count:
        return ""
    people = "1 more person is" if count == 1 else f"{count} more people are"
    return (
        f"{people} seen than the detector follows: those who came first are followed, which need not be the "
        "nearest; let fewer into the image, or take a detector without a limit (openpose_json, openpose_onnx)"
    )


def check_image(image: ImageArray, stamp: float) -> None:
    """Check an image and its time before it is looked at.

    Raises:
        RetrieverError: Not an RGB image of bytes, an empty one, or a time that is none.
    """
    if not isinstance(image, np.ndarray) or image.dtype != np.uint8:
        got = getattr(image, "dtype", type(image).__name__)
        raise RetrieverError("bad_image", f"expected an image of uint8, got {got}")
    if image.ndim != 3 or image.shape[2] != 3 or 0 in image.shape:
        raise RetrieverError("bad_image", f"expected RGB of shape (height, width, 3), got {image.shape}")
    if not math.isfinite(stamp):
        raise RetrieverError("bad_stamp", f"expected a finite time [s], got {stamp}")


@dataclass(frozen=True, eq=False)
class DetectionFrame:
    """One image: who was seen in it, and its depth.

    Attributes:
        stamp: When it was taken [s].
        people: What the detector saw, in no particular order.
        depth: Along the optical axis [m], aligned to the colour image, NaN (or 0) where unknown.
            Shape (height, width).
        camera: Of both.

    Raises:
        RetrieverError: The stamp is not finite or the depth image has not the camera's size.
    """

    stamp: float
    people: tuple[Person2D, ...]
    depth: DepthArray
    camera: CameraModel

    def __post_init__(self) -> None:
        if not math.isfinite(self.stamp):
            raise RetrieverError("bad_stamp", f"expected a finite time [s], got {self.stamp}")
        size = (self.camera.height, self.camera.width)
        if self.depth.shape != size:
            raise RetrieverError(
                "wrong_size",
                f"expected depth of the camera's {size[1]} x {size[0]} px, got shape {self.depth.shape}; "
                "align depth to colour and take the camera_info of that resolution",
            )


# Groups of entry points: what finds people in images, and what follows them in space.
DETECTOR_GROUP = "teo_skeleton_retriever.detectors"
RETRIEVER_GROUP = "teo_skeleton_retriever.retrievers"


def plugin(group: str, name: str) -> Any:
    """Load what an installed package offers under a name.

    Args:
        group: Of the entry points.
        name: Of one of them.

    Raises:
        RetrieverError: "not_installed": no package offers it, or a package that it imports is absent.
    """
    for point in entry_points(group=group, name=name):
        try:
            return point.load()
        except ModuleNotFoundError as error:
            raise RetrieverError(
                "not_installed", f"{name}: expected the Python package {error.name}, found none; install it"
            ) from error
    raise RetrieverError(
        "not_installed",
        f"{name}: expected an installed package that offers it in the group {group}, found none; "
        "`make setup` installs all",
    )


# The names that `make_detector` knows.
DETECTORS = ("mediapipe", "openpose_json", "openpose_onnx", "replay")


def make_detector(name: str, **options: object) -> Detector:
    """Make a detector.

    Args:
        name: One of `DETECTORS`.
        options: Of that detector's constructor.

    Raises:
        RetrieverError: The name or an option is unknown, or the detector is not installed or cannot be made.
    """
    if name not in DETECTORS:
        raise RetrieverError("unknown_detector", f"expected one of {', '.join(DETECTORS)}, got {name!r}")
    detector = plugin(DETECTOR_GROUP, name)
    try:
        inspect.signature(detector).bind(**options)
    except TypeError as error:
        known = ", ".join(inspect.signature(detector).parameters)
        raise RetrieverError("bad_option", f"{name}: expected options among {known}; {error}") from error
    try:
        return cast(Detector, detector(**options))
    except TypeError as error:  # users give options as JSON: a text where a number should be, and the like
        raise RetrieverError("bad_option", f"{name}: an option is of the wrong kind: {error}") from error
