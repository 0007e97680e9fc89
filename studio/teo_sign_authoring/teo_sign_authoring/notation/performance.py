# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A score as a script that the synthetic signer performs: what a person would do who follows the score.

The way there and back is the person's: hands start hanging and hang in the end, so that the sign can be found
between. What the face does is in words that no facial action is known for; it is left out.

Places on the body keep their names, so far as TEO and the person both have names (`signing_space`);
those in the air are given from the part of the body that they are before. Arms, hands and heads of person and
robot are of one size, so centimetres are centimetres; but TEO's shoulders are nearly twice as far apart, so
what it does farther aside than its hands are long is nearer to the middle on a person. A person's finger
joints bend one by one, and fingers spread: handshapes are those of `teo_synthetic_signer.body.hand`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import yaml

from teo_common.arrays import Array
from teo_sign_authoring.notation.score_schema import Circle, HandScore, Part, Score, Wiggle, flattened
from teo_sign_authoring.notation.targets import circle_offsets, fingers_across
from teo_sign_capture.signing_space import (
    OTHER_HAND,
    direction,
    displacement,
    split_place,
    written_place,
)
from teo_synthetic_signer.body.hand import FINGERS, HAND_ANGLES

# [m] From the middle: hands that meet or cross are as far apart on both.
_ALIKE = 0.10
# What is farther aside on TEO, on a person, whose arms begin 0.14 m nearer to the middle: stretched out to
# the sides, hands are 0.9 m from the middle on TEO, 0.75 m on a person whose arms are as long.
_BEYOND = 0.75


class _PersonPlace(NamedTuple):
    """Where a person's hand goes.

    Attributes:
        at: Place of the synthetic signer's body.
        offset: From there: forwards, outwards, up [m, for an arm of 0.53 m].
    """

    at: str
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)


_PLACES = {
    "head_top": _PersonPlace("crown", (0.0, 0.02, 0.0)),
    "forehead": _PersonPlace("forehead", (0.0, 0.01, 0.0)),
    "temple": _PersonPlace("temple"),
    "eye": _PersonPlace("eye"),
    "nose": _PersonPlace("nose"),
    "ear": _PersonPlace("ear"),
    "cheek": _PersonPlace("cheek"),
    "mouth": _PersonPlace("mouth"),
    "mouth_corner": _PersonPlace("mouth_corner"),
    "chin": _PersonPlace("chin"),
    "throat": _PersonPlace("throat"),
    "shoulder": _PersonPlace("shoulder"),
    "other_shoulder": _PersonPlace("other_shoulder"),
    "upper_chest": _PersonPlace("upper_chest", (0.0, 0.04, 0.0)),
    "chest": _PersonPlace("sternum", (0.0, 0.02, 0.0)),
    "other_chest": _PersonPlace("other_chest"),
    "belly": _PersonPlace("belly"),
    "space": _PersonPlace("sternum", (0.195, 0.10, 0.0)),
    "low_space": _PersonPlace("belly", (0.18, 0.11, 0.06)),
    "middle_space": _PersonPlace("sternum", (0.19, 0.0, 0.0)),
    "shoulder_space": _PersonPlace("shoulder", (0.26, 0.03, 0.03)),
    "high_space": _PersonPlace("shoulder", (0.30, 0.02, 0.19)),
    "face_space": _PersonPlace("mouth", (0.16, 0.02, -0.01)),
    "beside_head": _PersonPlace("ear", (0.10, 0.07, 0.03)),
}


def _aside(outwards: float) -> float:
    """How far from the middle a person's hand is that is so far on TEO [m]."""
    size = abs(outwards)
    return float(np.copysign(min(size, _ALIKE) + _BEYOND * max(0.0, size - _ALIKE), outwards))


def _person_place(name: str, offset: Array) -> tuple[str, list[float]]:
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
    middle = -float(written_place(name).point[1])
    return at, _rounded(forwards + x, outwards + _aside(middle - y) - _aside(middle), up + z)


