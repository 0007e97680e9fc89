"""Places of articulation on a person: what `places.py` has for TEO, in the words of the synthetic signer.

Places on the body keep their names, so far as both have names; those in the air are given from the part of
the body that they are before. Arms, hands and heads of person and robot are of one size, so centimetres are
centimetres; but TEO's shoulders are nearly twice as far apart, so what it does farther aside than its hands
are long is nearer to the middle on a person.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_sign_capture.signing_space.places import OTHER_HAND, find_place

Array = NDArray[np.float64]

_ALIKE = 0.10
"""[m] From the middle: hands that meet or cross are as far apart on both."""
_BEYOND = 0.75
"""What is farther aside on TEO, on a person, whose arms begin 0.14 m nearer to the middle: stretched out to
the sides, hands are 0.9 m from the middle on TEO, 0.75 m on a person whose arms are as long."""


class PersonPlace(NamedTuple):
    """Where a person's hand goes.

    Attributes:
        at: Place of the synthetic signer's body.
        offset: From there: forwards, outwards, up [m, for an arm of 0.53 m].
    """

    at: str
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)


_PLACES = {
    "head_top": PersonPlace("crown", (0.0, 0.02, 0.0)),
    "forehead": PersonPlace("forehead", (0.0, 0.01, 0.0)),
    "temple": PersonPlace("temple"),
    "eye": PersonPlace("eye"),
    "nose": PersonPlace("nose"),
    "ear": PersonPlace("ear"),
    "cheek": PersonPlace("cheek"),
    "mouth": PersonPlace("mouth"),
    "mouth_corner": PersonPlace("mouth_corner"),
    "chin": PersonPlace("chin"),
    "throat": PersonPlace("throat"),
    "shoulder": PersonPlace("shoulder"),
    "other_shoulder": PersonPlace("other_shoulder"),
    "upper_chest": PersonPlace("upper_chest", (0.0, 0.04, 0.0)),
    "chest": PersonPlace("sternum", (0.0, 0.02, 0.0)),
    "other_chest": PersonPlace("other_chest"),
    "belly": PersonPlace("belly"),
    "space": PersonPlace("sternum", (0.195, 0.10, 0.0)),
    "low_space": PersonPlace("belly", (0.18, 0.11, 0.06)),
    "middle_space": PersonPlace("sternum", (0.19, 0.0, 0.0)),
    "shoulder_space": PersonPlace("shoulder", (0.26, 0.03, 0.03)),
    "high_space": PersonPlace("shoulder", (0.30, 0.02, 0.19)),
    "face_space": PersonPlace("mouth", (0.16, 0.02, -0.01)),
    "beside_head": PersonPlace("ear", (0.10, 0.07, 0.03)),
}


def _aside(outwards: float) -> float:
    """How far from the middle a person's hand is that is so far on TEO [m]."""
    size = abs(outwards)
    return float(np.copysign(min(size, _ALIKE) + _BEYOND * max(0.0, size - _ALIKE), outwards))


def person_place(name: str, offset: Array) -> tuple[str, list[float]]:
    """Where a person's hand goes.

    Args:
        name: One of `places.NAMES`.
        offset: From there on TEO, for a right hand, in the axes of ``base_link`` [m]. Shape (3,).

    Returns:
        The place of the synthetic signer, and the offset from it: forwards, outwards, up [m].
    """
    x, y, z = offset.tolist()
    if name in OTHER_HAND:
        return name, _rounded(x, -y, z)
    at, (forwards, outwards, up) = _PLACES[name]
    middle = -float(find_place(name).point[1])
    return at, _rounded(forwards + x, outwards + _aside(middle - y) - _aside(middle), up + z)


def _rounded(*ways: float) -> list[float]:
    """To a tenth of a millimetre, as texts have it."""
    return [round(way, 4) for way in ways]
