# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Why nobody is in space although the detector saw people: what was seen, and the likely cause."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import DepthArray

# [m] Half of a room's depths are neither nearer nor farther than these: no depth camera measures nearer than
# 0.1 m or farther than 20 m. A thousand times too near or too far is the wrong unit, whatever the room.
_NEAREST = 0.05
_FARTHEST = 50.0
_EVERY = (
    8  # [px] Every eighth of every eighth row says how much is known and where the middle lies, in 0.1 ms.
)


def depth_summary(depth: DepthArray) -> tuple[float, float]:
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
        return f"median depth {median:.2g} m: units? 16UC1 is to be in millimetres, not in metres"
    if median > _FARTHEST:
        return f"median depth {median:.0f} m: units? 32FC1 is to be in metres, not in millimetres"
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
