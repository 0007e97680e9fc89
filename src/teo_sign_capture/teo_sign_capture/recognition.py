# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The signs of a table that look most like what somebody shows, and which parts of a sign differ.

In each frame a hand shows where the palm is, the ways palm and fingers point, and how the fingers are bent. A
person's hand is taken half-way between where it belongs on TEO (`BodyMap`) and where TEO's arm brings it,
collisions left aside, which take most of the time of a capture. Signs that were written down are nearer to
the one, signs that were captured are the other; where TEO's arm falls short both are 20 cm apart.

Numbers are in units of what a person's sign differs by from its own entry: what a film of one camera tells
badly, as how far forward a hand is, counts less than what it tells well, as which fingers are bent. Of units
around what was measured of known takes (`bench/recognition.py`) those by which the right entry is nearest.

Time is warped by the library dtaidistance. Most signs are never compared, because a lower bound of their
distance (Keogh and Ratanamahatana, Knowledge and Information Systems 7, 2005: how far the shown leaves the
band that a sign can be warped in) already exceeds the distance of the best ones found.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from dtaidistance import dtw_ndim  # type: ignore[import-untyped]  # ships no types
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from teo_common.arrays import Array
from teo_description.humanoid import SIDES
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, ArmPoses, mirrored, mirrored_hand
from teo_sign_capture.retarget.hand_goals import HandGoals
from teo_sign_capture.retarget.robot_motion import free_motion
from teo_sign_capture.tracks.segmentation import the_sign
from teo_sign_capture.tracks.signer_motion import SignerMotion, measure_person, signer_motion
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_sign_capture.tracks.smoothing import smooth_track
from teo_signs.errors import LutError
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut, user_lut_directory
from teo_signs.sign import Sign
from teo_signs.sign_schema import Handedness

# Moments of a sign, evenly spread: of a sign of 1.5 s every 50 ms.
MOMENTS = 32
# [m] Units of places forwards, left and up. Forwards is what a film does not show, and where TEO's hand goes
# if its elbow does not fold as far as a person's.
_PLACE = np.array([0.16, 0.056, 0.056])
# [rad] Units of the ways of palm and fingers. TEO's wrist bends to the side only, for which the fingers pay.
_PALM, _FINGERS = 0.35, 0.6
# [rad] Units of the bends: of the thumb's two axes, whose joints are the farthest from a person's, and of the
# four fingers.
_BENDS = np.array([0.6, 0.6, 0.35, 0.35, 0.35, 0.35])
# What a hand that takes part differs by from one that does not [units].
_PRESENT = 4.0
# Numbers of a hand: presence, place, way of the palm, way of the fingers, six bends.
HAND = 1 + 3 + 3 + 3 + 6


class PARTS:
    """Where the parts of a hand are among its numbers."""

    presence = 0
    place = slice(1, 4)
    turns = slice(4, 10)
    bends = slice(10, HAND)


def sign_appearance(robot: Robot, sign: Sign) -> Array:
    """What a sign of the table shows. Shape (MOMENTS, 2 hands of 16 numbers)."""
    moments = np.linspace(0.0, sign.duration, MOMENTS)
    positions = np.column_stack([np.interp(moments, sign.times, column) for column in sign.knots.T])
    chain = _arm_of(robot)
    hands: dict[str, Array] = {}
    humanoid = robot.humanoid
    for side in SIDES:
        arm, hand = humanoid.arm(side), humanoid.hand(side)
        if not set(arm + hand) <= set(sign.joints):
            continue
        joints = positions[:, [sign.joints.index(joint) for joint in arm]]
        bends = positions[:, [sign.joints.index(joint) for joint in hand]]
        if side == "left":
            joints, bends = mirrored(humanoid, joints), mirrored_hand(humanoid, bends)
        poses = chain.poses(joints)
        hands[side] = _of_arm(poses, bends)
    return _both(hands)


def recording_appearance(
    robot: Robot,
    track: SkeletonTrack,
    *,
    start: float | None = None,
    end: float | None = None,
    handedness: Handedness | None = None,
) -> Array:
    """What the one sign of a recording shows. Shape (MOMENTS, 2 hands of 16 numbers).

    Args:
        robot: The robot.
        track: The person, as recorded.
        start: Where to begin looking [s]; the recording's beginning without.
        end: Where to stop [s]; the recording's end without.
        handedness: Hands that make the sign; those that leave rest without.

    Raises:
        LutError: "empty_track", "no_motion", "several_signs", "too_long", "no_arm" or "no_hand".
    """
    smooth = smooth_track(track).track
    span = the_sign(smooth, start=start, end=end)
    stroke = smooth.between(span.start, span.end)
    signer = signer_motion(stroke, handedness=handedness or span.handedness, person=measure_person(track))
    return _demonstration_appearance(robot, signer)


