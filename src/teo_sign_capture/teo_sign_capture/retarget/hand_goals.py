# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is wanted of TEO's hands in each frame: where, turned how, and how they are to each other.

The point of the hand that counts is where it meets the body: far from it the middle of the palm, near it what
is nearest, be it a finger tip at the chin or the palm on the chest; before the face what is nearest to its
middle for who watches: a thumb that points at the mouth does so on TEO, whose hand is as large as its face.
From one to the other it goes over smoothly. Likewise two hands that are near each other keep the way from the
nearest point of one to the nearest of the other. All is said as for a right hand; a left one is mirrored.

A person's elbow closes until the hand is at the shoulder, TEO's bends by 100 deg: its wrist stays 35 cm away.
A hand that belongs nearer is asked for before that place (`before_folded_arm`), on the way to the eyes of who
watches, where it is seen as if it were there: far before it in the air, a little on the trunk.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid, Side
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, arm_bounds
from teo_sign_capture.retarget.body_map import BodyMap, smooth_step
from teo_sign_capture.retarget.head_motion import HeadMotion
from teo_sign_capture.signing_space import COUNT, HEEL, MIRROR, PALM
from teo_sign_capture.tracks.signer_motion import SignerArm
from teo_sign_capture.tracks.skeleton_track import smoothed

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
# [m] A hand on the trunk that the folded arm has no room for is held up to a hand's breadth before it rather
# than turned away; less than the other below the shoulders it is touched all the same, as the throat is.
_BEFORE, _LOW = 0.10, 0.10
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
        at_face: How much the hand is at the face for who watches, 0 to 1. Shape (T,).
    """

    local: Array
    place: Array
    contact: Array
    palm: Array
    fingers: Array
    upper_arm: Array
    fore_arm: Array
    at_face: Array

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
            at_face=np.zeros(len(place)),
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


def _contact(
    body: BodyMap, head: HeadMotion, points: Array, at_face: Array, together: Array | float
) -> tuple[Array, Array]:
    """Find the point of a hand that counts.

    The end of the hand at the wrist touches nothing: on an arm that is folded it is near the chest while the
    hand is held up in the air, as letters are. Hands that are at each other before the trunk do not touch it:
    of 204 signs of the table none does both, and one camera hardly sees how near they are to it.

    Args:
        body: The map from the person to TEO.
        head: The heads of both.
        points: Of the person's hand, in the axes of the track [m]. Shape (T, COUNT, 3).
        at_face: How much it is at the face for who watches, 0 to 1. Shape (T,).
        together: How much it is at the other hand, 0 to 1. Shape (T,).

    Returns:
        Shares of the points in the one that counts, and how much it is on the body, 0 to 1. Shapes
        (T, COUNT), (T,).
    """
    away = np.where(np.arange(COUNT) == HEEL, np.inf, body.distance(points, head))
    contact = smooth_step((_OFF_BODY - away.min(axis=1)) / (_OFF_BODY - _ON_BODY))
    contact *= 1.0 - together * (1.0 - at_face)
    seen_off = np.linalg.norm((points - head.places[:, None])[..., 1:], axis=2)
    seen_off[:, HEEL] = np.inf
    in_air = at_face[:, None] * _nearest(seen_off) + (1.0 - at_face[:, None]) * (np.arange(COUNT) == PALM)
    shares = contact[:, None] * _nearest(away) + (1.0 - contact[:, None]) * in_air
    return shares, contact


def _nearest(away: Array) -> Array:
    """Shares of points by how far they are off something: of the nearest, and of those beside it. (T, k)."""
    near = np.exp((away.min(axis=1, keepdims=True) - away) / _BLEND)
    shares: Array = near / near.sum(axis=1, keepdims=True)
    return shares


def hand_goals(
    body: BodyMap, head: HeadMotion, arm: SignerArm, teo: Array, together: Array | float = 0.0
) -> tuple[HandGoals, Array]:
    """Find what is wanted of a hand.

    Args:
        body: The map from the person to TEO.
        head: The heads of both.
        arm: The person's.
        teo: `robot_hand_points` of TEO's hand. Shape (T, COUNT, 3).
        together: How much it is at the other hand, 0 to 1. Shape (T,).

    Returns:
        The goals, and the point of the person's hand whose place counts, in the axes of the track [m], shape
        (T, 3).
    """
    at_face = body.at_face(arm.points, head)
    shares, contact = _contact(body, head, arm.points, at_face, together)
    meant = _mean(shares, arm.points)
    place = body.outside(body.place_with_head(meant[:, None], head)[:, 0])
    flip = MIRROR if arm.side == "left" else np.ones(3)
    limbs = np.diff(arm.joints, axis=1) * flip
    limbs /= np.linalg.norm(limbs, axis=2, keepdims=True)
    goals = HandGoals(
        local=_mean(shares, teo),
        place=place * flip,
        contact=contact,
        palm=arm.axes[:, :, 2],
        fingers=arm.axes[:, :, 0],
        upper_arm=limbs[:, 0],
        fore_arm=limbs[:, 1],
        at_face=at_face,
    )
    return goals, meant


def pair_goals(
    body: BodyMap, times: Array, arms: Mapping[Side, SignerArm], teo: Mapping[Side, Array]
) -> PairGoals:
    """Find what is wanted of two hands together.

    Args:
        body: The map from the person to TEO.
        times: [s]. Shape (T,).
        arms: The person's two.
        teo: `robot_hand_points` of TEO's hands. Shape (T, COUNT, 3) each.
    """
    right, left = arms["right"], arms["left"]
    of_right, of_left, nearest = _shares(right.points, left.points)
    return PairGoals(
        right=_mean(of_right, teo["right"]),
        left=_mean(of_left, teo["left"]),
        way=(_mean(of_right, right.points) - _mean(of_left, left.points)) * body.scale,
        nearness=smooth_step((_APART - nearest) / (_APART - _TOGETHER)),
        order=_order(times, right, left),
    )


def _shares(right: Array, left: Array) -> tuple[Array, Array, Array]:
    """Shares of points in the nearest of each side to the other, shapes (T, k), and their distance (T,)."""
    away = np.linalg.norm(right[:, :, None] - left[:, None], axis=3)
    nearest = away.min(axis=(1, 2))
    shares = _nearest(away.reshape(len(away), -1)).reshape(away.shape)
    return shares.sum(axis=2), shares.sum(axis=1), nearest


def _mean(shares: Array, points: Array) -> Array:
    """The mean of points that count by their shares. Shapes (T, k), (T, k, 3), (T, 3)."""
    mean: Array = (shares[..., None] * points).sum(axis=1)
    return mean


def _order(times: Array, right_arm: SignerArm, left_arm: SignerArm) -> Array:
    """As `PairGoals.order`; of arms that cross only what is before and above, for beside leads nowhere."""
    right, left = (_forearm_and_hand(arm) for arm in (right_arm, left_arm))
    of_right, of_left, nearest = _shares(right, left)
    way = _mean(of_right, right) - _mean(of_left, left)
    way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-6)
    way[:, 1] = np.minimum(way[:, 1], 0.0)
    way[:, 0] += _UNDECIDED
    steady = smoothed(times, way, _STEADY)
    near = smooth_step((_ASUNDER - nearest) / (_ASUNDER - _BESIDE))
    order: Array = near[:, None] * steady / np.maximum(np.linalg.norm(steady, axis=1, keepdims=True), 1e-6)
    return order


def _forearm_and_hand(arm: SignerArm) -> Array:
    """Points along the forearm, and the keypoints of the hand [m]. Shape (T, k, 3)."""
    elbow, wrist = arm.joints[:, 1:2], arm.joints[:, 2:]
    return np.concatenate([elbow + _FOREARM[:, None] * (wrist - elbow), arm.keypoints], axis=1)


def before_folded_arm(chain: ArmKinematics, goals: HandGoals) -> HandGoals:
    """The goals of a hand, those that the folded arm has no room for moved out of it.

    Args:
        chain: The arm.
        goals: What is wanted, as the person has it.

    Returns:
        The same with places nearer to who watches: a wrist that carries a hand in the air as it is wanted is
        as far from the shoulder as that of the folded arm, or farther.
    """
    folded = np.zeros((1, chain.count))
    folded[0, chain.elbow] = arm_bounds(chain.humanoid, "both")[0 if chain.opens > 0.0 else 1][chain.elbow]
    pose = chain.poses(folded)
    wrist = pose.origins[0, chain.wrist]
    least = np.linalg.norm(wrist - chain.shoulder)
    in_palm = pose.rotation[0].T @ (wrist - pose.place[0])
    turns = np.stack([goals.fingers, np.cross(goals.palm, goals.fingers), goals.palm], axis=2)
    wrists = goals.place + np.einsum("tij,tj->ti", turns, in_palm - goals.local)
    ways = to_watcher(chain.humanoid, goals.place)
    out = _way_out(wrists - chain.shoulder, ways, float(least))
    low = smooth_step((chain.shoulder[2] - goals.place[:, 2]) / _LOW)
    out = (1.0 - goals.contact) * out + goals.contact * low * np.minimum(out, _BEFORE)
    return replace(goals, place=goals.place + out[:, None] * ways)


def to_watcher(humanoid: Humanoid, places: Array) -> Array:
    """Ways from places to who watches, where pictures are taken from: unit vectors. Shapes (T, 3)."""
    ways = np.array(humanoid.file.cameras["front"].position) - places
    units: Array = ways / np.linalg.norm(ways, axis=1, keepdims=True)
    return units


def _way_out(points: Array, ways: Array, radius: float) -> Array:
    """How far on their ways points within a ball about the origin leave it; 0 outside [m]. Shape (T,)."""
    room, along = radius**2 - (points**2).sum(axis=1), (points * ways).sum(axis=1)
    out: Array = np.sqrt(along**2 + np.maximum(room, 0.0)) - along
    return np.where(room > 0.0, out, 0.0)
