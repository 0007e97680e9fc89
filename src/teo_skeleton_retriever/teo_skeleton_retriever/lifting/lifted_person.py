# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a person's points in a picture to keypoints in space.

What is left and up is seen, what is forward follows from the lengths of limbs (`lifting.arms`), of a hand's
bones (`lifting.hands`) and from the shape of a head (`lifting.head`). Shoulders and hips are in one upright
plane, turned as the detector imagines it (`lifting.trunk`); what is before them looks larger by how near the
camera is.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.person_layout import BODY, HANDS, KEYPOINTS, ROW
from teo_skeleton_retriever.layouts.skeleton_3d import KeypointStatus
from teo_skeleton_retriever.lifting.arms import BodyMeasure, lift_arm, measure_body
from teo_skeleton_retriever.lifting.clip import ELBOW, HIP, SHOULDER, SIDES, WRIST, Points, PoseClip
from teo_skeleton_retriever.lifting.hand_axes import MIDDLE, RING
from teo_skeleton_retriever.lifting.hand_axes import WRIST as HAND_WRIST
from teo_skeleton_retriever.lifting.hands import LiftedHand, has_depth, lift_hand
from teo_skeleton_retriever.lifting.head import POINTS, lift_head
from teo_skeleton_retriever.lifting.trunk import trunk_turn

# [m] Standard deviation of shoulders and hips along the view: that of a trunk that is turned by 15 deg.
_TRUNK_SIGMA = 0.04
# [m] From the camera to the shoulders: what is nearer is shown larger about them. Nothing in the points tells
# it; phones and webcams stand 1.5 to 2.5 m away to show a person from the hips up.
_CAMERA = 2.0
# [m] Standard deviation of a point of the body across the view.
_ACROSS_SIGMA = 0.01


class LiftedPerson(NamedTuple):
    """A person in space over time, all keypoints as in `layouts.person_layout`; faces are not lifted.

    Attributes:
        positions: Forward, left and up from between the shoulders [m]; NaN where not known. Shape (T, N, 3).
        sigma: Standard deviation, root mean over the axes [m]; NaN where not known. Shape (T, N).
        confidence: Of the detector, 0 to 1; 0 where not known. Shape (T, N).
        status: `KeypointStatus`: optimised, or lost. Shape (T, N).
    """

    positions: FloatArray
    sigma: FloatArray
    confidence: FloatArray
    status: NDArray[np.uint8]


def lift_clip(clip: PoseClip) -> LiftedPerson:
    """Lift a clip.

    Args:
        clip: A person seen from in front, one shoulder and one hand at least in some frames.
    """
    # Limbs that come towards the camera look longer than they are, and so less foreshortened: what a first
    # lift finds to be near is drawn in and lifted anew. More lifts would trust depths beyond what they tell:
    # hands that hang or touch come off the body.
    return _lift_from_afar(_drawn_in(clip, _lift_from_afar(clip).positions))


def _drawn_in(clip: PoseClip, lifted: FloatArray) -> PoseClip:
    """A clip as from far away: points that are nearer to the camera than the shoulders look farther out."""
    middle = _between_shoulders(clip)[:, None]

    def part(points: Points, rows: slice) -> Points:
        forward = np.nan_to_num(lifted[:, rows, :1])
        places = points.places.copy()
        places[..., 1:] = middle + (places[..., 1:] - middle) * (1.0 - forward / _CAMERA)
        return replace(points, places=places)

    return replace(
        clip,
        body=part(clip.body, BODY),
        left_hand=part(clip.left_hand, HANDS["L"]),
        right_hand=part(clip.right_hand, HANDS["R"]),
    )


