# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which keypoints there are, in which order they come and how they are drawn: bodies, hands and faces.

Source: `poseParameters.cpp` and `handParameters.hpp` of OpenPose 1.7 and its documentation. Left and right
are the person's.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise


@dataclass(frozen=True)
class Layout:
    """A fixed order of named keypoints.

    Attributes:
        name: Of the layout, as its authors call it.
        keypoints: Names, in the order of the data.
        bones: Pairs of names that are joined when the skeleton is drawn.
    """

    name: str
    keypoints: tuple[str, ...]
    bones: tuple[tuple[str, str], ...]

    @cached_property
    def index(self) -> dict[str, int]:
        """Place of each name in the data."""
        return {keypoint: i for i, keypoint in enumerate(self.keypoints)}

    def __len__(self) -> int:
        return len(self.keypoints)


def _bones_of(keypoints: tuple[str, ...], pairs: str) -> tuple[tuple[str, str], ...]:
    """Read bones from a table of index pairs, such as "0-1 1-2"; a longer run "0-1-2" is its pairs."""
    runs = [[keypoints[int(i)] for i in run.split("-")] for run in pairs.split()]
    return tuple(pair for run in runs for pair in pairwise(run))


_BODY_25 = (
    *("Nose", "Neck"),  # 0, 1
    *("RShoulder", "RElbow", "RWrist"),  # 2 to 4
    *("LShoulder", "LElbow", "LWrist"),  # 5 to 7
    "MidHip",  # 8
    *("RHip", "RKnee", "RAnkle"),  # 9 to 11
    *("LHip", "LKnee", "LAnkle"),  # 12 to 14
    *("REye", "LEye", "REar", "LEar"),  # 15 to 18
    *("LBigToe", "LSmallToe", "LHeel"),  # 19 to 21
    *("RBigToe", "RSmallToe", "RHeel"),  # 22 to 24
)
_BODY_25_PAIRS = """
    1-8 1-2 1-5 2-3 3-4 5-6 6-7 8-9 9-10 10-11 8-12 12-13 13-14
    1-0 0-15 15-17 0-16 16-18 14-19 19-20 14-21 11-22 22-23 11-24
"""

BODY_25 = Layout("BODY_25", _BODY_25, _bones_of(_BODY_25, _BODY_25_PAIRS))


_COCO_18 = (
    *("Nose", "Neck"),  # 0, 1
    *("RShoulder", "RElbow", "RWrist"),  # 2 to 4
    *("LShoulder", "LElbow", "LWrist"),  # 5 to 7
    *("RHip", "RKnee", "RAnkle"),  # 8 to 10
    *("LHip", "LKnee", "LAnkle"),  # 11 to 13
    *("REye", "LEye", "REar", "LEar"),  # 14 to 17
)
_COCO_18_PAIRS = "1-2 1-5 2-3 3-4 5-6 6-7 1-8 8-9 9-10 1-11 11-12 12-13 1-0 0-14 14-16 0-15 15-17"

COCO_18 = Layout("COCO", _COCO_18, _bones_of(_COCO_18, _COCO_18_PAIRS))

_HAND_21 = (
    "Wrist",  # 0
    *("ThumbCMC", "ThumbMCP", "ThumbIP", "ThumbTip"),  # 1 to 4
    *("IndexMCP", "IndexPIP", "IndexDIP", "IndexTip"),  # 5 to 8
    *("MiddleMCP", "MiddlePIP", "MiddleDIP", "MiddleTip"),  # 9 to 12
    *("RingMCP", "RingPIP", "RingDIP", "RingTip"),  # 13 to 16
    *("PinkyMCP", "PinkyPIP", "PinkyDIP", "PinkyTip"),  # 17 to 20
)
_HAND_21_PAIRS = "0-1-2-3-4 0-5-6-7-8 0-9-10-11-12 0-13-14-15-16 0-17-18-19-20"

HAND_21 = Layout("HAND_21", _HAND_21, _bones_of(_HAND_21, _HAND_21_PAIRS))


FACE_PARTS: dict[str, range] = {
    "Jaw": range(0, 17),  # from the right ear over the chin (8) to the left ear
    "RBrow": range(17, 22),
    "LBrow": range(22, 27),
    "NoseBridge": range(27, 31),
    "Nostrils": range(31, 36),
    "REye": range(36, 42),
    "LEye": range(42, 48),
    "OuterLip": range(48, 60),
    "InnerLip": range(60, 68),
    "RPupil": range(68, 69),
    "LPupil": range(69, 70),
}
# Parts whose last keypoint is joined to their first.
_CLOSED_FACE_PARTS = frozenset({"REye", "LEye", "OuterLip", "InnerLip"})

_FACE_70 = tuple(f"Face{i}" for part in FACE_PARTS.values() for i in part)


def _face_bones() -> tuple[tuple[str, str], ...]:
    pairs: list[tuple[int, int]] = []
    for name, part in FACE_PARTS.items():
        pairs += pairwise(part)
        if name in _CLOSED_FACE_PARTS:
            pairs.append((part[-1], part[0]))
    return tuple((_FACE_70[a], _FACE_70[b]) for a, b in pairs)


FACE_70 = Layout("FACE_70", _FACE_70, _face_bones())
