# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where a robot's right hand is, and how its palm is turned, while it spells beside its face.

Where a palm is out of reach its orientation goes before the place, as long as a word is spelled at one
place.

TEO's wrist bends the hand sideways only (its axis is the palm's normal), where a person's bends it down
as well. Letters that hang from the wrist (M, N, Ñ) are therefore out of reach near the face. What can be
had is fingers that point as the person's do: `fit_arm_and_hand` trades palm, place and fingers against
each other in one least squares problem.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import pinocchio as pin
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.hand_fit import HandPose
from teo_sign_authoring.alphabet.spelling_hand import HandProblem, fit_robot_hand
from teo_sign_capture.retarget.arm_kinematics import (
    ArmKinematics,
    Bounds,
    arm_bounds,
    search_starts,
    spelling_arm,
)
from teo_sign_capture.retarget.arm_residuals import ArmProblem, ArmWeights
from teo_sign_capture.retarget.arm_trajectory import search_arms
from teo_sign_capture.retarget.hand_goals import HandGoals
from teo_sign_capture.retarget.knots import least_clearance
from teo_sign_capture.signing_space import find_place

# [m] What the face reaches beyond its places: below the chin, to the side of an ear, behind the mouth, which
# is on the surface that counts in a collision; it ends so much below the crown.
_BELOW_CHIN, _BESIDE_EAR, _BEHIND_MOUTH, _BELOW_CROWN = 0.015, 0.001, 0.012, 0.015
# [m] How far before the robot a viewer at conversation distance is, eyes at the height of its own.
_VIEWER = 2.2
# [m] Half the thickness of a finger, and a little.
_RADIUS = 0.012


class _Face(NamedTuple):
    """A face in ``base_link`` at home, and who looks at it [m]."""

    half_width: float
    chin: float
    top: float
    plane: float
    eye: Array


def _face(humanoid: Humanoid) -> _Face:
    ear, mouth, chin, crown, eye = (
        find_place(humanoid, name).point for name in ("ear", "mouth", "chin", "head_top", "eye")
    )
    return _Face(
        half_width=round(abs(float(ear[1])) + _BESIDE_EAR, 3),
        chin=round(float(chin[2]) - _BELOW_CHIN, 3),
        top=round(float(crown[2]) - _BELOW_CROWN, 3),
        plane=round(float(mouth[0]) - _BEHIND_MOUTH, 3),
        eye=np.array([_VIEWER, 0.0, round(float(eye[2]), 2)]),
    )


def shift_off_face(robot: Robot, positions: Array) -> Array:
    """How a motion must be moved so that no part of the hand is seen before the face.

    Args:
        robot: The robot.
        positions: Joints of right arm and hand [rad]. Shape (n, joints).

    Returns:
        Shift of the hand in ``base_link`` [m], to the robot's right or down, whichever is less; zeros when
        nothing is hidden. Shape (3,).
    """
    face = _face(robot.humanoid)
    points = np.concatenate([_hand_points(robot, row) for row in positions])
    depth = face.eye[0] - points[:, 0]
    seen = face.eye[1:] + (points[:, 1:] - face.eye[1:]) * ((face.eye[0] - face.plane) / depth)[:, None]
    beside = np.abs(seen[:, 0]) > face.half_width + _RADIUS
    off = (seen[:, 1] < face.chin - _RADIUS) | (seen[:, 1] > face.top + _RADIUS)
    hiding = ~(beside | off)
    if not hiding.any():
        return np.zeros(3)
    shrink = (depth[hiding] / (face.eye[0] - face.plane)).max()
    level = seen[~off]
    right = shrink * float(level[:, 0].max() + face.half_width + _RADIUS)
    before = seen[~beside]
    down = shrink * float(before[:, 1].max() - face.chin + _RADIUS)
    return np.array([0.0, -right, 0.0]) if right <= down else np.array([0.0, 0.0, -down])


def _hand_points(robot: Robot, row: Array) -> Array:
    humanoid, hand = robot.humanoid, robot.humanoid.file.hand
    joints = humanoid.arm("right") + humanoid.hand("right")
    q = robot.configuration(dict(zip(joints, row.tolist(), strict=True)))
    frames = [hand.palm, *(frame for finger in hand.fingers.values() for frame in finger), *hand.thumb]
    placed = robot.placements(q, frames)
    heel = placed[0, :3, :3] @ np.array(hand.heel) + placed[0, :3, 3]
    return np.vstack([placed[:, :3, 3], heel])