def _demonstration_appearance(robot: Robot, signer: SignerMotion) -> Array:
    """What a person shows. Shape (MOMENTS, 2 hands of 16 numbers).

    A left hand alone is taken for the right one in a mirror, as left-handed signers sign.
    """
    free = free_motion(robot, signer)
    moments = np.linspace(0.0, float(signer.times[-1]), MOMENTS)
    hands: dict[str, Array] = {}
    for side, hand in free.hands.items():
        bends = hand.axes
        shown = (_wanted(free.goals[side], bends) + _of_arm(free.poses(side, free.arms), bends)) / 2.0
        hands[side] = np.column_stack([np.interp(moments, signer.times, column) for column in shown.T])
    return _both(hands)


@cache
def _arm_of(robot: Robot) -> ArmKinematics:
    """Made once: for each sign of a table it would take more than half of its time."""
    return ArmKinematics(robot)


def _wanted(goals: HandGoals, bends: Array) -> Array:
    """A hand where it belongs. Shape (T, HAND)."""
    rotation = np.stack([goals.fingers, np.cross(goals.palm, goals.fingers), goals.palm], axis=2)
    place = goals.place - np.einsum("tij,tj->ti", rotation, goals.local)
    return _hand(place, goals.palm, goals.fingers, bends)


def _of_arm(poses: ArmPoses, bends: Array) -> Array:
    """A hand where an arm has it. Shape (T, HAND)."""
    return _hand(poses.place, poses.rotation[:, :, 2], poses.rotation[:, :, 0], bends)


def _hand(place: Array, palm: Array, fingers: Array, bends: Array) -> Array:
    present = np.full((len(place), 1), _PRESENT)
    return np.concatenate([present, place / _PLACE, palm / _PALM, fingers / _FINGERS, bends / _BENDS], axis=1)


def _both(hands: dict[str, Array]) -> Array:
    """The leading hand and the other; zeros of one that takes no part."""
    absent = np.zeros((MOMENTS, HAND))
    if "right" not in hands:
        return np.concatenate([hands.get("left", absent), absent], axis=1)
    return np.concatenate([hands["right"], hands.get("left", absent)], axis=1)


# Moments by which one sign may be ahead of another: a quarter of it, as a hold or a beat may be longer.
AHEAD = 8
# How many signs are named if nobody says otherwise.
COUNT = 5


@dataclass(frozen=True, kw_only=True)
class Match:
    """A sign of the table that looks like what was shown.

    Attributes:
        gloss: Its name.
        distance: Root mean square over the warped sign of all that differs, in this module's units: 2
            to 4 between a person's sign and its own entry.
    """

    gloss: str
    distance: float


class SignIndex:
    """The signs of a table, ready to be compared with."""

    def __init__(self, glosses: Iterable[str], shown: Array) -> None:
        """Keep what signs show.

        Args:
            glosses: Their N names.
            shown: As `sign_appearance` gives it. Shape (N, MOMENTS, d).
        """
        self._glosses = tuple(glosses)
        self._shown = np.ascontiguousarray(shown, dtype=np.float64)
        width = 2 * AHEAD + 1
        self._highest = maximum_filter1d(self._shown, width, axis=1, mode="nearest")
        self._lowest = minimum_filter1d(self._shown, width, axis=1, mode="nearest")

    @classmethod
    def of_signs(cls, robot: Robot, signs: Iterable[Sign]) -> SignIndex:
        """Index signs, of which there is at least one."""
        listed = list(signs)
        return cls([sign.gloss for sign in listed], np.array([sign_appearance(robot, s) for s in listed]))

    def nearest(self, shown: Array, count: int = COUNT) -> tuple[Match, ...]:
        """The signs most like what is shown, the most alike first.

        Args:
            shown: Shape (MOMENTS, d).
            count: How many; fewer if there are fewer.
        """
        shown = np.ascontiguousarray(shown, dtype=np.float64)
        bounds = self.lower_bounds(shown)
        found: list[tuple[float, int]] = []
        for index in np.argsort(bounds, kind="stable").tolist():
            if len(found) == count and bounds[index] >= found[-1][0]:
                break
            found.append((distance_between(shown, self._shown[index]), index))
            found = sorted(found)[:count]
        return tuple(Match(gloss=self._glosses[index], distance=distance) for distance, index in found)

    def lower_bounds(self, shown: Array) -> Array:
        """What no sign is nearer than, however it is warped. Shape (N,)."""
        outside = np.maximum(shown - self._highest, self._lowest - shown)
        np.maximum(outside, 0.0, out=outside)
        bounds: Array = np.sqrt(np.einsum("nmd,nmd->n", outside, outside) / MOMENTS)
        return bounds


def distance_between(shown: Array, sign: Array) -> float:
    """`Match.distance` of two signs, each of shape (MOMENTS, d), contiguous."""
    # The library counts the diagonal as one.
    warped = dtw_ndim.distance_fast(shown, sign, window=AHEAD + 1)
    return float(warped) / float(np.sqrt(MOMENTS))


# [units] By how much the next form is farther than a sign that stands out. Of 54 films whose sign the table
# holds the first was right in 20 of 21 that did, in 13 of 33 others; of 60 whose sign it does not hold 48 did
# not.
_STANDS_OUT = 0.5


