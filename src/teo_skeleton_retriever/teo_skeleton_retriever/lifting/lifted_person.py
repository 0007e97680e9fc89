# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a person's points in a picture to keypoints in space.

What is left and up is seen. How far elbows and wrists are in front a network tells (`lifting.arms`); in a
hand it follows from the lengths of its bones (`lifting.hands`), in a head from its shape (`lifting.head`).
Shoulders and hips are in one upright plane, turned as the detector imagines it; what is before them looks
larger by how near the camera is.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.person_layout import BODY, HANDS, KEYPOINTS, ROW
from teo_skeleton_retriever.layouts.skeleton_3d import KeypointStatus
from teo_skeleton_retriever.lifting.arms import SeenArm, lift_arm, measure_body
from teo_skeleton_retriever.lifting.clip import (
    ELBOW,
    HIP,
    SHOULDER,
    SIDES,
    WRIST,
    Points,
    PoseClip,
    smooth_depth,
)
from teo_skeleton_retriever.lifting.hand_axes import MIDDLE, RING
from teo_skeleton_retriever.lifting.hand_axes import WRIST as HAND_WRIST
from teo_skeleton_retriever.lifting.hands import LiftedHand, has_depth, lift_hand, with_learned_fingers
from teo_skeleton_retriever.lifting.head import POINTS, lift_head

# [m] Standard deviation of shoulders and hips along the view: that of a trunk that is turned by 15 deg.
_TRUNK_SIGMA = 0.04
# [m] From the camera to the shoulders: what is nearer is shown larger about them. Nothing in the points tells
# it; phones and webcams stand 1.5 to 2.5 m away to show a person from the hips up.
CAMERA = 2.0
# How far shoulders are seen above their joints, and hips below, in breadths of the shoulders: 15 and 16 mm of
# 0.34 m by MediaPipe in 60 rendered people.
_OFF_JOINTS = 0.045
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
    clip = at_joints(clip)
    # Limbs that come towards the camera look longer than they are, and so less foreshortened: what a first
    # lift finds to be near is drawn in and lifted anew. More lifts would trust depths beyond what they tell:
    # hands that hang or touch come off the body.
    return SeenPerson(drawn_in(clip, SeenPerson(clip).lifted().positions)).lifted()


def at_joints(clip: PoseClip) -> PoseClip:
    """A clip whose shoulders and hips are at the joints, and not on the body's outline above and below."""
    places = clip.body.places.copy()
    pair = places[:, list(SHOULDER.values()), 1:]
    breadth = _filled(np.linalg.norm(np.diff(pair, axis=1), axis=2))
    for points, way in ((SHOULDER, -1.0), (HIP, 1.0)):
        places[:, list(points.values()), 2] += way * _OFF_JOINTS * breadth
    return replace(clip, body=replace(clip.body, places=places))


def drawn_in(clip: PoseClip, positions: FloatArray) -> PoseClip:
    """A clip as from far away: points that are nearer to the camera than the shoulders look farther out.

    Args:
        clip: The clip.
        positions: Where the points are in space, about, as in `LiftedPerson` [m]. Shape (T, 67 or more, 3).
    """
    middle = _between_shoulders(clip)[:, None]

    def part(points: Points, rows: slice) -> Points:
        forward = np.nan_to_num(positions[:, rows, :1])
        places = points.places.copy()
        places[..., 1:] = middle + (places[..., 1:] - middle) * (1.0 - forward / CAMERA)
        return replace(points, places=places)

    return clip.with_parts(part)


