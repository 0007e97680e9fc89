# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keypoints that are known already: from a list, or from a whole folder that OpenPose wrote."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from teo_skeleton_retriever.detectors.detector import ImageArray, check_image
from teo_skeleton_retriever.detectors.openpose.openpose_folder import StampTable
from teo_skeleton_retriever.detectors.openpose.openpose_json_detector import OpenPoseJsonDetector
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25


class ReplayDetector:
    """Gives what is known for the time of an image; nobody where nothing is known.

    Args:
        frames: The time [s] and the people of each image, in any order.
        folder: Instead, a folder of OpenPose's files that is written already.
        stamps: The time of each file's number; see `StampTable`. Without it, the images are those of the
            files in their order.

    Raises:
        RetrieverError: Neither frames nor folder, or both, or what `OpenPoseJsonDetector` raises.
    """

    name = "replay"
    images_at_once = 1

    def __init__(
        self,
        *,
        frames: Sequence[tuple[float, Sequence[Person2D]]] | None = None,
        folder: str | Path | None = None,
        stamps: Mapping[int, float] | Mapping[str, float] | str | Path | None = None,
    ) -> None:
        if (frames is None) == (folder is None) or (folder is None and stamps is not None):
            raise RetrieverError("bad_option", "expected either frames, or a folder with or without stamps")
        self._folder = (
            None if folder is None else OpenPoseJsonDetector(folder=folder, stamps=stamps, wait=0.0)
        )
        self._frames = [
            (stamp, tuple(replace(person, body=as_body_25(person.body)) for person in people))
            for stamp, people in frames or ()
        ]
        self._table = (
            StampTable({i: stamp for i, (stamp, _) in enumerate(self._frames)}) if self._frames else None
        )
        self._closed = False

    def detect(self, image: ImageArray, stamp: float) -> tuple[Person2D, ...]:
        """Give the people of that time; see `Detector.detect`."""
        if self._closed:
            raise RetrieverError("closed", "expected an open detector, got one that was closed")
        if self._folder is not None:
            return self._folder.detect(image, stamp)
        check_image(image, stamp)
        number = None if self._table is None else self._table.number_at(stamp)
        return () if number is None else self._frames[number][1]

    def close(self) -> None:
        """Give nothing any more."""
        self._closed = True
