"""What OpenPose saw in one image."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.openpose.openpose_names import VERSION
from teo_skeleton_retriever.layouts.person_2d import Person2D


@dataclass(frozen=True, eq=False)
class OpenPoseFrame:
    """All people of one image.

    Attributes:
        people: in OpenPose's order, which says nothing about who is who in the next image.
        part_candidates: body parts before they were assembled to people: x, y [px], score by body part index.
            Shape (n, 3) each; empty without `--part_candidates`.
        version: of the file format.
    """

    people: tuple[Person2D, ...]
    part_candidates: Mapping[int, FloatArray] = field(default_factory=dict)
    version: float = VERSION
