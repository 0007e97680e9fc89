# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver makes of plans and of what a world's queue has sent, and the judge of executed motion.

The judge knows positions and the robot description alone, not what planner or driver say of a motion: limits
are judged by differences of positions, self-contact by MuJoCo, which neither of them uses for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray
from trajectory_msgs.msg import JointTrajectory

from driver_messages import send
from queue_world import World
from teo_common.arrays import Array
from teo_description.humanoid import load_humanoid
from teo_lut_executor.execution.interface import StopReady, TrajectoryReady
from teo_lut_executor.node.messages import to_stop, to_trajectory
from teo_motion.sentence.plan import Plan
from teo_names import COMMANDED_JOINTS, HOME, LEFT_HAND, RIGHT_HAND, joint_limits, urdf_text
from teo_sim_driver.joint_follower import JointFollower

STEP = 0.001  # [s] between two positions that are looked at
_STEP = 1_000_000  # [ns], the same
# Limits of the joints by default, as the README of teo_motion gives them [rad/s^2], [rad/s^3]: four times as
# much for hands.
_QUICKNESS = np.where(np.isin(COMMANDED_JOINTS, LEFT_HAND + RIGHT_HAND), 4.0, 1.0)
_ACCELERATION, _JERK = 7.0 * _QUICKNESS, 105.0 * _QUICKNESS
# A position may be outside its limits by one count of TEO's encoders [rad].
_COUNT = 1.5e-5
NEAR = 0.002  # [m]; parts that are nearer than this are looked at


class Reached(NamedTuple):
    """The most of its limits that a motion reaches."""

    beyond: float
    """How far a position is outside its limits [rad]; negative inside."""
    velocity: float
    """Over the limit [1], as the two below."""
    acceleration: float
    jerk: float

    def broken(self, rounding: float = 1e-6) -> list[str]:
        """Names of the limits that the motion breaks.

        Args:
            rounding: Share of velocity, acceleration and jerk that is put down to rounding [1].
        """
        position, *shares = self
        names = ["position"] if position > _COUNT else []
        fast = (name for name, share in zip(self._fields[1:], shares, strict=True) if share > 1.0 + rounding)
        return [*names, *fast]


def judged(positions: Array, step: float = STEP) -> Reached:
    """Judge a motion of the commanded joints by its positions.

    Args:
        positions: At equal steps of time [rad]; of several stretches, each by itself. Shape
            (..., steps, joints), at least four steps.
        step: Time between two positions [s].
    """
    limits = joint_limits(COMMANDED_JOINTS)
    shares = [
        float((np.abs(np.diff(positions, order, axis=-2)) / limit).max() / step**order)
        for order, limit in enumerate((limits.velocity, _ACCELERATION, _JERK), start=1)
    ]
    return Reached(float(max((limits.lower - positions).max(), (positions - limits.upper).max())), *shares)


class ContactJudge:
    """Distances of TEO's parts by MuJoCo, but of those of one hand, which are meant to meet."""

    def __init__(self) -> None:
        """Leave out what is built into each other: the parts that are near each other at home."""
        spec = mujoco.MjSpec.from_string(urdf_text())
        for geom in spec.geoms:
            geom.margin = NEAR / 2.0
        self._model = model = spec.compile()
        self._data = mujoco.MjData(model)
        self._places = [model.joint(name).qposadr[0] for name in COMMANDED_JOINTS]
        # Phalanges that follow a tendon.
        self._led = model.jnt_qposadr[model.eq_obj1id]
        self._leading = model.jnt_qposadr[model.eq_obj2id]
        self._parts = [model.body(body).name for body in model.geom_bodyid]
        for name, angle in HOME.items():
            self._data.joint(name).qpos[0] = angle
        self._apart: NDArray[np.bool_] = np.array(
            [[not one_hand(first, second) for second in self._parts] for first in self._parts]
        )
        _, built = self._near(np.array([HOME[name] for name in COMMANDED_JOINTS]))
        for first, second in built:
            same = [np.array([part == each for part in self._parts]) for each in (first, second)]
            self._apart[np.ix_(*same)] = self._apart[np.ix_(*reversed(same))] = False

    def nearest(self, postures: Array) -> tuple[float, str]:
        """Least distance of two parts in any of the postures [m], `NEAR` if none is less, and which they are.

        Args:
            postures: Of the commanded joints [rad]. Shape (n, joints).
        """
        least, parts = NEAR, ""
        for posture in postures:
            distances, pairs = self._near(posture)
            if distances.size and distances.min() < least:
                least = float(distances.min())
                parts = " and ".join(pairs[int(distances.argmin())])
        return least, parts

    def _near(self, posture: Array) -> tuple[Array, list[list[str]]]:
        """Distances [m] of the parts that count and are nearer than `NEAR`, and which they are."""
        model, data = self._model, self._data
        data.qpos[self._places] = posture
        data.qpos[self._led] = model.eq_data[:, 0] + model.eq_data[:, 1] * data.qpos[self._leading]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        geoms = data.contact.geom
        counted = self._apart[geoms[:, 0], geoms[:, 1]]
        pairs = [sorted((self._parts[one], self._parts[other])) for one, other in geoms[counted]]
        return data.contact.dist[counted], pairs


def one_hand(first: str, second: str) -> bool:
    """Whether both are parts of the same hand."""
    return any(
        all(part.startswith(side) or part == f"Frontal{side}Wrist_link" for part in (first, second))
        for side in ("Left", "Right")
    )


def following(plan: Plan, period: float) -> JointFollower:
    """A follower that has taken a plan as the executor sends it, at time 0.

    Args:
        plan: From where the robot stands.
        period: Usual time between two steps [s].
    """
    follower = JointFollower(
        limits=joint_limits(COMMANDED_JOINTS), start=plan.positions[0].copy(), period=period
    )
    follower.step(0)
    send(follower, to_trajectory(COMMANDED_JOINTS, plan.samples, start=0.0), 0)
    return follower


def executed(world: World) -> Array:
    """Positions to which the driver takes the robot, every millisecond [rad]. Shape (n, joints).

    Raises:
        TrajectoryError: The driver refuses a motion.
    """
    limits, start = joint_limits(COMMANDED_JOINTS), load_humanoid().ready.copy()
    follower = JointFollower(limits=limits, start=start, period=0.001)
    # A motion with a time comes half a period before that: what the sender did not know by then must not
    # matter. One that is overtaken by the next before it begins comes with that: in the order of sending.
    begin = np.array([time - (0.01 if _is_timed(event) else 0.0) for time, event in world.taken])
    come = np.minimum.accumulate(begin[::-1])[::-1]
    messages = [
        (round(time * 1e9), _message(world.planner.limits.names, event))
        for time, (_, event) in zip(come, world.taken, strict=True)
    ]
    path, now, end = [], messages[0][0], round(world.now * 1e9)
    while now < end:
        while messages and messages[0][0] <= now:
            send(follower, messages.pop(0)[1], now)
        path.append(follower.step(now).positions)
        now += _STEP
    assert not messages
    return np.array(path)


def _is_timed(event: TrajectoryReady | StopReady) -> bool:
    return isinstance(event, TrajectoryReady) and event.start is not None


def _message(names: Sequence[str], event: TrajectoryReady | StopReady) -> JointTrajectory:
    if isinstance(event, StopReady):
        return to_stop(names, event.end, event.lead)
    return to_trajectory(names, event.samples, start=event.start)
