# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A robot's arm: where its joints may be, and where it is at many positions at once. Both arms as right arms.

An arm of six joints reaches a pose of the hand in few ways, one of seven may turn its elbow about the line
from shoulder to wrist. Bounds and the arm at ease keep it where a person has it.

Pinocchio gives one pose a call, most of which is Python; a motion of some hundred frames sought from several
starts asks for thousands of poses a step. Here they are all worked out together. The geometry is read off the
robot's model with all joints at zero. Each link is given axes of which one is its joint's: the base's where
the joint turns about one of these, its own where it does not.

The left arm is the right one in a mirror (`mirrored`): what is said here of the right arm is used for both.
"""

from __future__ import annotations

from functools import cache
from typing import Literal, NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid, Side
from teo_description.robot import Robot

Bounds = tuple[Array, Array]

# Distance kept from every limit, so that a planner may overshoot by its rounding [rad].
_MARGIN = np.radians(1.0)
# Starts of a search on an arm for which none are given: more find no better arm for one in a hundred of the
# scores' postures.
_SAMPLED = 32
# Joints that hold a hand in space, and no more.
_WITHOUT_CHOICE = 6


@cache
def arm_bounds(humanoid: Humanoid, side: Side | Literal["both"]) -> Bounds:
    """Lower and upper bounds kept by an arm of j joints, seen as a right arm [rad]. Shapes (j,).

    Args:
        humanoid: Whose arm.
        side: Which arm; "both" for a right arm that the left one can mirror.
    """
    if side == "both":
        (right_lower, right_upper), (left_lower, left_upper) = (
            arm_bounds(humanoid, "right"),
            arm_bounds(humanoid, "left"),
        )
        return np.maximum(right_lower, left_lower), np.minimum(right_upper, left_upper)
    limits = humanoid.limits(humanoid.arm(side))
    lower, upper = limits.lower, limits.upper
    if side == "left":
        ends = np.stack([mirrored(humanoid, lower), mirrored(humanoid, upper)])
        lower, upper = ends.min(axis=0), ends.max(axis=0)
    natural = humanoid.file.natural_arm
    return (
        np.maximum(lower, np.radians(natural.lower_deg)) + _MARGIN,
        np.minimum(upper, np.radians(natural.upper_deg)) - _MARGIN,
    )


def mirrored(humanoid: Humanoid, arm: Array) -> Array:
    """The arm, or arms, of the other side that mirror some [rad]. Shape (j,) or (n, j)."""
    swapped: Array = _mirror_signs(humanoid, humanoid.arm("right")) * arm
    return swapped


def mirrored_hand(humanoid: Humanoid, axes: Array) -> Array:
    """Axes of a left hand that mirrors a right one, or the reverse [rad]. Shape (axes,) or (n, axes)."""
    swapped: Array = _mirror_signs(humanoid, humanoid.hand("right")) * axes
    return swapped


@cache
def easy_arm(humanoid: Humanoid) -> Array:
    """A right arm that signs at ease [rad]. Shape (j,)."""
    arms = humanoid.file.signing_arms
    return _waiting(humanoid) if arms is None else np.radians(arms.easy_deg)


def with_elbow_out(humanoid: Humanoid, bounds: Bounds) -> Bounds | None:
    """Bounds in which the upper arm is no nearer to the body than at ease; None of an arm without a choice.

    An arm of six joints or fewer holds a hand in one way, or a few. The elbow of one with more is free, and
    may be led off a body that it would touch.

    Args:
        humanoid: Whose right arm.
        bounds: Which to narrow [rad].
    """
    easy, joints = easy_arm(humanoid), humanoid.arm("right")
    if len(easy) <= _WITHOUT_CHOICE:
        return None
    lower, upper = bounds[0].copy(), bounds[1].copy()
    for joint, share in humanoid.file.detour.sideways.items():
        row = joints.index(joint)
        if share < 0.0:
            upper[row] = min(upper[row], easy[row])
        else:
            lower[row] = max(lower[row], easy[row])
    return lower, upper


@cache
def spelling_arm(humanoid: Humanoid) -> Array:
    """A right arm that spells at ease [rad]. Shape (j,)."""
    arms = humanoid.file.signing_arms
    return _waiting(humanoid) if arms is None else np.radians(arms.spelling_deg)


@cache
def search_starts(humanoid: Humanoid) -> Array:
    """Right arms from which a posture is sought, the one at ease first [rad]. Shape (s, j)."""
    arms = humanoid.file.signing_arms
    if arms is not None:
        return np.vstack([easy_arm(humanoid), np.radians([arms.spelling_deg, *arms.starts_deg])])
    from scipy.stats import qmc  # here: a second that robots whose arms have given starts do without

    lower, upper = arm_bounds(humanoid, "right")
    # Evenly spread, the same ones each time (J. H. Halton, Numerische Mathematik 2, 1960).
    spread = qmc.Halton(len(lower), scramble=False).random(_SAMPLED)
    return np.vstack([easy_arm(humanoid), lower + spread * (upper - lower)])


def _waiting(humanoid: Humanoid) -> Array:
    waiting: Array = humanoid.ready[humanoid.columns(humanoid.arm("right"))]
    return waiting


@cache
def _mirror_signs(humanoid: Humanoid, joints: tuple[str, ...]) -> Array:
    return humanoid.mirror_signs(joints)


# Cosine of the angle within which a joint's axis is an axis of the base, or the normal of the palm: URDFs are
# rounded.
_ALONG, _NORMAL = 1.0 - 1e-9, 0.7


class ArmPoses(NamedTuple):
    """Where n arms of j joints are, in ``base_link`` with the trunk at home.

    Attributes:
        axes: Of the joints, unit vectors. Shape (n, j, 3).
        origins: A point on each axis [m]. Shape (n, j, 3).
        rotation: Of the palm; columns along the hand, to the little finger's side, out of the palm.
            Shape (n, 3, 3).
        place: Of the palm [m]. Shape (n, 3).
    """

    axes: Array
    origins: Array
    rotation: Array
    place: Array

    def points(self, local: Array) -> Array:
        """Points of the hand, from the palm's axes to the base's [m]. Shape (n, 3) each."""
        placed: Array = np.einsum("nij,nj->ni", self.rotation, local) + self.place
        return placed

    def point_jacobian(self, points: Array) -> Array:
        """How points that all joints carry move with them [m/rad]. Shape (n, 3, j)."""
        return _cross(self.axes, points[:, None] - self.origins)

    def direction_jacobian(self, directions: Array) -> Array:
        """The same of directions [1/rad]. Shape (n, 3, j)."""
        return _cross(self.axes, directions[:, None])


class ArmKinematics:
    """The right arm of one robot.

    Attributes:
        humanoid: Whose arm it is.
        count: How many joints it has, j.
        elbow, turn, wrist: Rows of the joints whose axes go through the elbow, along the forearm, and through
            the wrist.
        sideways: Which joints bend the hand towards the thumb or the little finger. Shape (j,).
        opens: Sign of the elbow's way from folded to straight.
        shoulder: Where the shoulder's axes meet, in ``base_link`` [m]. Shape (3,).
        reach: From the shoulder over elbow and wrist to the palm [m].
    """

    def __init__(self, robot: Robot) -> None:
        self.humanoid = robot.humanoid
        joints, file = self.humanoid.arm("right"), self.humanoid.file
        self.count = len(joints)
        q = robot.configuration(dict.fromkeys(joints, 0.0))
        palm = robot.placement(q, file.hand.palm)
        placed = robot.joint_placements(q, joints)
        origins = placed[:, :3, 3]

        def moving(link: str) -> int:
            return joints.index(robot.moving_joint(link))

        links = file.collision.right_arm
        self.elbow, self.turn, self.wrist = (
            moving(link) for link in (links.forearm[0], links.forearm[-1], links.hand[0])
        )
        upper = moving(links.shoulder[-1])
        self.shoulder: Array = origins[upper]
        axes = np.array(
            [frame[:3, :3] @ robot.joint_axis(name) for frame, name in zip(placed, joints, strict=True)]
        )
        self.sideways = (np.arange(self.count) > self.turn) & (np.abs(axes @ palm[:3, 2]) > _NORMAL)
        frames = [_link_axes(axis) for axis in axes]
        self._turns = [int(np.argmax(axis @ frame)) for axis, frame in zip(axes, frames, strict=True)]
        before = [np.eye(3), *frames]
        self._changes = [
            None if np.array_equal(one, other) else one.T @ other
            for one, other in zip(before, frames, strict=False)
        ]
        steps = np.diff(origins, axis=0, prepend=np.zeros((1, 3)))
        self._steps = np.array([step @ frame for step, frame in zip(steps, before, strict=False)])
        last = palm[:3, 3] - origins[-1]
        self._palm_rotation, self._palm_step = frames[-1].T @ palm[:3, :3], last @ frames[-1]
        self.opens = self._opening()
        self.reach = float(np.linalg.norm(steps[upper + 1 :], axis=1).sum() + np.linalg.norm(last))

    def _opening(self) -> float:
        """Which of the elbow's bounds folds the arm: the other is where it opens to."""
        bent = np.zeros((2, self.count))
        bent[:, self.elbow] = [bound[self.elbow] for bound in arm_bounds(self.humanoid, "right")]
        lowest, highest = np.linalg.norm(self.poses(bent).origins[:, self.wrist] - self.shoulder, axis=1)
        return 1.0 if lowest < highest else -1.0

    def poses(self, positions: Array) -> ArmPoses:
        """Where the arm is.

        Args:
            positions: Of its joints [rad]. Shape (n, j).
        """
        count = len(positions)
        cosines, sines = np.cos(positions), np.sin(positions)
        turned = np.broadcast_to(np.eye(3), (count, 3, 3)).copy()  # columns: the axes of the link
        place = np.zeros((count, 3))
        axes, origins = np.empty((count, len(self._turns), 3)), np.empty((count, len(self._turns), 3))
        for joint, axis in enumerate(self._turns):
            place = place + turned @ self._steps[joint]
            change = self._changes[joint]
            if change is not None:
                turned = turned @ change
            origins[:, joint], axes[:, joint] = place, turned[:, :, axis]
            one, other = turned[:, :, (axis + 1) % 3], turned[:, :, (axis + 2) % 3]
            cosine, sine = cosines[:, joint, None], sines[:, joint, None]
            first, second = cosine * one + sine * other, cosine * other - sine * one
            turned[:, :, (axis + 1) % 3], turned[:, :, (axis + 2) % 3] = first, second
        return ArmPoses(axes, origins, turned @ self._palm_rotation, place + turned @ self._palm_step)


def angles_between(first: Array, second: Array) -> Array:
    """Angles between unit vectors [rad]. Shapes (n, 3), (n, 3) or (3,), and (n,)."""
    angles: Array = 2.0 * np.arcsin(np.clip(np.linalg.norm(first - second, axis=1) / 2.0, 0.0, 1.0))
    return angles


def _cross(first: Array, second: Array) -> Array:
    """Vector products of rows as columns, three times as fast as `np.cross`. Shapes (n, k, 3), (n, 3, k)."""
    x, y, z = first[..., 0], first[..., 1], first[..., 2]
    u, v, w = second[..., 0], second[..., 1], second[..., 2]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=1)


def _link_axes(axis: Array) -> Array:
    """Axes of a link with its joint's among them, as columns: the base's if they will do. Shape (3, 3)."""
    if axis.max() > _ALONG:
        return np.eye(3)
    aside = np.cross(axis, np.eye(3)[int(np.abs(axis).argmin())])
    aside /= np.linalg.norm(aside)
    return np.column_stack([axis, aside, np.cross(axis, aside)])