def _lift_from_afar(clip: PoseClip) -> LiftedPerson:
    """Lift a clip in which all of a person has one scale."""
    turn = trunk_turn(clip.body, period=1.0 / clip.rate)
    measure = measure_body(clip.body, turn)
    places = measure.scale * clip.body.places
    places[..., 0] = np.nan
    sigma = np.full((*places.shape[:2], 2), np.nan)
    # Hands are found finer than wrists of bodies.
    for side in SIDES:
        wrists = measure.scale * clip.hand(side).places[:, HAND_WRIST, 1:]
        seen = np.isfinite(wrists).all(axis=1)
        places[seen, WRIST[side], 1:] = wrists[seen]
    places[..., 1:] -= measure.scale * _between_shoulders(clip)[:, None]
    for point in (*SHOULDER.values(), *HIP.values()):
        known = np.isfinite(places[:, point, 1])
        places[known, point, 0] = np.tan(turn[known]) * places[known, point, 1]
        sigma[known, point] = _ACROSS_SIGMA, _TRUNK_SIGMA
    depths, head_sigma = lift_head(places[:, POINTS, 1:])
    places[:, POINTS, 0] = np.where(np.isfinite(places[:, POINTS, 1]), depths, np.nan)
    sigma[:, POINTS] = np.stack([np.full_like(head_sigma, _ACROSS_SIGMA), head_sigma], axis=-1)
    hands = {side: _lift_side(clip, side, places, sigma, measure, turn) for side in SIDES}
    confidence = clip.body.confidence.copy()
    for point, pair in ((ROW["Neck"], SHOULDER), (ROW["MidHip"], HIP)):
        rows = list(pair.values())
        places[:, point], sigma[:, point] = places[:, rows].mean(axis=1), sigma[:, rows].mean(axis=1)
        confidence[:, point] = confidence[:, rows].min(axis=1)
    frames = len(places)
    whole, spread, seen_as = (
        np.full((frames, KEYPOINTS, 3), np.nan),
        np.full((frames, KEYPOINTS), np.nan),
        np.zeros((frames, KEYPOINTS)),
    )
    whole[:, BODY], spread[:, BODY], seen_as[:, BODY] = places, _mean(sigma), confidence
    for side, hand in hands.items():
        rows_of_hand, wrist = HANDS[side[0].upper()], WRIST[side]
        whole[:, rows_of_hand] = hand.points + places[:, wrist, None]
        spread[:, rows_of_hand] = np.hypot(hand.sigma, _mean(sigma[:, wrist, None]))
        seen_as[:, rows_of_hand] = clip.hand(side).confidence
    known = np.isfinite(whole).all(axis=2)
    return LiftedPerson(
        positions=np.where(known[..., None], whole, np.nan),
        sigma=np.where(known, spread, np.nan),
        confidence=np.where(known, seen_as, 0.0),
        status=np.where(known, KeypointStatus.OPTIMISED, KeypointStatus.LOST).astype(np.uint8),
    )


def _between_shoulders(clip: PoseClip) -> FloatArray:
    """The middle of the shoulders in the picture. Shape (T, 2)."""
    return _filled(clip.body.places[:, [SHOULDER["left"], SHOULDER["right"]], 1:].mean(axis=1))


def _lift_side(
    clip: PoseClip, side: str, places: FloatArray, sigma: FloatArray, measure: BodyMeasure, turn: FloatArray
) -> LiftedHand:
    """Fill in depths and deviations of elbow and wrist of one side; the hand about its wrist."""
    shoulder, elbow, wrist = SHOULDER[side], ELBOW[side], WRIST[side]
    period = 1.0 / clip.rate
    unknown = np.full(len(places), np.nan)

    def hand_along(forearm: FloatArray) -> LiftedHand:
        points, right = clip.hand(side), side == "right"
        return lift_hand(points, scale=measure.scale, period=period, right=right, forearm=forearm)

    # A hand that has depth says which way the forearm points; one that has none goes on as its forearm.
    hand = hand_along(unknown)
    knuckles = hand.points[:, [MIDDLE, RING]].mean(axis=1)
    arm = lift_arm(
        shoulder=_filled(places[:, shoulder]),
        elbow=places[:, elbow, 1:],
        wrist=places[:, wrist, 1:],
        confidence=clip.body.confidence[:, [elbow, wrist]],
        guess=measure.scale * np.diff(clip.body.places[:, [shoulder, elbow, wrist], 0], axis=1),
        hand=knuckles if has_depth(clip.hand(side)) else np.full_like(knuckles, np.nan),
        measure=measure,
        turn=turn,
        period=period,
    )
    if not has_depth(clip.hand(side)):
        hand = hand_along((arm.wrist - arm.elbow) / measure.forearm)
    for point, depth, deviation in (
        (elbow, arm.elbow, arm.elbow_sigma),
        (wrist, arm.wrist, arm.wrist_sigma),
    ):
        known = np.isfinite(places[:, point, 1])
        places[known, point, 0] = depth[known]
        places[~known, point] = np.nan
        sigma[known, point] = deviation[known]
    return hand


def _mean(sigma: FloatArray) -> FloatArray:
    """Root mean over the axes of a deviation across the view, twice, and along it. Shape (..., 2)."""
    mean: FloatArray = np.sqrt((2.0 * sigma[..., 0] ** 2 + sigma[..., 1] ** 2) / 3.0)
    return mean


def _filled(places: FloatArray) -> FloatArray:
    """Places over time, with gaps filled in straight lines; known at least once. Shape (T, d)."""
    known = np.isfinite(places).all(axis=1)
    if not known.any():
        return places
    frames = np.arange(len(places))
    return np.column_stack([np.interp(frames, frames[known], column[known]) for column in places.T])
