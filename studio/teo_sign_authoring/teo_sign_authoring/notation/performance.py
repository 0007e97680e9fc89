# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A score as a script that the synthetic signer performs: what a person would do who follows the score.

The way there and back is the person's: hands start hanging and hang in the end, so that the sign can be found
between. What the face does is in words that no facial action is known for; it is left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import yaml

from teo_common.arrays import Array
from teo_sign_authoring.notation.person_inventory import FINGERS, person_place, person_shape
from teo_sign_authoring.notation.score_schema import Circle, HandScore, Part, Score, Wiggle, flattened
from teo_sign_authoring.notation.targets import circle_offsets, fingers_across
from teo_sign_capture.signing_space.directions import direction, displacement
from teo_sign_capture.signing_space.places import split_place

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
        at, away = person_place(name, offset)
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