# The elbow is bent by as much at least [rad]: nobody spells with a straight arm.
_BENT = np.radians(46.0)
# So far apart [m] all parts stay: planning finds distances to 2 mm (`teo_motion.collision`).
_APART = 0.002

_WEIGHTS = ArmWeights(
    # The palm 10 cm out of place counts as much as 11 deg out of orientation.
    in_air=np.full(3, 2.0),
    on_body=2.0,
    # A turn counts by about its angle: both directions together change by sqrt(1 + n^2) of it, n being the
    # share of its axis to the little finger's side.
    palm=0.77,
    fingers=0.77,
    # Nobody lifts an elbow to spell: 2 cm too high count as much as 11 deg of the palm. The hand goes lower.
    raised=10.0,
    # Chooses among equals, moves a reachable hand by less than 1 deg.
    easy=0.03,
    sideways=0.03,
)

# [m] A palm is moved no farther than this for the sake of how it is turned: letters must not lie beside their
# word. Where signs are read as made elsewhere; all letters of LSE that do not hang are within 10 cm.
_ONE_PLACE = 0.12
# For palms that would be: the place's weight doubles at 6 cm, which keeps fists that lean back by 30 deg, as
# TEO's wrist cannot, at 6 cm and upright.
_FIRM = replace(_WEIGHTS, strayed=0.06)


@dataclass(frozen=True, kw_only=True)
class ArmFit:
    """A pose of the arm.

    Attributes:
        positions: The joints of the arm [rad]. Shape (j,).
        palm: Orientation reached. Shape (3, 3).
        place: Middle of the palm reached, in ``base_link`` [m]. Shape (3,).
        angle_error: Angle between the orientation reached and the one wanted [rad].
        place_error: Distance from the place wanted [m].
    """

    positions: Array
    palm: Array
    place: Array
    angle_error: float
    place_error: float


def spelling_bounds(chain: ArmKinematics, *, both_sides: bool = False) -> Bounds:
    """Lower and upper bounds of an arm that spells [rad]. Shapes (j,).

    Args:
        chain: The arm.
        both_sides: Whether the left arm must be able to mirror the pose.
    """
    lower, upper = arm_bounds(chain.humanoid, "both" if both_sides else "right")
    elbow = np.arange(chain.count) == chain.elbow
    if chain.opens > 0.0:
        return lower, np.where(elbow, np.minimum(upper, -_BENT), upper)
    return np.where(elbow, np.maximum(lower, _BENT), lower), upper


def fit_arm(
    robot: Robot, palm: Array, place: Array, *, both_sides: bool = False, firm: bool = False
) -> ArmFit:
    """Find the arm that holds the palm so, from all starts; the best of those that touch nothing.

    Args:
        robot: The robot; head and trunk are at home.
        palm: Orientation wanted; columns along, to the little finger's side, out of the palm. Shape (3, 3).
        place: Where the middle of the palm should be, in ``base_link`` [m]. Shape (3,).
        both_sides: Whether the left arm must be able to mirror the pose.
        firm: Whether the place counts the more the farther the hand is from it.
    """
    chain = ArmKinematics(robot)
    problem = _problem(chain, palm[None], place[None], firm=firm)
    bounds, starts = spelling_bounds(chain, both_sides=both_sides), search_starts(chain.humanoid)
    found, costs = search_arms(problem, 0, np.zeros(1, np.intp), bounds, starts=starts)
    joints = chain.humanoid.arm("right")
    best_first = found[0, costs[0].argsort(kind="stable")]
    clear = (arm for arm in best_first if least_clearance(robot, joints, arm[None]) >= _APART)
    return _arm_fits(chain, next(clear, best_first[0])[None], palm[None], place[None])[0]


def follow_arm(
    robot: Robot, palms: Array, places: Array, near: ArmFit, *, firm: bool = False
) -> list[ArmFit]:
    """Find the arm along a path.

    Args:
        robot: The robot.
        palms: Orientations wanted. Shape (n, 3, 3).
        places: Places wanted [m]. Shape (n, 3).
        near: A pose from which all are sought.
        firm: As for `fit_arm`.
    """
    chain = ArmKinematics(robot)
    problem, frames = _problem(chain, palms, places, firm=firm), np.arange(len(places))
    found, _ = search_arms(problem, 0, frames, spelling_bounds(chain), starts=near.positions[None])
    return _arm_fits(chain, found[:, 0], palms, places)