def _rounded(*ways: float) -> list[float]:
    """To a tenth of a millimetre, as texts have it."""
    return [round(way, 4) for way in ways]


# Handshapes that the synthetic signer has under another name.
_RENAMED = {
    "relaxed": "loose",
    "hook": "crooked",
    "two": "v",
    "three": "w",
    "thumb": "thumb_up",
    "thumb_little": "y",
}

# Shares of the angle by which a finger goes to and fro, by joint: the last joint follows the middle one at
# half, as they share a tendon.
_SHARES = (1.0, 1.0, 0.5)
# [deg] A knuckle that is bent more has more room to open than to bend.
_FAR_BENT = 50.0


def person_shape(name: str, bent: Mapping[str, float] = MappingProxyType({})) -> str | dict[str, Any]:
    """A handshape as scripts of the synthetic signer write it: its name, or in full where fingers are bent.

    Args:
        name: One of `handshapes.NAMES`.
        bent: By how much fingers, or the thumb, are bent further, or opened if bent far [deg].
    """
    name = _RENAMED.get(name, name)
    if not bent:
        return name
    angles = HAND_ANGLES[name]
    shape: dict[str, Any] = {}
    for finger, bends in zip(FINGERS, angles.fingers, strict=True):
        # A folded finger cannot be folded further: it goes to and fro by opening.
        further = bent.get(finger, 0.0) * (-1.0 if bends[0] > _FAR_BENT else 1.0)
        shape[finger] = [
            round(angle + share * further, 1) for angle, share in zip(bends, _SHARES, strict=True)
        ]
    shape |= {"spread": list(map(float, angles.spread)), "thumb": angles.thumb}
    return shape | ({"thumb_bent": bent["thumb"]} if "thumb" in bent else {})


# [s] The hands hang before and after a sign: longer than any hold, so that rest is told from sign.
REST = 0.5
# [s] From there to the first posture, and back: 0.6 m at a peak of 2 m/s, as fast as signers are.
WAY = 0.6
# [s] A step without time is gone at one image of a camera: no hand is in two places at once.
_LEAST_MOVE = 0.04
# Key poses on a circle's round; what is between follows the circle to 1 % of its radius.
_PER_TURN = 12

# Parts that the synthetic signer has another word for.
_POINTS: dict[Part, str] = {"index": "index_tip", "thumb": "thumb_tip"}


@dataclass(frozen=True, kw_only=True)
class Performance:
    """A score as a script.

    Attributes:
        text: The script's file (YAML).
        start: When the hands are in the first posture [s].
        end: When they leave the last one [s].
    """

    text: str
    start: float
    end: float


@dataclass(frozen=True)
class _Hand:
    """What a score has said of a hand so far."""

    shape: str = ""
    place: str = ""
    part: Part = "palm"
    palm: str = ""
    fingers: str = ""

    def told(self, score: HandScore | None) -> _Hand:
        if score is None:
            return self
        return replace(self, **{name: value for name, value in dict(score).items() if value is not None})

    def arm(
        self,
        way: Array | None = None,
        bent: dict[str, float] | None = None,
        swing: dict[str, float] | None = None,
    ) -> dict[str, Any]:
        """The arm as scripts write it: a way from its place, fingers bent and joints swung [deg]."""
        name, offset = split_place(self.place)
        at, away = _person_place(name, offset)
        if way is not None:
            x, y, z = way.tolist()
            away = [round(a + b, 4) for a, b in zip(away, (x, -y, z), strict=True)]
        palm = direction(self.palm)
        fingers = fingers_across(palm, direction(self.fingers))
        written = {
            "at": at,
            "offset": away,
            "point": _POINTS.get(self.part, self.part),
            "fingers": _forwards_outwards_up(fingers),
            "palm": _forwards_outwards_up(palm),
            "shape": person_shape(self.shape, bent or {}),
        }
        return written | ({"swing": swing} if swing else {})


