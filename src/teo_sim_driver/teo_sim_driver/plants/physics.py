# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Joints with mass, gravity and contact: MuJoCo simulates the URDF, and position servos hold the joints.

Each joint has a servo of its own, a spring and a damper between where it is told to be and where it is. The
phalanges beyond the first follow theirs as the URDF says (`mimic`). The pelvis hangs on the world.

Needs `mujoco` (requirements/physics.txt).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from teo_description.humanoid import Humanoid
from teo_description.robot_schema import Servo
from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.trajectory import MotionState

# Inertia of a drive of which nothing is published [kg m^2]: those of TEO, a rotor of 1e-5 kg m^2 behind a
# gear of 100:1 in body and arms, and that of a small gearmotor in the hands.
_BODY_INERTIA, _HAND_INERTIA = 0.1, 0.01


def _servos_of(humanoid: Humanoid) -> Mapping[str, Servo]:
    """The drive of each commanded joint."""
    if humanoid.file.controllers is not None:
        servos = humanoid.file.controllers.servos
        return {name: servos.body.get(name, servos.hand) for name in humanoid.commanded_joints}
    efforts = humanoid.effort_limits(humanoid.commanded_joints).tolist()
    return {
        name: Servo(torque=effort, inertia=_BODY_INERTIA if name in humanoid.body_joints else _HAND_INERTIA)
        for name, effort in zip(humanoid.commanded_joints, efforts, strict=True)
    }


# [s]; ten to a step of the driver. The servos' time constant is 16 of them.
_TIMESTEP = 0.001

# Of a phalanx that its tendon moves with another one [kg m^2]: keeps its bond to that one well conditioned.
_FOLLOWER_INERTIA = 1e-3

# Natural frequency of a servo [rad/s], 10 Hz, critically damped: a fifth of the rate at which the real drives
# hear of set-points (50 Hz).
_SERVO_FREQUENCY = 2.0 * np.pi * 10.0

# Of an arm that signs [rad], for the inertia about its shoulder and wrist.
_BENT_ELBOW = -1.5


class Contact(NamedTuple):
    """Two parts of the robot that touch."""

    first: str
    second: str
    force: float
    """Normal force [N]."""
    depth: float
    """How far they are in each other [m]."""


class PhysicsPlant:
    """The whole robot; see `Plant`."""

    def __init__(self, humanoid: Humanoid) -> None:
        """Stand still at home."""
        self._model = model = _model(humanoid)
        joints = humanoid.commanded_joints
        self._hands = len(humanoid.body_joints)  # where they begin among the joints
        self._data = mujoco.MjData(model)
        self._columns = np.array([model.joint(name).qposadr[0] for name in joints])
        self._speeds = np.array([model.joint(name).dofadr[0] for name in joints])
        self._actuators = np.array([model.actuator(name).id for name in joints])
        # A servo is a spring about its set-point and a damper about 0: this much of the velocity that is
        # asked for, added to the set-point, makes it a damper about that velocity.
        self._lead = -model.actuator_biasprm[self._actuators, 2] / model.actuator_gainprm[self._actuators, 0]
        self._told = MotionState.at_rest(humanoid.hanging)
        _stand(model, self._data, humanoid)
        self._behind = 0.0

    def step(self, asked: MotionState, duration: float) -> MotionState:
        """Move for so long; what is asked for is interpolated, as the real drives do.

        Hands say that they are where they were told to be: the real Dextra measures nothing.
        """
        self._behind += duration
        steps = round(self._behind / _TIMESTEP)
        self._behind -= steps * _TIMESTEP
        before, self._told = self._told, asked
        for i in range(1, steps + 1):
            part = i / steps
            position = before.positions + part * (asked.positions - before.positions)
            velocity = before.velocities + part * (asked.velocities - before.velocities)
            self._data.ctrl[self._actuators] = position + self._lead * velocity
            mujoco.mj_step(self._model, self._data)
        moved = self._data.qpos, self._data.qvel, self._data.qacc
        places = self._columns, self._speeds, self._speeds
        return MotionState(
            *(
                np.concatenate([values[place[: self._hands]], told[self._hands :]])
                for values, place, told in zip(moved, places, asked, strict=True)
            )
        )

    @property
    def positions(self) -> FloatArray:
        """Where the joints are, hands too [rad]. Shape (joints,)."""
        positions: FloatArray = self._data.qpos[self._columns]
        return positions

    @property
    def torques(self) -> FloatArray:
        """Of the servos [N m]. Shape (joints,)."""
        forces: FloatArray = self._data.actuator_force[self._actuators]
        return forces

    def contacts(self) -> list[Contact]:
        """Parts that touch now."""
        model, data = self._model, self._data
        found = []
        force: NDArray[np.float64] = np.zeros(6)
        for i, contact in enumerate(data.contact[: data.ncon]):
            mujoco.mj_contactForce(model, data, i, force)
            first, second = _bodies(model, contact)
            found.append(Contact(first, second, float(force[0]), float(-contact.dist)))
        return found


