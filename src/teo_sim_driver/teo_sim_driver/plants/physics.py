# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Joints with mass, gravity and contact: MuJoCo simulates the URDF, and position servos hold the joints.

Each joint has a servo of its own, a spring and a damper between where it is told to be and where it is. The
phalanges beyond the first follow theirs as the URDF says (`mimic`). The pelvis hangs on the world.

Needs `mujoco` (requirements/physics.txt).
"""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from teo_description import ALL_JOINTS, COMMANDED_JOINTS, HOME, urdf_text
from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.trajectory import MotionState

# [s]; ten to a step of the driver. The servos' time constant is 16 of them.
TIMESTEP = 0.001

# Inertia of a motor's rotor, seen through its gear [kg m^2]. No figure of TEO's is public: a rotor of
# 1e-5 kg m^2, as in flat motors of 50 W, behind the smallest gear of the arms, 100:1, and one of 1e-7 kg m^2
# behind a finger's 968:1 both come to 0.1.
ROTOR_INERTIA = 0.1

# Of a phalanx that its tendon moves with another one [kg m^2]: keeps its bond to that one well conditioned.
_FOLLOWER_INERTIA = 1e-3

# Natural frequency of a servo at HOME [rad/s], 10 Hz, critically damped: a fifth of the rate at which the
# real drives hear of set-points (50 Hz).
SERVO_FREQUENCY = 2.0 * np.pi * 10.0


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

    def __init__(self) -> None:
        """Stand still at HOME."""
        self._model = model = _model()
        self._data = mujoco.MjData(model)
        self._columns = np.array([model.joint(name).qposadr[0] for name in COMMANDED_JOINTS])
        self._actuators = np.array([model.actuator(name).id for name in COMMANDED_JOINTS])
        # A servo is a spring about its set-point and a damper about 0: this much of the velocity that is
        # asked for, added to the set-point, makes it a damper about that velocity.
        self._lead = -model.actuator_biasprm[self._actuators, 2] / model.actuator_gainprm[self._actuators, 0]
        self._told = MotionState.at_rest(np.array([HOME[name] for name in COMMANDED_JOINTS]))
        _stand(model, self._data)
        self._behind = 0.0

    def step(self, asked: MotionState, duration: float) -> MotionState:
        """Move for so long; what is asked for is interpolated, as the real drives do."""
        self._behind += duration
        steps = round(self._behind / TIMESTEP)
        self._behind -= steps * TIMESTEP
        before, self._told = self._told, asked
        for i in range(1, steps + 1):
            part = i / steps
            position = before.positions + part * (asked.positions - before.positions)
            velocity = before.velocities + part * (asked.velocities - before.velocities)
            self._data.ctrl[self._actuators] = position + self._lead * velocity
            mujoco.mj_step(self._model, self._data)
        return MotionState(
            self._data.qpos[self._columns], self._data.qvel[self._columns], self._data.qacc[self._columns]
        )

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


def _model() -> mujoco.MjModel:
    """The URDF with servos, without contact between parts that are built into each other.

    Those are the ones that two joints at most connect, whose boxes reach into each other when they turn, and
    those that overlap at HOME.
    """
    spec = mujoco.MjSpec.from_string(urdf_text())
    spec.option.timestep = TIMESTEP
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST  # damping of servos is stiff
    for joint in spec.joints:
        if joint.name in ALL_JOINTS:
            joint.armature = ROTOR_INERTIA
        else:  # a phalanx's friction is that of the one that it follows
            joint.armature, joint.frictionloss = _FOLLOWER_INERTIA, 0.0
    bare = spec.compile()
    data = mujoco.MjData(bare)
    _stand(bare, data)
    parent = bare.body_parentid
    built = {_bodies(bare, contact) for contact in data.contact[: data.ncon]}
    built |= {(bare.body(parent[parent[i]]).name, bare.body(i).name) for i in range(1, bare.nbody)}
    for first, second in built:
        spec.add_exclude(bodyname1=first, bodyname2=second)
    mass = np.zeros((bare.nv, bare.nv))
    mujoco.mj_fullM(bare, data, mass)
    for name in ALL_JOINTS:
        joint = bare.joint(name)
        inertia = mass[joint.dofadr[0], joint.dofadr[0]]
        stiffness, damping = inertia * SERVO_FREQUENCY**2, 2.0 * inertia * SERVO_FREQUENCY
        effort = bare.jnt_actfrcrange[joint.id]
        servo = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        servo.gainprm[0], servo.biastype = stiffness, mujoco.mjtBias.mjBIAS_AFFINE
        servo.biasprm[:3] = 0.0, -stiffness, -damping
        servo.forcelimited, servo.forcerange = True, effort
    return spec.compile()


def _bodies(model: mujoco.MjModel, contact: mujoco.MjContact) -> tuple[str, str]:
    """The parts that touch, by name."""
    first, second = sorted(model.body(model.geom_bodyid[geom]).name for geom in contact.geom)
    return first, second


def _stand(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Put the robot to HOME, every phalanx where its tendon has it, and tell the servos so."""
    for name, angle in HOME.items():
        data.joint(name).qpos[0] = angle
    for i in range(model.neq):
        follower, driven = model.eq_obj1id[i], model.eq_obj2id[i]
        angle = data.qpos[model.jnt_qposadr[driven]]
        data.qpos[model.jnt_qposadr[follower]] = np.polynomial.polynomial.polyval(angle, model.eq_data[i, :5])
    for i in range(model.nu):
        data.ctrl[i] = data.qpos[model.jnt_qposadr[model.actuator_trnid[i, 0]]]
    mujoco.mj_forward(model, data)
