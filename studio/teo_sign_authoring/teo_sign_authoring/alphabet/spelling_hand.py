# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's handshape on TEO's right hand.

TEO's finger has one motor for three joints that bend alike, and no motor to spread; its thumb has two, one of
them for both of its joints. What is sought is the hand that *looks* like the person's: for each finger the
vector from knuckle to tip, which a person's joints make with TEO's phalanges, is compared with TEO's own

- in the plane in which the finger bends (the shape; both ends of the last phalanx, for a fist and a claw have
  their tips at like places), and
- across the viewer's line of sight (what is seen), in the orientation that each palm has.

The second term makes what the hand cannot do visible all the same: fingers that are spread cannot part on
TEO, but with the palm turned half to the side the index that bends a little more parts from the middle finger
in the viewer's eye. The thumb's tip is sought relative to the index knuckle, and,
where the person's thumb and a finger nearly touch, at the same distance from that finger, last phalanx to
last phalanx, with a weight that grows as they get nearer, after DexPilot (Handa et al., ICRA 2020). Overlap
of thumb and fingers is penalised, and neighbouring fingers keep the difference of their bends.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from teo_common.arrays import Array
from teo_description.hand_geometry import HandPoints, hand_table, segment_distances
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.hand_fit import HandPose, finger_directions
from teo_sign_capture.retarget.hand_motion import axis_shares, thumb_contacts
from teo_sign_capture.signing_space import finger_rows

# Weights of the bending plane and of the viewer's plane; chosen by eye on pictures of the thirty letters.
_SHAPE, _SEEN = 0.6, 1.0
# Weight of a contact of thumb and finger, at distance 0.
_CONTACT = 8.0
# Weight of the side on which the thumb is of a finger that it is at.
_SIDE = 1.0
# [cm/rad] Weight of the differences of neighbouring fingers' flexion: a hand looks torn where one finger of
# four in a claw falls into a fist.
_EVEN = 3.0
# Share of depth, left and up in the distance of thumb and finger: a gap along the line of sight is hardly
# seen, and in the recordings it is the uncertain part.
_FLAT = np.array([0.5, 1.0, 1.0])
# [cm/rad] Pull of abductor and thumb towards home: chooses among thumbs that look alike the one that has
# the least way to go, and moves its tip by a millimetre or so.
_REST = 0.1
# Weight of the place of neighbouring tips to each other, as seen: parted in U, together in P.
_PARTED = 1.0
# Weight of overlap: stronger than any wish.
_OVERLAP = 15.0
# [rad] Spread is no longer seen in a finger that is bent so much in all.
_SPREAD_ENDS = np.radians(60.0)
# [rad] Abductor and thumb from which the search sets out, as far as a hand goes: it has several valleys.
_STARTS = np.radians(
    [[abductor, thumb] for abductor in (2.0, 30.0, 60.0, 88.0) for thumb in (-60.0, -15.0, 20.0, 55.0)]
)
# The search sets out from so many of the starts, the best ones: more found nothing better.
_SEARCHES = 10


@dataclass(frozen=True, kw_only=True)
class HandFit:
    """A handshape on a robot.

    Attributes:
        positions: The axes of the hand, as of `HandGeometry.joints` [rad]. Shape (axes,).
        fingertip_error: Mean distance of the robot's finger tips from where a person's joints would put them,
            in the plane in which each finger bends [m].
        thumb_error: Distance of the thumb's tip from the person's, scaled, both from the index knuckle [m].
        clearance: Smallest distance of thumb and fingers [m].
    """

    positions: Array
    fingertip_error: float
    thumb_error: float
    clearance: float


def fit_robot_hand(robot: Robot, pose: HandPose, palm: Array) -> HandFit:
    """Find the axes of a robot's hand that look most like a person's hand.

    Args:
        robot: The robot.
        pose: The person's hand.
        palm: Orientation that its palm has; columns along, to the little finger's side, out of it. Shape
            (3, 3).
    """
    problem = HandProblem(robot, pose, palm)
    limits = problem.limits
    starts = [
        np.clip(bends, limits.lower[2:] + 1e-3, limits.upper[2:] - 1e-3)
        for bends in (problem.best_bends(), problem.mean_bends())
    ]
    thumbs = np.clip(_STARTS, limits.lower[:2], limits.upper[:2])
    points = [np.concatenate([thumb, fingers]) for thumb in thumbs for fingers in starts]
    points.sort(key=lambda point: float((problem.residuals(point) ** 2).sum()))
    fits = [
        least_squares(problem.residuals, point, bounds=(limits.lower, limits.upper), diff_step=1e-3)
        for point in points[:_SEARCHES]
    ]
    best = min(fits, key=lambda fit: float(fit.cost))
    return problem.result(np.clip(best.x, limits.lower, limits.upper))


