# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a person's points in a picture to a track of keypoints in space.

The person is taken as facing the camera: what is left and up is seen, what is forward follows from the
lengths of limbs (`lifting.arms`), of a hand's bones (`lifting.hands`) and from the shape of a head
(`lifting.head`). Shoulders and hips are in one plane across the view; what is before it looks larger by how
near the camera is.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.lifting.arms import BodyMeasure, lift_arm, measure_body
from teo_sign_capture.lifting.hands import LiftedHand, has_depth, lift_hand
from teo_sign_capture.lifting.head import POINTS, lift_head
from teo_sign_capture.recordings.pose_file import Points, PoseClip
from teo_sign_capture.tracks.body_axes import in_body_axes
from teo_sign_capture.tracks.hand_shape import MIDDLE, RING, WRIST
from teo_sign_capture.tracks.skeleton_track import (
    ELBOW,
    FACE,
    HIP,
    MID_HIP,
    NECK,
    SHOULDER,
    Keypoints,
    SkeletonTrack,
)
from teo_sign_capture.tracks.skeleton_track import WRIST as BODY_WRIST

# `Keypoint3D.STATUS_*`: seen, its depth follows from limb lengths; or not known.
_OPTIMISED, _LOST = 3, 0
_SIDES = ("right", "left")
# [m] Standard deviation of shoulders and hips along the view: that of a trunk that is turned by 15 deg.
_TRUNK_SIGMA = 0.04
# [m] From the camera to the shoulders: what is nearer is shown larger about them. Nothing in the points tells
# it; phones and webcams stand 1.5 to 2.5 m away to show a person from the hips up.
_CAMERA = 2.0
# [m] Standard deviation of a point of the body across the view.
_ACROSS_SIGMA = 0.01


def lift_clip(clip: PoseClip, *, recorded: str | None = None) -> SkeletonTrack:
    """Lift a clip.

    Args:
        clip: A person who faces the viewer, one shoulder and one hand seen at least in some frames.
        recorded: Day of the recording, YYYY-MM-DD; None if not known.

    Raises:
        LutError: "no_torso", see `in_body_axes`.
    """
    # Limbs that come towards the camera look longer than they are, and so less foreshortened: what a first
    # lift finds to be near is drawn in and lifted anew. More lifts would trust depths beyond what they tell:
    # hands that hang or touch come off the body.
    lifted = _lift_from_afar(_drawn_in(clip, _lift_from_afar(clip)))
    return in_body_axes(
        times=np.arange(len(clip.body.places), dtype=np.float64) / clip.rate,
        **lifted,
        face=Keypoints.lost(len(clip.body.places), FACE),
        source=clip.source,
        recorded=recorded,
        up=(0.0, 0.0, 1.0),
    )


def _drawn_in(clip: PoseClip, lifted: dict[str, Keypoints]) -> PoseClip:
    """A clip as from far away: points that are nearer to the camera than the shoulders look farther out."""
    middle = _between_shoulders(clip)[:, None]

    def part(name: str) -> Points:
        points: Points = getattr(clip, name)
        forward = np.nan_to_num(lifted[name].positions[..., :1])
        places = points.places.copy()
        places[..., 1:] = middle + (places[..., 1:] - middle) * (1.0 - forward / _CAMERA)
        return replace(points, places=places)

    return replace(clip, body=part("body"), left_hand=part("left_hand"), right_hand=part("right_hand"))