def performance(score: Score) -> Performance:
    """Write the script of a score."""
    keys = list(_keys(score))
    moving = sum(key["move"] + key.get("hold", 0.0) for key in keys[1:])
    hanging = {"right": "hanging", "left": "hanging", "head": [0.0, 0.0, 0.0]}
    first = hanging | {"move": WAY, "hold": REST}
    keys = [first, keys[0] | {"move": WAY}, *keys[1:], first]
    start = REST + WAY
    script = {
        "about": f"{score.gloss}, performed from its score ({score.standing}: {score.source})"[:500],
        "keys": keys,
    }
    text = yaml.dump(
        script, Dumper=_Plain, allow_unicode=True, sort_keys=False, default_flow_style=None, width=110
    )
    return Performance(text=text, start=start, end=start + keys[1].get("hold", 0.0) + moving)


class _Plain(yaml.SafeDumper):
    """Writes what occurs twice twice: a reader need not look it up."""

    def ignore_aliases(self, _data: object) -> bool:
        return True


def _keys(score: Score) -> Iterator[dict[str, Any]]:
    """The key poses of a sign; the `move` of the first has no meaning."""
    hands = {"right": _Hand()} if score.hands == "right" else {"right": _Hand(), "left": _Hand()}
    for step in flattened(score.steps):
        said = {"right": step.right, "left": step.right if score.hands == "mirrored" else step.left}
        hands = {side: hand.told(said[side]) for side, hand in hands.items()}
        key: dict[str, Any] = {side: hand.arm() for side, hand in hands.items()}
        key["move"] = max(step.time, _LEAST_MOVE)
        if step.head is not None:
            key["head"] = [-step.head.turn, step.head.bow, 0.0]
        if step.arc is not None:
            x, y, z = (0.01 * displacement(step.arc)).tolist()
            key["bulge"] = [x, -y, z]
        movement = [*_circle(step.circle, hands), *_wiggle(step.wiggle, hands)]
        ([key, *movement])[-1]["hold"] = step.hold
        yield key
        yield from movement


def _circle(circle: Circle | None, hands: dict[str, _Hand]) -> Iterator[dict[str, Any]]:
    if circle is None:
        return
    count = max(2, round(_PER_TURN * circle.turns))
    for index, way in enumerate(circle_offsets(circle, count), start=1):
        key: dict[str, Any] = {
            side: hand.arm(way if circle.hand in (None, side) else None) for side, hand in hands.items()
        }
        yield key | {"move": circle.time / count} | ({"through": True} if index < count else {})


def _wiggle(wiggle: Wiggle | None, hands: dict[str, _Hand]) -> Iterator[dict[str, Any]]:
    if wiggle is None:
        return
    count = 2 * wiggle.times
    for index in range(1, count + 1):
        key: dict[str, Any] = {
            side: hand.arm(None, *_bent(wiggle, hand, away=index % 2 == 1))
            if wiggle.hand in (None, side)
            else hand.arm()
            for side, hand in hands.items()
        }
        yield key | {"move": wiggle.time / count}


def _bent(wiggle: Wiggle, hand: _Hand, *, away: bool) -> tuple[dict[str, float], dict[str, float]]:
    """Fingers bent and joints swung at one end of a wiggle [deg]."""
    joint, angle = wiggle.joint, wiggle.angle
    if joint == "fingers":
        # Every other finger, so that they flutter.
        return {finger: angle for place, finger in enumerate(FINGERS) if away == (place % 2 == 0)}, {}
    if not away:
        return {}, {}
    if joint in ("wrist", "elbow"):
        return {}, {joint: angle}
    if joint == "forearm":
        # To the side that a forearm has more room on: a palm that looks up cannot be turned further up.
        return {}, {joint: -angle if direction(hand.palm)[2] > 0.5 else angle}
    return {joint: angle}, {}


def _forwards_outwards_up(way: Array) -> list[float]:
    """A way in ``base_link`` for a right hand, as scripts write ways."""
    x, y, z = (way / np.linalg.norm(way)).tolist()
    return [round(x, 4), round(-y, 4), round(z, 4)]
