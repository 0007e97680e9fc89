"""OpenPose's 70 face keypoints: the 68 of the iBUG annotation, then the pupils.

Left and right are the person's.
"""

from __future__ import annotations

from itertools import pairwise

from teo_skeleton_retriever.layouts.layout import Layout

PARTS: dict[str, range] = {
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
CLOSED = frozenset({"REye", "LEye", "OuterLip", "InnerLip"})
"""Parts whose last keypoint is joined to their first."""

_KEYPOINTS = tuple(f"Face{i}" for part in PARTS.values() for i in part)


def _bones() -> tuple[tuple[str, str], ...]:
    pairs: list[tuple[int, int]] = []
    for name, part in PARTS.items():
        pairs += pairwise(part)
        if name in CLOSED:
            pairs.append((part[-1], part[0]))
    return tuple((_KEYPOINTS[a], _KEYPOINTS[b]) for a, b in pairs)


FACE_70 = Layout("FACE_70", _KEYPOINTS, _bones())
