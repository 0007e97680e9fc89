# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One person over time: from keypoints in images and depth to joints in space."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray, in_space, median
from teo_skeleton_retriever.depth.body_depth import BodyDepth, BodyDepths, WristView
from teo_skeleton_retriever.depth.depth_lookup import DepthLookup, Surfaces, ViewingRays, viewing_rays
from teo_skeleton_retriever.depth.girdle_depth import by_outline
from teo_skeleton_retriever.depth.hand_shape import HandFit, HandView, fit_hands
from teo_skeleton_retriever.depth.head_depth import EARS, HEAD, HeadDepths, face_depths, head_depths
from teo_skeleton_retriever.depth.occluders import occluders
from teo_skeleton_retriever.depth.skin import BODY_DEPTHS, HAND_DEPTHS
from teo_skeleton_retriever.detectors.detector import DetectionFrame
from teo_skeleton_retriever.detectors.mediapipe.calibration import (
    EAR_BEHIND,
    MEDIAPIPE_HAND_BONES,
    corrected_body,
    corrected_hand,
    extra_hand_sigma,
)
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25
from teo_skeleton_retriever.layouts.person_layout import (
    ACCELERATION,
    ACROSS,
    ARMS,
    BIAS,
    BODY,
    DRIFT,
    FACE,
    GAP,
    GIRDLE,
    HAND_BONES,
    HANDS,
    JUMP,
    KEYPOINTS,
    LEFT_HAND,
    PART_ROWS,
    PIXEL,
    RADIUS,
    RIGHT_HAND,
    ROW,
    SPEED,
)
from teo_skeleton_retriever.layouts.skeleton_3d import Keypoints3D, KeypointStatus
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.tracking.body_size import BodySize, widened
from teo_skeleton_retriever.tracking.keypoint_filter import FilterOutput, KeypointFilter

_TRUNK = [ROW[name] for name in ("Neck", "RShoulder", "LShoulder", "MidHip")]
_BEFORE_TRUNK = 1.0  # [m] a long arm and a lean forward reach no farther
_BEHIND_TRUNK = 0.45  # [m] nor does an arm stretched back: what is farther is background beside a finger
_SHOULDERS = [ROW["RShoulder"], ROW["LShoulder"]]
_HAND_SHARE = 0.6  # of the greatest sigma: a finger that may be half a hand away tells nothing of its shape
_SURE = 0.02  # [m] standard deviation across the ray of a joint that is plainly seen, which `BIAS` stands for
_CARRIED = 0.05  # [m] standard deviation of a hand that is not seen and goes with its wrist: it turns
_GUESSED = 0.025  # [m] standard deviation that is added to a keypoint that an arm hides
# Elbows, before which the own forearm may lie, and wrists, before which the own hand may lie as well.
_OWN_LIMBS = {row: rows[1 : i + 1] for rows in ARMS.values() for i, row in enumerate(rows) if i}
_HEAD_AND_FACE = [*HEAD, *range(FACE.start, FACE.stop)]
_OF_HEAD, _OF_FACE = slice(0, len(HEAD)), slice(len(HEAD), None)
_ON_HANDS = (np.arange(KEYPOINTS) >= LEFT_HAND.start) & (np.arange(KEYPOINTS) < RIGHT_HAND.stop)


