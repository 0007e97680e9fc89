# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is wanted of TEO's hands in each frame: where, turned how, and how they are to each other.

The point of the hand that counts is where it meets the body: far from it the middle of the palm, near it what
is nearest, be it a finger tip at the chin or the palm on the chest; in between and from one to the other it
goes over smoothly. Likewise two hands that are near each other keep the way from the nearest point of one to
the nearest of the other. All is said as for a right hand; a left hand is seen in a mirror.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d

from teo_common.arrays import Array
from teo_sign_capture.retarget.body_map import BodyMap, smooth_step
from teo_sign_capture.retarget.head_motion import HeadMotion
from teo_sign_capture.signing_space.hand_points import COUNT, HEEL, MIRROR, PALM, person_hand_points
from teo_sign_capture.tracks.hand_model import palm_axes

# [m] Points of a hand whose distances to the body differ by less than this share the contact: about a
# finger's width.
_BLEND = 0.015
# [m] A keypoint nearer than this to the skin is on it (a finger tip's is 1 cm below its own skin, a palm's 2
# cm); farther than the other the hand is in the air.
_ON_BODY, _OFF_BODY = 0.03, 0.12
# [m] Keypoints of two hands nearer than the first are together, farther than the second apart.
_TOGETHER, _APART = 0.05, 0.15
# [m] Forearms and hands of both sides nearer than the first keep the order in which the person has them,
# farther than the second need not: TEO's are thicker than a person's by a half.
_BESIDE, _ASUNDER = 0.15, 0.30
# [s] Standard deviation of the Gaussian that smooths that order, which turns about where fingers pass.
_STEADY = 0.15
# Added to how far the right hand is in front: hands of which neither is in front get an order.
_UNDECIDED = 0.2
# Where on a forearm, from elbow (0) to wrist (1), distances are measured; elbows stay on their sides.
_FOREARM = np.linspace(0.3, 0.9, 5)