def is_at_its_place(fits: Sequence[ArmFit]) -> bool:
    """Whether a hand is where the letters of a word are, all the time."""
    return max(fit.place_error for fit in fits) <= _ONE_PLACE


def _arm_fits(chain: ArmKinematics, positions: Array, palms: Array, places: Array) -> list[ArmFit]:
    """How well arms do; arguments of n poses as for `follow_arm`."""
    poses = chain.poses(positions)
    angles = Rotation.from_matrix(palms.transpose(0, 2, 1) @ poses.rotation).magnitude()
    away = np.linalg.norm(poses.place - places, axis=1)
    rows = zip(positions, poses.rotation, poses.place, angles.tolist(), away.tolist(), strict=True)
    return [
        ArmFit(positions=arm, palm=palm, place=place, angle_error=angle, place_error=far)
        for arm, palm, place, angle, far in rows
    ]


def _problem(chain: ArmKinematics, palms: Array, places: Array, *, firm: bool) -> ArmProblem:
    goals = HandGoals.without_arm(
        local=np.zeros_like(places),
        place=places,
        contact=np.zeros(len(places)),
        palm=palms[:, :, 2],
        fingers=palms[:, :, 0],
    )
    return ArmProblem(chain, (goals,), weights=_FIRM if firm else _WEIGHTS, easy=spelling_arm(chain.humanoid))


# [1/cm] Weight of a centimetre at a finger tip: about the angle in radians under which a finger's length sees
# it.
_HAND = 0.1
# [rad/m] Weight of the place, as long as it is near.
_PLACE = 1.0
# [m], [rad/m] Beyond this from where a letter belongs the place counts before anything else.
_FAR, _FAR_WEIGHT = 0.30, 20.0
_POSTURE = 0.03
# [rad] The search stays within this of where it begins, joint by joint: letters that hang get one arm.
_VALLEY = np.radians(10.0)


def fit_arm_and_hand(robot: Robot, pose: HandPose, place: Array, near: ArmFit) -> ArmFit:
    """Find the arm, with the hand in mind, for a person's hand whose palm is out of reach.

    Args:
        robot: The robot.
        pose: The person's hand.
        place: Where the middle of the palm should be, in ``base_link`` [m]. Shape (3,).
        near: The arm that comes nearest by itself, for a robot of which none is known for hands that hang.
    """
    humanoid, chain = robot.humanoid, ArmKinematics(robot)
    joints, hand_limits, easy = (
        humanoid.arm("right"),
        humanoid.limits(humanoid.hand("right")),
        spelling_arm(humanoid),
    )
    known = humanoid.file.signing_arms
    begin = near.positions if known is None else np.radians(known.hanging_deg)
    arm_lower, arm_upper = spelling_bounds(chain)
    arm_lower, arm_upper = np.maximum(arm_lower, begin - _VALLEY), np.minimum(arm_upper, begin + _VALLEY)
    lower, upper = (
        np.concatenate([arm_lower, hand_limits.lower]),
        np.concatenate([arm_upper, hand_limits.upper]),
    )
    arm_count = chain.count

    def palm(arm: Array) -> Array:
        q = robot.configuration(dict(zip(joints, arm.tolist(), strict=True)))
        return robot.placement(q, humanoid.file.hand.palm)

    def residuals(x: Array) -> Array:
        arm, hand = x[:arm_count], x[arm_count:]
        reached = palm(arm)
        away = reached[:3, 3] - place
        return np.concatenate(
            [
                pin.log3(pose.rotation.T @ reached[:3, :3]),
                _PLACE * away,
                [_FAR_WEIGHT * max(0.0, float(np.linalg.norm(away)) - _FAR)],
                _POSTURE * (arm - easy),
                _HAND * HandProblem(robot, pose, reached[:3, :3]).residuals(hand),
            ]
        )

    guess = fit_robot_hand(robot, pose, palm(begin)[:3, :3]).positions
    start = np.clip(np.concatenate([begin, guess]), lower + 1e-3, upper - 1e-3)
    fit = least_squares(residuals, start, bounds=(lower, upper), diff_step=1e-3)
    arm = np.clip(fit.x[:arm_count], arm_lower, arm_upper)
    return _arm_fits(chain, arm[None], pose.rotation[None], place[None])[0]