def _lift_from_afar(clip: PoseClip) -> dict[str, Keypoints]:
    """Body and hands of a clip in which all of a person has one scale, from between the shoulders [m]."""
    measure = measure_body(clip.body)
    places = measure.scale * clip.body.places
    places[..., 0] = np.nan
    sigma = np.full((*places.shape[:2], 2), np.nan)
    # Hands are found finer than wrists of bodies.
    for side in _SIDES:
        wrists = measure.scale * clip.hand(side).places[:, WRIST, 1:]
        seen = np.isfinite(wrists).all(axis=1)
        places[seen, BODY_WRIST[side], 1:] = wrists[seen]
    places[..., 1:] -= measure.scale * _between_shoulders(clip)[:, None]
    for point in (*SHOULDER.values(), *HIP.values()):
        known = np.isfinite(places[:, point, 1])
        places[known, point, 0] = 0.0
        sigma[known, point] = _ACROSS_SIGMA, _TRUNK_SIGMA
    depths, head_sigma = lift_head(places[:, POINTS, 1:])
    places[:, POINTS, 0] = np.where(np.isfinite(places[:, POINTS, 1]), depths, np.nan)
    sigma[:, POINTS] = np.stack([np.full_like(head_sigma, _ACROSS_SIGMA), head_sigma], axis=-1)
    hands = {side: _lift_side(clip, side, places, sigma, measure) for side in _SIDES}
    for point, pair in ((NECK, SHOULDER), (MID_HIP, HIP)):
        places[:, point] = places[:, list(pair.values())].mean(axis=1)
        sigma[:, point] = sigma[:, list(pair.values())].mean(axis=1)
    return {
        "body": _keypoints(places, _mean(sigma), _body_confidence(clip)),
        "left_hand": _hand(clip, "left", places, sigma, hands["left"]),
        "right_hand": _hand(clip, "right", places, sigma, hands["right"]),
    }


def _between_shoulders(clip: PoseClip) -> Array:
    """The middle of the shoulders in the picture. Shape (T, 2)."""
    return _filled(clip.body.places[:, [SHOULDER["left"], SHOULDER["right"]], 1:].mean(axis=1))


def _lift_side(clip: PoseClip, side: str, places: Array, sigma: Array, measure: BodyMeasure) -> LiftedHand:
    """Fill in depths and deviations of elbow and wrist of one side; the hand about its wrist."""
    shoulder, elbow, wrist = SHOULDER[side], ELBOW[side], BODY_WRIST[side]
    period = 1.0 / clip.rate
    unknown = np.full(len(places), np.nan)

    def hand_along(forearm: Array) -> LiftedHand:
        points, right = clip.hand(side), side == "right"
        return lift_hand(points, scale=measure.scale, period=period, right=right, forearm=forearm)

    # A hand that has depth says which way the forearm points; one that has none goes on as its forearm.
    hand = hand_along(unknown)
    knuckles = hand.points[:, [MIDDLE, RING]].mean(axis=1)
    arm = lift_arm(
        shoulder=_filled(places[:, shoulder, 1:]),
        elbow=places[:, elbow, 1:],
        wrist=places[:, wrist, 1:],
        confidence=clip.body.confidence[:, [elbow, wrist]],
        guess=clip.body.places[:, wrist, 0] - clip.body.places[:, elbow, 0],
        hand=knuckles if has_depth(clip.hand(side)) else np.full_like(knuckles, np.nan),
        measure=measure,
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


def _hand(clip: PoseClip, side: str, places: Array, sigma: Array, hand: LiftedHand) -> Keypoints:
    """A hand at the end of its arm."""
    wrist = BODY_WRIST[side]
    points = hand.points + places[:, wrist, None]
    spread = np.hypot(hand.sigma, _mean(sigma[:, wrist, None]))
    return _keypoints(points, spread, clip.hand(side).confidence)


def _keypoints(positions: Array, sigma: Array, confidence: Array) -> Keypoints:
    known = np.asarray(np.isfinite(positions).all(axis=2))
    return Keypoints(
        positions=np.where(known[..., None], positions, np.nan),
        sigma=np.where(known, sigma, np.nan),
        confidence=np.where(known, confidence, 0.0),
        status=np.where(known, _OPTIMISED, _LOST).astype(np.uint8),
    )


def _body_confidence(clip: PoseClip) -> Array:
    confidence = clip.body.confidence.copy()
    for point, pair in ((NECK, SHOULDER), (MID_HIP, HIP)):
        confidence[:, point] = confidence[:, list(pair.values())].min(axis=1)
    return confidence


def _mean(sigma: Array) -> Array:
    """Root mean over the axes of a deviation across the view, twice, and along it. Shape (..., 2)."""
    mean: Array = np.sqrt((2.0 * sigma[..., 0] ** 2 + sigma[..., 1] ** 2) / 3.0)
    return mean


def _filled(places: Array) -> Array:
    """Places over time, with gaps filled in straight lines; known at least once. Shape (T, 2)."""
    known = np.isfinite(places).all(axis=1)
    if not known.any():
        return places
    frames = np.arange(len(places))
    return np.column_stack([np.interp(frames, frames[known], column[known]) for column in places.T])