class PersonEstimator:
    """Estimates the joints of one person over time; the caller knows which detection is theirs."""

    def __init__(self, parameters: RetrieverParameters) -> None:
        self._parameters = parameters
        self._by_mediapipe = parameters.detector == "mediapipe"
        self._size = BodySize(averaging=self._by_mediapipe)
        self._body = BodyDepth(parameters)
        self._lookup = DepthLookup(nearest=parameters.min_depth, farthest=parameters.max_depth)
        self._filter = KeypointFilter(
            KEYPOINTS,
            acceleration=ACCELERATION,
            speed=SPEED,
            hold_time=parameters.hold_time,
            smoothing=parameters.smoothing,
        )
        self._confidence = np.zeros(KEYPOINTS)
        self._from_wrist = np.full((KEYPOINTS, 3), np.nan)  # of the hands' keypoints, as last seen [m]

    def step(self, frame: DetectionFrame, person: Person2D, distance: float) -> dict[str, Keypoints3D]:
        """Take one image.

        Args:
            frame: The image.
            person: Who was seen in it.
            distance: Of the person along the optical axis [m].

        Returns:
            The keypoints of each part of a `Skeleton`.
        """
        before = self._filter.predict(frame.stamp)
        near = np.where(np.isfinite(before.depth), before.depth, distance)
        seen, outlined = self._seen(frame, person, near)
        seen = seen.only(self._filter.believable(frame.stamp, seen.rays, JUMP))
        surfaces = self._lookup.surfaces(
            frame.depth,
            seen.pixels,
            focal=frame.camera.fx,
            distance=near,
            radius=RADIUS,
            gap=GAP,
        ).between(*self._reach(before, distance))
        depth, sigma = np.full(KEYPOINTS, np.nan), np.full(KEYPOINTS, np.nan)
        optimised = np.zeros(KEYPOINTS, dtype=bool)
        fits = self._fit_hands(person, seen, surfaces, before)
        hands = {side: fit.points for side, fit in fits.items()}
        arms = occluders(before.part(BODY).points, hands)
        shown = np.zeros(surfaces.depth.shape, dtype=bool)
        shown[GIRDLE] = arms.shown(seen.rays[GIRDLE], surfaces.depth[GIRDLE])
        body = self._find_body(seen, surfaces.without(shown), before, fits)
        depth[BODY], sigma[BODY], optimised[BODY] = body.depths, body.sigma, body.optimised
        rays = np.concatenate([body.rays, seen.rays[BODY.stop :]])
        for side, fit in fits.items():
            wrist = ARMS[side][2]
            # A hand that nothing was measured of is where its arm ends.
            moved = body.depths[wrist] - fit.points[0, 2] if body.optimised[wrist] else 0.0
            rays[HANDS[side]] = fit.points[:, :2] / fit.points[:, 2:]
            depth[HANDS[side]], sigma[HANDS[side]] = fit.points[:, 2] + moved, fit.sigma
            optimised[HANDS[side]] = ~fit.measured
        arms = occluders(in_space(body.rays, body.depths), hands)
        free = surfaces.part(_HEAD_AND_FACE)
        free = free.without(arms.shown(seen.rays[_HEAD_AND_FACE], free.depth))
        head = self._find_head(free, before, body)
        depth[HEAD] = np.where(seen.seen[HEAD], head.depths, np.nan)
        sigma[HEAD] = head.sigma
        if seen.seen[FACE].any():
            face = face_depths(seen.rays[FACE], free.part(_OF_FACE), head.eyes)
            depth[FACE], sigma[FACE] = face.depths, face.sigma
            optimised[FACE] = ~face.measured
        near = np.where(np.isfinite(depth), depth, distance)
        hidden = arms.hide(rays, near, _OWN_LIMBS)
        hidden[HEAD] |= head.hidden
        hidden[_ON_HANDS] = False  # a hand before a hand is the fit's affair
        doubt = np.zeros(KEYPOINTS)
        doubt[BODY] = np.maximum(body.across - _SURE, 0.0)
        if self._by_mediapipe:
            doubt += np.where(_ON_HANDS & seen.seen, extra_hand_sigma(seen.confidence), 0.0)
        across = np.hypot(np.hypot(ACROSS, doubt) / near, PIXEL / frame.camera.fx)
        output = self._filter.step(
            frame.stamp, np.column_stack([rays, depth]), np.column_stack([across, across, sigma])
        )
        self._size.step(body.measured, outlined=outlined)
        self._confidence = np.where(seen.seen, seen.confidence, self._confidence)
        away = np.minimum(output.age, self._parameters.hold_time)
        carried = np.where(output.fresh, 0.0, np.where(_ON_HANDS, _CARRIED, DRIFT * away))
        guessed = carried + np.where(hidden, _GUESSED, 0.0)
        found = _keypoints_of(
            output,
            seen,
            optimised=optimised,
            hidden=hidden,
            bias=np.hypot(BIAS, np.column_stack([doubt + guessed, guessed])),
            max_sigma=self._parameters.max_sigma * np.where(_ON_HANDS, _HAND_SHARE, 1.0),
            memory=self._confidence,
        )
        found = self._with_held_hands(found)
        return {part: found.part(rows) for part, rows in PART_ROWS.items()}

    def _find_head(self, free: Surfaces, before: FilterOutput, body: BodyDepths) -> HeadDepths:
        """Find the head in surfaces of head and face that are not an arm's."""
        behind = np.zeros(len(HEAD))
        if self._parameters.skin_offset:
            behind = BODY_DEPTHS[HEAD] * self._size.scale
        if self._by_mediapipe:
            behind[EARS] += EAR_BEHIND
        return head_depths(
            free.part(_OF_HEAD),
            behind,
            free.part(_OF_FACE),
            neck=float(body.depths[ROW["Neck"]]),
            expected=before.depth[HEAD],
        )

    def _reach(self, before: FilterOutput, distance: float) -> tuple[float, float]:
        """Least and greatest depth of any keypoint of the person [m]."""
        trunk = median(before.depth[_TRUNK])
        middle = trunk if np.isfinite(trunk) else distance
        return middle - _BEFORE_TRUNK, middle + _BEHIND_TRUNK

    def _seen(
        self, frame: DetectionFrame, person: Person2D, distance: FloatArray
    ) -> tuple[ViewingRays, bool]:
        """Give what is seen, and whether the shoulders are where the body's outline says."""
        outlined = np.zeros(2, dtype=bool)
        keypoints = np.zeros((KEYPOINTS, 3))
        keypoints[BODY] = as_body_25(person.body)
        if self._by_mediapipe:
            keypoints[BODY] = corrected_body(keypoints[BODY])
            keypoints[_SHOULDERS, :2] = widened(keypoints[_SHOULDERS, :2], self._size.widening)
            keypoints[BODY], outlined = by_outline(
                keypoints[BODY],
                frame.depth,
                at=distance[_SHOULDERS],
                focal=frame.camera.fx,
                scale=self._size.scale,
            )
        for part in ("left_hand", "right_hand", "face"):
            if len(getattr(person, part)):
                keypoints[PART_ROWS[part]] = getattr(person, part)
        return viewing_rays(keypoints, frame.camera, self._parameters.min_confidence), bool(outlined.all())

    def _fit_hands(
        self, person: Person2D, seen: ViewingRays, surfaces: Surfaces, before: FilterOutput
    ) -> dict[str, HandFit]:
        """Find the hands that are seen."""
        sides = [side for side, rows in HANDS.items() if seen.seen[rows].any()]
        worlds = {"L": person.left_hand_world, "R": person.right_hand_world}
        views = [
            HandView(
                seen.rays[HANDS[side]],
                surfaces.part(HANDS[side]),
                worlds[side],
                median(before.depth[HANDS[side]]),
                float(before.depth[ARMS[side][2]]),
            )
            for side in sides
        ]
        if self._parameters.fit_hands:
            bones = MEDIAPIPE_HAND_BONES if self._by_mediapipe else HAND_BONES
            fits = fit_hands(views, self._size.hand_scale, bones)
        else:
            fits = [_unfitted(view, self._size.hand_scale) for view in views]
        found = {side: fit for side, fit in zip(sides, fits, strict=True) if fit is not None}
        if self._by_mediapipe:
            return {
                side: fit._replace(points=corrected_hand(fit.points, left=side == "L"))
                for side, fit in found.items()
            }
        return found

    def _find_body(
        self, seen: ViewingRays, surfaces: Surfaces, before: FilterOutput, fits: dict[str, HandFit]
    ) -> BodyDepths:
        wrists = {
            side: WristView(
                fit.points[0, :2] / fit.points[0, 2],
                float(fit.points[0, 2]),
                float(fit.sigma[0]),
                fit.certain,
            )
            for side, fit in fits.items()
            if np.isfinite(fit.points[0]).all()
        }
        return self._body.find(
            seen.part(BODY), surfaces.part(BODY), before.part(BODY), self._size, wrists=wrists
        )

    def _with_held_hands(self, found: Keypoints3D) -> Keypoints3D:
        """Move hands that are held with their wrist, so that they stay on the arm."""
        points = found.points.copy()
        for side, rows in HANDS.items():
            wrist = found.points[ARMS[side][2]]
            if not np.isfinite(wrist).all():
                continue
            held = (found.status[rows] == KeypointStatus.HELD)[:, None]
            self._from_wrist[rows] = np.where(held, self._from_wrist[rows], found.points[rows] - wrist)
            moved = wrist + self._from_wrist[rows]
            points[rows] = np.where(held & np.isfinite(moved), moved, points[rows])
        return replace(found, points=points)


