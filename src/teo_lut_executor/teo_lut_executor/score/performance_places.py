"""Places of articulation on a person: what `places.py` has for TEO, in the words of the synthetic signer.

Places on the body keep their names, so far as both have names; those in the air are given from the part of
the body that they are before. A person's shoulders are 0.6 times as far apart as TEO's, measured in arms:
what TEO does to the side before its trunk, a person does nearer to the middle.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_lut_executor.score.places import OTHER_HAND

Array = NDArray[np.float64]

_TRUNK, _HEAD = 0.6, 0.85
"""What is to the side on TEO, on a person; the head's width is nearer to a person's than the shoulders'."""


class PersonPlace(NamedTuple):
    """Where a person's hand goes.

    Attributes:
        at: Place of the synthetic signer's body.
        offset: From there: forwards, outwards, up [m, for an arm of 0.53 m].
        aside: By what offsets to the side are multiplied.
    """

    at: str
    offset: tuple[float, float, float]
    aside: float


_PLACES = {
    "head_top": PersonPlace("crown", (0.0, 0.02, 0.0), _HEAD),
    "forehead": PersonPlace("forehead", (0.0, 0.01, 0.0), _HEAD),
    "temple": PersonPlace("temple", (0.0, 0.0, 0.0), _HEAD),
    "eye": PersonPlace("eye", (0.0, 0.0, 0.0), _HEAD),
    "nose": PersonPlace("nose", (0.0, 0.0, 0.0), _HEAD),
    "ear": PersonPlace("ear", (0.0, 0.0, 0.0), _HEAD),
    "cheek": PersonPlace("cheek", (0.0, 0.0, 0.0), _HEAD),
    "mouth": PersonPlace("mouth", (0.0, 0.0, 0.0), _HEAD),
    "mouth_corner": PersonPlace("mouth_corner", (0.0, 0.0, 0.0), _HEAD),
    "chin": PersonPlace("chin", (0.0, 0.0, 0.0), _HEAD),
    "throat": PersonPlace("throat", (0.0, 0.0, 0.0), _HEAD),
    "shoulder": PersonPlace("shoulder", (0.0, 0.0, 0.0), _TRUNK),
    "other_shoulder": PersonPlace("other_shoulder", (0.0, 0.0, 0.0), _TRUNK),
    "upper_chest": PersonPlace("upper_chest", (0.0, 0.03, 0.0), _TRUNK),
    "chest": PersonPlace("sternum", (0.0, 0.01, 0.0), _TRUNK),
    "other_chest": PersonPlace("other_chest", (0.0, 0.0, 0.0), _TRUNK),
    "belly": PersonPlace("belly", (0.0, 0.0, 0.0), _TRUNK),
    "space": PersonPlace("sternum", (0.215, 0.06, 0.01), _TRUNK),
    "low_space": PersonPlace("belly", (0.235, 0.07, 0.01), _TRUNK),
    "middle_space": PersonPlace("sternum", (0.215, 0.0, 0.01), _TRUNK),
    "shoulder_space": PersonPlace("shoulder", (0.26, 0.02, 0.03), _TRUNK),
    "high_space": PersonPlace("shoulder", (0.30, 0.03, 0.18), _TRUNK),
    "face_space": PersonPlace("mouth", (0.215, 0.015, -0.01), _HEAD),
    "beside_head": PersonPlace("ear", (0.10, 0.10, 0.03), _HEAD),
}


def person_place(name: str, offset: Array) -> tuple[str, list[float]]:
    """Where a person's hand goes.

    Args:
        name: One of `places.NAMES`.
        offset: From there on TEO, for a right hand, in the axes of ``base_link`` [m]. Shape (3,).

    Returns:
        The place of the synthetic signer, and the offset from it: forwards, outwards, up [m].
    """
    place = PersonPlace(name, (0.0, 0.0, 0.0), 1.0) if name in OTHER_HAND else _PLACES[name]
    forwards, outwards, up = place.offset
    x, y, z = offset.tolist()
    return place.at, [round(forwards + x, 4), round(outwards - place.aside * y, 4), round(up + z, 4)]


def person_way(name: str, way: Array) -> list[float]:
    """A way on TEO, from a place of `places.NAMES` on, as a person goes it: forwards, outwards, up [m]."""
    aside = 1.0 if name in OTHER_HAND else _PLACES[name].aside
    x, y, z = way.tolist()
    return [round(x, 4), round(-aside * y, 4), round(z, 4)]