def _model(humanoid: Humanoid) -> mujoco.MjModel:
    """The URDF with servos, without contact between parts that are built into each other.

    Those are the ones that two joints at most connect, whose boxes reach into each other when they turn, and
    those that overlap at home.
    """
    servos = _servos_of(humanoid)
    spec = mujoco.MjSpec.from_string(humanoid.urdf_text())
    spec.option.timestep = _TIMESTEP
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST  # damping of servos is stiff
    for joint in spec.joints:
        if joint.name in servos:
            joint.armature, joint.actfrclimited = servos[joint.name].inertia, False
        if joint.name not in humanoid.body_joints:
            joint.frictionloss = 0.0  # a hand's is that of its motors; legs hang still
        if joint.name not in humanoid.all_joints:
            joint.armature = _FOLLOWER_INERTIA
    bare = spec.compile()
    data = mujoco.MjData(bare)
    _stand(bare, data, humanoid)
    parent = bare.body_parentid
    built = {_bodies(bare, contact) for contact in data.contact[: data.ncon]}
    built |= {(bare.body(parent[parent[i]]).name, bare.body(i).name) for i in range(1, bare.nbody)}
    for first, second in built:
        spec.add_exclude(bodyname1=first, bodyname2=second)
    inertias = _inertias(bare, data, humanoid.elbows)
    for name in humanoid.all_joints:
        inertia = inertias[bare.joint(name).dofadr[0]]
        stiffness, damping = inertia * _SERVO_FREQUENCY**2, 2.0 * inertia * _SERVO_FREQUENCY
        actuator = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        actuator.gainprm[0], actuator.biastype = stiffness, mujoco.mjtBias.mjBIAS_AFFINE
        actuator.biasprm[:3] = 0.0, -stiffness, -damping
        if name in servos:
            actuator.forcelimited, actuator.forcerange = True, (-servos[name].torque, servos[name].torque)
    return spec.compile()


def _inertias(model: mujoco.MjModel, data: mujoco.MjData, elbows: tuple[str, ...]) -> FloatArray:
    """The most that each joint has to turn, elbows straight or bent [kg m^2]. Shape (nv,)."""
    found = []
    for angle in (0.0, _BENT_ELBOW):
        for elbow in elbows:
            data.joint(elbow).qpos[0] = angle
        mujoco.mj_forward(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        found.append(mass.diagonal())
    return np.asarray(np.max(found, axis=0))


def _bodies(model: mujoco.MjModel, contact: mujoco.MjContact) -> tuple[str, str]:
    """The parts that touch, by name."""
    first, second = sorted(model.body(model.geom_bodyid[geom]).name for geom in contact.geom)
    return first, second


def _stand(model: mujoco.MjModel, data: mujoco.MjData, humanoid: Humanoid) -> None:
    """Put the robot to its home, every phalanx as the joint that it follows has it; tell the servos."""
    for name, angle in humanoid.home.items():
        data.joint(name).qpos[0] = angle
    for i in range(model.neq):
        follower, driven = model.eq_obj1id[i], model.eq_obj2id[i]
        angle = data.qpos[model.jnt_qposadr[driven]]
        data.qpos[model.jnt_qposadr[follower]] = np.polynomial.polynomial.polyval(angle, model.eq_data[i, :5])
    for i in range(model.nu):
        data.ctrl[i] = data.qpos[model.jnt_qposadr[model.actuator_trnid[i, 0]]]
    mujoco.mj_forward(model, data)