@dataclass(frozen=True, kw_only=True, eq=False)
class HandGoals:
    """What is wanted of one hand, seen as a right hand, in ``base_link`` with the trunk at home.

    Attributes:
        local: The point of TEO's hand that counts, in the palm's axes [m]. Shape (T, 3).
        place: Where it should be [m]. Shape (T, 3).
        contact: How much it is on the body, 0 to 1. Shape (T,).
        palm: Way the palm faces, unit vector. Shape (T, 3).
        fingers: Way from wrist to knuckles, unit vector. Shape (T, 3).
        upper_arm: Way from shoulder to elbow, unit vector. Shape (T, 3).
        fore_arm: Way from elbow to wrist, unit vector. Shape (T, 3).
    """

    local: Array
    place: Array
    contact: Array
    palm: Array
    fingers: Array
    upper_arm: Array
    fore_arm: Array

    @classmethod
    def without_arm(
        cls, *, local: Array, place: Array, contact: Array, palm: Array, fingers: Array
    ) -> HandGoals:
        """What is wanted of a hand where nothing is known of the arm: its ways are zero."""
        unknown = np.zeros_like(place)
        return cls(
            local=local,
            place=place,
            contact=contact,
            palm=palm,
            fingers=fingers,
            upper_arm=unknown,
            fore_arm=unknown,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class PairGoals:
    """What is wanted of two hands together, in ``base_link``.

    Attributes:
        right, left: Point of each hand that is nearest to the other, in its palm's axes, the left one's in a
            mirror [m]. Shape (T, 3).
        way: From the left one to the right one [m]. Shape (T, 3).
        nearness: How much the hands are together, 0 to 1. Shape (T,).
        order: Way from the left forearm and hand to the right ones where they are nearest, which of them is
            in front, above, aside: a unit vector, shorter the farther they are from each other. Shape (T, 3).
    """

    right: Array
    left: Array
    way: Array
    nearness: Array
    order: Array


def hand_goals(body: BodyMap, head: HeadMotion, side: str, hand: Array, arm: Array, teo: Array) -> HandGoals:
    """Find what is wanted of a hand.

    Args:
        body: The map from the person to TEO.
        head: The heads of both.
        side: "right" or "left".
        hand: The person's 21 keypoints, none NaN, in the axes of the track [m]. Shape (T, 21, 3).
        arm: The person's shoulder, elbow and wrist, none NaN [m]. Shape (T, 3, 3).
        teo: `robot_hand_points` of the hand. Shape (T, COUNT, 3).
    """
    points = person_hand_points(hand)
    part, contact = _part_that_counts(body.distance(points, head))
    meant = (part[:, :, None] * points).sum(axis=1)
    place = body.outside(body.place_with_head(meant[:, None], head)[:, 0])
    flip = MIRROR if side == "left" else np.ones(3)
    axes = palm_axes(hand * flip)
    limbs = np.diff(arm, axis=1) * flip
    limbs /= np.linalg.norm(limbs, axis=2, keepdims=True)
    return HandGoals(
        local=(part[:, :, None] * teo).sum(axis=1),
        place=place * flip,
        contact=contact,
        palm=axes[:, :, 2],
        fingers=axes[:, :, 0],
        upper_arm=limbs[:, 0],
        fore_arm=limbs[:, 1],
    )


def point_that_counts(body: BodyMap, head: HeadMotion, hand: Array) -> Array:
    """The point of a person's hand whose place `hand_goals` asks for [m]. Shape (T, 3)."""
    points = person_hand_points(hand)
    part, _ = _part_that_counts(body.distance(points, head))
    meant: Array = (part[:, :, None] * points).sum(axis=1)
    return meant


def _part_that_counts(away: Array) -> tuple[Array, Array]:
    """Share of each point of a hand in the point that counts, and how much it is on the body.

    The end of the hand at the wrist touches nothing: on an arm that is folded it is near the chest while the
    hand is held up in the air, as letters are.

    Args:
        away: Distances of the points from the body [m]. Shape (T, COUNT).

    Returns:
        Shapes (T, COUNT) and (T,).
    """
    away = np.where(np.arange(COUNT) == HEEL, np.inf, away)
    nearest = away.min(axis=1)
    contact = smooth_step((_OFF_BODY - nearest) / (_OFF_BODY - _ON_BODY))
    touching = np.exp((nearest[:, None] - away) / _BLEND)
    touching /= touching.sum(axis=1, keepdims=True)
    part = contact[:, None] * touching + (1.0 - contact[:, None]) * (np.arange(COUNT) == PALM)
    return part, contact


def pair_goals(
    body: BodyMap,
    times: Array,
    hands: tuple[Array, Array],
    arms: tuple[Array, Array],
    teo: tuple[Array, Array],
) -> PairGoals:
    """Find what is wanted of two hands together; right and left, arguments as for `hand_goals`."""
    right, left = (person_hand_points(hand) for hand in hands)
    of_right, of_left, nearest = _shares(right, left)
    way = (of_right[..., None] * right).sum(axis=1) - (of_left[..., None] * left).sum(axis=1)
    return PairGoals(
        right=(of_right[..., None] * teo[0]).sum(axis=1),
        left=(of_left[..., None] * teo[1]).sum(axis=1),
        way=way * body.scale,
        nearness=smooth_step((_APART - nearest) / (_APART - _TOGETHER)),
        order=_order(times, hands, arms),
    )


def _shares(right: Array, left: Array) -> tuple[Array, Array, Array]:
    """Shares of points in the nearest of each side to the other, shapes (T, k), and their distance (T,)."""
    away = np.linalg.norm(right[:, :, None] - left[:, None], axis=3)
    nearest = away.min(axis=(1, 2))
    shares = np.exp((nearest[:, None, None] - away) / _BLEND)
    shares /= shares.sum(axis=(1, 2), keepdims=True)
    return shares.sum(axis=2), shares.sum(axis=1), nearest


def _order(times: Array, hands: tuple[Array, Array], arms: tuple[Array, Array]) -> Array:
    """As `PairGoals.order`; of arms that cross only what is before and above, for beside leads nowhere."""
    right, left = (
        np.concatenate([elbow + _FOREARM[:, None] * (wrist - elbow), hand], axis=1)
        for hand, elbow, wrist in (
            (hand, arm[:, 1:2], arm[:, 2:]) for hand, arm in zip(hands, arms, strict=True)
        )
    )
    of_right, of_left, nearest = _shares(right, left)
    way = (of_right[..., None] * right).sum(axis=1) - (of_left[..., None] * left).sum(axis=1)
    way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-6)
    way[:, 1] = np.minimum(way[:, 1], 0.0)
    way[:, 0] += _UNDECIDED
    width = _STEADY / float(np.median(np.diff(times))) if len(times) > 1 else 1.0
    steady = gaussian_filter1d(way, width, axis=0, mode="nearest")
    near = smooth_step((_ASUNDER - nearest) / (_ASUNDER - _BESIDE))
    order: Array = near[:, None] * steady / np.maximum(np.linalg.norm(steady, axis=1, keepdims=True), 1e-6)
    return order