def stands_out(matches: Sequence[Match]) -> bool:
    """Whether the first of the nearest signs is surely what was shown; else one of them, or none at all.

    Names of one motion, which are equally far, count as one.
    """
    first = matches[0].distance
    return any(match.distance > first for match in matches) and all(
        match.distance == first or match.distance >= first + _STANDS_OUT for match in matches
    )


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """How what was shown differs from a sign, by the parts of which signs are made (Stokoe 1960).

    Differences are root mean squares over the sign, its time warped, of the hand that differs more, in the
    module's units: 1 is what a person's sign differs by from its entry in half of the known takes, 4
    what another sign does.

    Attributes:
        gloss: The sign.
        distance: Of both, as `Match.distance`.
        hands: Whether the same number of hands take part. Of a hand that does so in one of them alone nothing
            else is said.
        handshape: By the bends of the fingers.
        orientation: By the ways palm and fingers point.
        place: By where the hand is on the whole.
        movement: By the hand's way from there.
    """

    gloss: str
    distance: float
    hands: bool
    handshape: float
    orientation: float
    place: float
    movement: float


def compare(gloss: str, shown: Array, sign: Array) -> Comparison:
    """Compare what was shown with a sign.

    Args:
        gloss: The sign's name.
        shown: As `recording_appearance` gives it. Shape (MOMENTS, 2 * HAND).
        sign: As `sign_appearance` gives it; of the same shape.
    """
    shown, sign = (np.ascontiguousarray(given, dtype=np.float64) for given in (shown, sign))
    path = np.array(dtw_ndim.warping_path(shown, sign, window=AHEAD + 1))
    apart = shown[path[:, 0]] - sign[path[:, 1]]
    taking_part = [
        (bool(shown[0, first + PARTS.presence]), bool(sign[0, first + PARTS.presence])) for first in (0, HAND)
    ]
    hands = [
        _by_part(apart[:, first : first + HAND])
        for first, parts in zip((0, HAND), taking_part, strict=True)
        if all(parts)
    ]
    worst = np.max(hands, axis=0) if hands else np.zeros(4)
    handshape, orientation, place, movement = np.round(worst, 3).tolist()
    return Comparison(
        gloss=gloss,
        distance=round(distance_between(shown, sign), 3),
        hands=all(one == other for one, other in taking_part),
        handshape=handshape,
        orientation=orientation,
        place=place,
        movement=movement,
    )


def _by_part(apart: Array) -> Array:
    """Handshape, orientation, place and movement of one hand's differences. Shape (4,)."""
    where = apart[:, PARTS.place]
    place = where.mean(axis=0)
    parts = (apart[:, PARTS.bends], apart[:, PARTS.turns], place[None, :], where - place)
    return np.array([np.sqrt((part**2).sum(axis=1).mean()) for part in parts])


# Signs whose largest difference is below two of those that are just seen are told apart only by who looks for
# it; no two words of the shipped table are below one.
_ALIKE = 2.0


@dataclass(frozen=True, kw_only=True)
class SimilarSign:
    """A sign of the table beside a new one.

    Attributes:
        gloss: Its name.
        seen: The largest difference of both [differences that are just seen]; 0 of one and the same motion.
    """

    gloss: str
    seen: float

    def warning(self, gloss: str) -> str | None:
        """What the teacher of a new sign should know; None where both are told apart."""
        if self.seen == 0.0:
            return f"{gloss} is the same motion as {self.gloss}."
        if self.seen < _ALIKE:
            return (
                f"{gloss} looks nearly like {self.gloss}: what differs most is {self.seen:.1f} times what is "
                "just seen."
            )
        return None


def similar_signs(robot: Robot, sign: Sign, table: Path) -> tuple[SimilarSign, ...]:
    """The signs of a table that look most like a new one, the most alike first.

    Args:
        robot: The robot.
        sign: The new sign; an entry of the same name is no other sign.
        table: Directory that it goes to; of the user's own, what the package's table holds counts as well.
    """
    others: dict[str, Sign] = {}
    try:
        name, language = robot.humanoid.name, sign.language
        own = table == user_lut_directory(language, name)
        signs = Lut.open(None if own else table, language=language, robot=name)
    except LutError:  # a table that is made with its first sign
        return ()
    for gloss in signs.glosses():
        try:
            other = signs[gloss]
        except LutError:  # entries that are not valid are `lut validate`'s to tell
            continue
        if gloss != sign.gloss and other.kind == sign.kind:
            others[gloss] = other
    if not others:
        return ()
    found = []
    for match in SignIndex.of_signs(robot, others.values()).nearest(sign_appearance(robot, sign)):
        pairs = nearest_pairs(robot, [sign, others[match.gloss]])  # two names of one motion are no pair
        found.append(SimilarSign(gloss=match.gloss, seen=round(pairs[0].seen, 2) if pairs else 0.0))
    return tuple(sorted(found, key=lambda similar: similar.seen))
