"""The inventory of handshapes on a person's hand, whose joints bend one by one and whose fingers spread.

Angles follow from looking at hands in these shapes, and at the signer who performs them; what a name means
stands in `handshapes.py`.
"""

from __future__ import annotations

from typing import Any

Bends = tuple[float, float, float]

# Knuckle, middle and last joint [deg].
_STRAIGHT = (2.0, 4.0, 3.0)
_FOLDED = (82.0, 95.0, 60.0)
_CROOKED = (8.0, 78.0, 48.0)
_AT_THUMB = (56.0, 48.0, 24.0)

# Spread of index to little finger towards the thumb [deg].
_TOGETHER, _FAN = (2.0, 0.0, -2.0, -5.0), (12.0, 2.0, -9.0, -20.0)

_SHAPES: dict[str, tuple[tuple[Bends, Bends, Bends, Bends], str, tuple[float, float, float, float]]] = {
    "flat": ((_STRAIGHT,) * 4, "beside", _TOGETHER),
    "open": ((_STRAIGHT,) * 4, "out", _FAN),
    "relaxed": (((14, 20, 10), (16, 22, 11), (18, 23, 12), (20, 24, 12)), "relaxed", (6, 1, -4, -10)),
    "bent": (((75, 8, 5),) * 4, "beside", _TOGETHER),
    "cupped": (((26, 32, 18),) * 4, "relaxed", _TOGETHER),
    "claw": (((25, 50, 35),) * 4, "out", _FAN),
    "bunched": (((58, 38, 18), (62, 36, 16), (60, 40, 18), (58, 46, 22)), "opposed", (-4, 0, 4, 8)),
    "fist": ((_FOLDED,) * 4, "over", _TOGETHER),
    "thumb": ((_FOLDED,) * 4, "up", _TOGETHER),
    "index": ((_STRAIGHT, _FOLDED, _FOLDED, _FOLDED), "over", _TOGETHER),
    "hook": ((_CROOKED, _FOLDED, _FOLDED, _FOLDED), "over", _TOGETHER),
    "two": ((_STRAIGHT, _STRAIGHT, _FOLDED, _FOLDED), "across", (13, -10, -4, -6)),
    "bent_two": ((_CROOKED, _CROOKED, _FOLDED, _FOLDED), "across", (10, -8, -4, -6)),
    "three": ((_STRAIGHT, _STRAIGHT, _STRAIGHT, _FOLDED), "across", (13, 0, -13, -8)),
    "four": ((_STRAIGHT,) * 4, "across", _FAN),
    "little": ((_FOLDED, _FOLDED, _FOLDED, _STRAIGHT), "over", _TOGETHER),
    "horns": ((_STRAIGHT, _FOLDED, _FOLDED, _STRAIGHT), "over", (6, 0, -2, -12)),
    "thumb_little": ((_FOLDED, _FOLDED, _FOLDED, _STRAIGHT), "up", (2, 0, -2, -14)),
    "l": ((_STRAIGHT, _FOLDED, _FOLDED, _FOLDED), "up", _TOGETHER),
    "thumb_two": ((_STRAIGHT, _STRAIGHT, _FOLDED, _FOLDED), "up", (8, -4, -4, -6)),
    "pinch": ((_AT_THUMB, _FOLDED, _FOLDED, _FOLDED), "opposed", _TOGETHER),
    "ring": ((_AT_THUMB, _STRAIGHT, _STRAIGHT, _STRAIGHT), "opposed", (0, 4, -7, -18)),
    "middle_flick": ((_STRAIGHT, _AT_THUMB, _STRAIGHT, _STRAIGHT), "opposed", (8, 0, -8, -16)),
    "two_flick": ((_AT_THUMB, _AT_THUMB, _FOLDED, _FOLDED), "opposed", _TOGETHER),
}

FINGERS = ("index", "middle", "ring", "little")

_SHARES = (1.0, 1.0, 0.5)
"""Of the angle by which a finger goes to and fro: the last joint follows the middle one at half, as they
share a tendon."""
_FAR_BENT = 50.0
"""[deg] A knuckle that is bent more has more room to open than to bend."""


def person_shape(name: str, bent: dict[str, float]) -> dict[str, Any]:
    """A handshape as scripts of the synthetic signer write it.

    Args:
        name: One of `handshapes.NAMES`.
        bent: By how much fingers, or the thumb, are bent further, or opened if bent far [deg].
    """
    fingers, thumb, spread = _SHAPES[name]
    shape: dict[str, Any] = {}
    for finger, bends in zip(FINGERS, fingers, strict=True):
        # A folded finger cannot be folded further: it goes to and fro by opening.
        further = bent.get(finger, 0.0) * (-1.0 if bends[0] > _FAR_BENT else 1.0)
        shape[finger] = [
            round(angle + share * further, 1) for angle, share in zip(bends, _SHARES, strict=True)
        ]
    shape["spread"] = list(map(float, spread))
    shape["thumb"] = thumb
    if "thumb" in bent:
        shape["thumb_bent"] = bent["thumb"]
    return shape