class SeenPerson:
    """A person in a clip in which all of them has one scale, measured, and what is seen of each arm."""

    def __init__(self, clip: PoseClip) -> None:
        """Measure them."""
        self._clip = clip
        self._turn = _trunk_turn(clip.body, period=1.0 / clip.rate)
        self.measure = measure_body(clip.body, self._turn)
        self._places = self.measure.scale * clip.body.places
        self._places[..., 0] = np.nan
        self._sigma = np.full((*self._places.shape[:2], 2), np.nan)
        # Hands are found finer than wrists of bodies.
        for side in SIDES:
            wrists = self.measure.scale * clip.hand(side).places[:, HAND_WRIST, 1:]
            seen = np.isfinite(wrists).all(axis=1)
            self._places[seen, WRIST[side], 1:] = wrists[seen]
        self._places[..., 1:] -= self.measure.scale * _between_shoulders(clip)[:, None]
        for point in (*SHOULDER.values(), *HIP.values()):
            known = np.isfinite(self._places[:, point, 1])
            self._places[known, point, 0] = np.tan(self._turn[known]) * self._places[known, point, 1]
            self._sigma[known, point] = _ACROSS_SIGMA, _TRUNK_SIGMA
        # A hand that has depth says which way the forearm points; one that has none goes on as its forearm.
        unknown = np.full(len(self._places), np.nan)
        self.hands = {side: self._hand(side, unknown) for side in SIDES}

    def _hand(self, side: str, forearm: FloatArray) -> LiftedHand:
        return lift_hand(
            self._clip.hand(side),
            scale=self.measure.scale,
            period=1.0 / self._clip.rate,
            right=side == "right",
            forearm=forearm,
        )

    def arm(self, side: str) -> SeenArm:
        """What is seen of an arm."""
        other = SIDES[1 - SIDES.index(side)]
        shoulder, elbow, wrist = SHOULDER[side], ELBOW[side], WRIST[side]
        depths = self._clip.body.places[:, [shoulder, elbow, wrist], 0]
        knuckles = self.hands[side].points[:, [MIDDLE, RING]].mean(axis=1)
        return SeenArm(
            shoulder=_filled(self._places[:, shoulder]),
            elbow=self._places[:, elbow, 1:],
            wrist=self._places[:, wrist, 1:],
            other=self._places[:, WRIST[other], 1:],
            guess=self.measure.scale * np.diff(depths, axis=1),
            hand=knuckles if has_depth(self._clip.hand(side)) else np.full_like(knuckles, np.nan),
            turn=self._turn,
            lengths=(self.measure.upper_arm, self.measure.forearm),
            right=side == "right",
        )

    def lifted(self) -> LiftedPerson:
        """The person in space."""
        places, sigma = self._places.copy(), self._sigma.copy()
        depths, head_sigma = lift_head(places[:, POINTS, 1:])
        places[:, POINTS, 0] = np.where(np.isfinite(places[:, POINTS, 1]), depths, np.nan)
        sigma[:, POINTS] = np.stack([np.full_like(head_sigma, _ACROSS_SIGMA), head_sigma], axis=-1)
        confidence = self._clip.body.confidence.copy()
        hands = {side: self._lifted_side(side, places, sigma) for side in SIDES}
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
            seen_as[:, rows_of_hand] = self._clip.hand(side).confidence
        known = np.isfinite(whole).all(axis=2)
        return LiftedPerson(
            positions=np.where(known[..., None], whole, np.nan),
            sigma=np.where(known, spread, np.nan),
            confidence=np.where(known, seen_as, 0.0),
            status=np.where(known, KeypointStatus.OPTIMISED, KeypointStatus.LOST).astype(np.uint8),
        )

    def _lifted_side(self, side: str, places: FloatArray, sigma: FloatArray) -> LiftedHand:
        """Fill in depths and deviations of elbow and wrist of one side; the hand about its wrist."""
        elbow, wrist = ELBOW[side], WRIST[side]
        confidence = self._clip.body.confidence[:, [elbow, wrist]]
        arm = lift_arm(self.arm(side), confidence, 1.0 / self._clip.rate)
        for point, depth, deviation in (
            (elbow, arm.elbow, arm.elbow_sigma),
            (wrist, arm.wrist, arm.wrist_sigma),
        ):
            known = np.isfinite(places[:, point, 1])
            places[known, point, 0] = depth[known]
            places[~known, point] = np.nan
            sigma[known, point] = deviation[known]
        if has_depth(self._clip.hand(side)):
            hand = self.hands[side]
            return hand._replace(points=with_learned_fingers(hand.points, right=side == "right"))
        return self._hand(side, (arm.wrist - arm.elbow) / self.measure.forearm)


# What is true of the depths that MediaPipe gives shoulders: of 42 takes of six rendered people who stood
# turned by up to 45 deg, the tangent of the true turn was 0.38 of theirs; 5.5 deg remained.
_TURN_SHARE = 0.38
# [rad] Deviation of a turn that was found. Most signers face the camera: of a turn that is no larger than
# this little is believed, of a larger one nearly all.
_TURN_DEVIATION = np.radians(10.0)
# [rad] Deviation from one frame to the next, and the acceleration with which trunks turn [rad/s^2]: a raised
# arm pulls the shoulder that is found along, a signer who turns to somebody takes half a second.
_TURN_TREMBLE, _TURN_ACCELERATION = np.radians(5.0), 5.0
# [rad] Beyond this one shoulder hides the other.
_MOST_TURN = np.radians(60.0)


def _trunk_turn(body: Points, *, period: float) -> FloatArray:
    """How far the trunk is turned to the person's own right in each frame [rad]; 0 where nothing tells it.

    The breadth of the shoulders alone does not tell: it hardly changes up to 20 deg, and not by which side
    comes forward. A detector that imagines depths knows both.

    Args:
        body: BODY_25 in the picture; depths in its scale, as the detector imagines them.
        period: Between two frames [s].

    Returns:
        Positive where the left shoulder is in front. Shape (T,).
    """
    away = body.places[:, SHOULDER["left"]] - body.places[:, SHOULDER["right"]]
    turn = np.arctan2(_TURN_SHARE * away[:, 0], np.abs(away[:, 1]))[:, None]
    smooth = smooth_depth(
        turn, np.full_like(turn, _TURN_TREMBLE), period=period, acceleration=_TURN_ACCELERATION
    )[:, 0]
    found = np.nan_to_num(smooth)
    believed = found**2 / (found**2 + _TURN_DEVIATION**2)
    return np.asarray(np.clip(believed * found, -_MOST_TURN, _MOST_TURN))


def _between_shoulders(clip: PoseClip) -> FloatArray:
    """The middle of the shoulders in the picture. Shape (T, 2)."""
    return _filled(clip.body.places[:, [SHOULDER["left"], SHOULDER["right"]], 1:].mean(axis=1))


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