class HandProblem:
    """Least squares problem of one handshape."""

    def __init__(self, robot: Robot, pose: HandPose, palm: Array) -> None:
        """State it; arguments as for `fit_robot_hand`."""
        table = hand_table(robot)
        self._hand, self._shares = table.hand, axis_shares(table)
        self.limits = self._hand.limits
        self._home_thumb = np.array([robot.humanoid.home[joint] for joint in self._hand.joints[:2]])
        self._palm = palm
        self._seen_as = pose.rotation
        rows, length = finger_rows(self._hand), self._hand.finger_length
        self._bends, tips = pose.bends[rows], pose.tips[rows]
        chains = [
            _finger(bends, spread, phalanges)
            for bends, spread, phalanges in zip(
                self._bends, pose.spreads[rows], self._hand.phalanges, strict=True
            )
        ]
        self._lasts, self._fingers = np.array(chains).transpose(1, 0, 2)
        self._thumb = pose.thumb[2] * length
        gaps = ((pose.thumb[2] - tips) @ pose.rotation.T) * _FLAT
        self._nearness, self._apart = thumb_contacts(self._hand, np.linalg.norm(gaps, axis=1) * length)
        # A finger that the thumb is near has it on one side or the other: another letter.
        self._beside = (pose.thumb[2, 1] - tips[:, 1]) * length
        self._steps = np.diff(self._bends.sum(axis=1)) / 3.0

    def mean_bends(self) -> Array:
        """Flexion of each finger that bends as much as the person's in all [rad]. Shape (fingers,)."""
        flexions: Array = self._bends.sum(axis=1) / 3.0 * self._shares
        return flexions

    def best_bends(self) -> Array:
        """Flexion of each finger by itself, the best of all [rad]. Shape (fingers,)."""
        grids = np.linspace(self.limits.lower[2:], self.limits.upper[2:], 40)
        reached = np.array(
            [
                [
                    _finger(np.full(3, bend), 0.0, phalanges)
                    for bend, phalanges in zip(row, self._hand.phalanges, strict=True)
                ]
                for row in grids / self._shares
            ]
        )
        shape = [
            _SHAPE * (reached[:, :, end] - wanted) for end, wanted in enumerate((self._lasts, self._fingers))
        ]
        seen = _SEEN * self._seen(reached[:, :, 1], self._fingers)
        cost = sum((away[..., (0, 2)] ** 2).sum(axis=-1) for away in shape) + (seen**2).sum(axis=-1)
        best: Array = np.take_along_axis(grids, np.argmin(cost, axis=0)[None], axis=0)[0]
        return best

    def residuals(self, positions: Array) -> Array:
        """Weighted differences [cm] at the positions of the hand's axes [rad]."""
        points = self._hand.points(positions)
        fingers, thumb = self._vectors(points)
        lasts = points.fingers[:, 2] - points.fingers[:, 0]
        thumb_ends = self._flattened(points.thumb[1:])
        apart = segment_distances(*thumb_ends, *self._flattened(points.fingers[:, 2:]).transpose(1, 0, 2))
        overlap = np.minimum(self._hand.thumb_clearances(points), 0.0)
        return 100.0 * np.concatenate(
            [
                _SHAPE * (lasts - self._lasts)[:, (0, 2)].ravel(),
                _SHAPE * (fingers - self._fingers)[:, (0, 2)].ravel(),
                _SEEN * self._seen(fingers, self._fingers).ravel(),
                _SHAPE * (thumb - self._thumb),
                _SEEN * self._seen(thumb, self._thumb),
                self._nearness * _CONTACT * (apart - self._apart),
                self._nearness * _SIDE * (points.thumb[2, 1] - points.fingers[:, 3, 1] - self._beside),
                _PARTED * np.diff(self._seen(fingers, self._fingers), axis=0).ravel(),
                _OVERLAP * overlap,
                0.01 * _EVEN * (np.diff(positions[2:] / self._shares) - self._steps),
                0.01 * _REST * (positions[:2] - self._home_thumb),
            ]
        )

    def result(self, positions: Array) -> HandFit:
        """How well positions of the axes [rad] do."""
        points = self._hand.points(positions)
        fingers, thumb = self._vectors(points)
        return HandFit(
            positions=positions,
            fingertip_error=float(np.linalg.norm((fingers - self._fingers)[:, (0, 2)], axis=1).mean()),
            thumb_error=float(np.linalg.norm(thumb - self._thumb)),
            clearance=float(self._hand.thumb_clearances(points).min()),
        )

    def _flattened(self, points: Array) -> Array:
        """Points in the viewer's axes, depth shortened."""
        flat: Array = (points @ self._palm.T) * _FLAT
        return flat

    def _vectors(self, points: HandPoints) -> tuple[Array, Array]:
        return points.fingers[:, 3] - points.fingers[:, 0], points.thumb[2] - points.fingers[0, 0]

    def _seen(self, robot: Array, person: Array) -> Array:
        """Difference across the viewer's line of sight: left and up."""
        return (robot @ self._palm.T - person @ self._seen_as.T)[..., 1:]


def _finger(bends: Array, spread: float, phalanges: Array) -> Array:
    """Ends of the last phalanx from the knuckle: a person's joints, a robot's phalanges [m]. Shape (2, 3)."""
    total = np.cumsum(bends)
    fading = max(0.0, 1.0 - abs(float(total[2])) / _SPREAD_ENDS)
    joints: Array = np.cumsum(phalanges[:, None] * finger_directions(total, spread * fading), axis=0)
    return joints[1:]