def _unfitted(hand: HandView, scale: float) -> HandFit:
    nearest = hand.surfaces.nearest()
    depths = nearest.depth + scale * HAND_DEPTHS
    return HandFit(in_space(hand.rays, depths), nearest.sigma, np.isfinite(depths))


def _keypoints_of(
    output: FilterOutput,
    seen: ViewingRays,
    *,
    optimised: BoolArray,
    hidden: BoolArray,
    bias: FloatArray,
    max_sigma: FloatArray,
    memory: FloatArray,
) -> Keypoints3D:
    """Make keypoints with status, confidence and sigma of a filter's estimate.

    Args:
        output: Of the filter.
        seen: By the detector in this image.
        optimised: Keypoints whose depth of this image follows from others. Shape (n,).
        hidden: Keypoints before which something else lies in this image: held, though the detector guesses
            them. Shape (n,).
        bias: Standard deviation across the ray and along it of what no averaging removes: how the detector
            and the skin differ from person to person [m]. Shape (n, 2).
        max_sigma: Keypoints less certain than this are lost [m]. Shape (n,).
        memory: Confidence that each was last seen with. Shape (n,).
    """
    points = output.points
    across = np.hypot(output.sigma[:, :2] * output.depth[:, None], bias[:, :1])
    along = np.hypot(output.sigma[:, 2], bias[:, 1])
    sigma = np.column_stack([np.hypot(across, output.rays * along[:, None]), along])
    with np.errstate(invalid="ignore"):
        lost = ~(sigma.max(axis=1) <= max_sigma)
    status = np.where(
        seen.seen & output.fresh & ~hidden,
        np.where(optimised, KeypointStatus.OPTIMISED, KeypointStatus.MEASURED),
        KeypointStatus.HELD,
    )
    return Keypoints3D(
        points=np.where(lost[:, None], np.nan, points),
        confidence=np.where(lost, 0.0, np.where(seen.seen, seen.confidence, memory)),
        status=np.where(lost, KeypointStatus.LOST, status).astype(np.uint8),
        sigma=np.where(lost[:, None], np.nan, sigma),
        pixels=seen.pixels,
    )
