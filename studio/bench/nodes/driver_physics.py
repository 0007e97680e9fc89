# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What servos, gravity and contact make of 50 sentences, with the ideal joints beside it."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from rich.progress import track

from executed_motion import following
from nodes.driver_executed import one_hand, random_tokens
from report import Figure
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_names import BODY_JOINTS, COMMANDED_JOINTS
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_sim_driver.parameters import DEFAULT_FOLLOWING_ERROR
from teo_sim_driver.plants.physics import PhysicsPlant
from teo_sim_driver.plants.plant import IdealPlant

SENTENCES = 50
PERIOD = 0.01  # [s]
_SECOND = 1_000_000_000
_STILL = 1e-3  # [rad/s]; all joints of the body are asked to hold
_SETTLED = 10  # steps of that after which they do
_BODY = len(BODY_JOINTS)
_FAULT = DEFAULT_FOLLOWING_ERROR
_GRIPS = 1.0  # [N]; lighter touches are not counted


class Followed(NamedTuple):
    """What the joints made of one sentence."""

    errors: NDArray[np.float64]
    """Of position at every step [rad]. Shape (steps, joints)."""
    sag: NDArray[np.float64]
    """The most of body and arms while they are to hold still [rad]. Shape (joints of the body,)."""
    torque: NDArray[np.float64]
    """The most of each servo [N m]. Shape (joints,)."""
    touched: dict[tuple[str, str], float]
    """Parts that touched, and the greatest force between them [N]."""
    plant_seconds: float
    """Time that the plant took for it [s]."""
    duration: float
    """[s]"""


def measure(sentences: int = SENTENCES) -> list[Figure]:
    """Execute the sentences with both plants."""
    table = Lut.open(default_lut_directory())
    planner = Planner(table, robot=Robot.load())
    physics = []
    ideal = 0.0
    for number in track(range(sentences), "sentences"):
        plan = planner.plan(random_tokens(np.random.default_rng([50, number]), table))
        ideal = max(ideal, float(np.abs(_followed(plan, IdealPlant()).errors).max()))
        physics.append(_followed(plan, PhysicsPlant(load_humanoid())))
    return list(_figures(physics, ideal))


def _followed(plan: Plan, plant: IdealPlant | PhysicsPlant) -> Followed:
    follower = following(plan, PERIOD)
    errors = []
    sag, still = np.zeros(_BODY), 0
    torque = np.zeros(len(COMMANDED_JOINTS))
    touched: dict[tuple[str, str], float] = {}
    seconds = 0.0
    for step in range(1, round(plan.duration / PERIOD) + 1):
        asked = follower.step(round(step * PERIOD * _SECOND))
        begin = time.thread_time()
        measured = plant.step(asked, PERIOD)
        seconds += time.thread_time() - begin
        positions = plant.positions if isinstance(plant, PhysicsPlant) else measured.positions
        errors.append(positions - asked.positions)
        still = still + 1 if (np.abs(asked.velocities[:_BODY]) < _STILL).all() else 0
        if still > _SETTLED:
            sag = np.maximum(sag, np.abs(errors[-1][:_BODY]))
        if isinstance(plant, PhysicsPlant):
            torque = np.maximum(torque, np.abs(plant.torques))
            for contact in plant.contacts():
                pair = (contact.first, contact.second)
                touched[pair] = max(touched.get(pair, 0.0), contact.force)
    return Followed(np.array(errors), sag, torque, touched, seconds, plan.duration)


def _figures(followed: list[Followed], ideal: float) -> Iterator[Figure]:
    errors = np.abs(np.concatenate([each.errors for each in followed]))
    sag = np.max([each.sag for each in followed], axis=0)
    torque = np.max([each.torque for each in followed], axis=0)
    duration = sum(each.duration for each in followed)
    yield Figure(f"{len(followed)} sentences, {duration:.0f} s; ideal joints' error", f"{ideal:.0e} rad")
    for what, joints in (("body and arms", slice(0, _BODY)), ("hands", slice(_BODY, None))):
        worst = COMMANDED_JOINTS[joints][int(np.argmax(errors[:, joints].max(axis=0)))]
        p50, p99 = np.percentile(errors[:, joints].max(axis=1), [50, 99]) * 1e3
        yield Figure(
            f"tracking error of the worst joint of {what}, by MuJoCo",
            f"median {p50:.2f}, p99 {p99:.2f}, most {errors[:, joints].max() * 1e3:.2f} mrad ({worst})",
        )
        j = int(np.argmax(torque[joints]))
        yield Figure(f"torque of {what}", f"most {torque[joints][j]:.1f} N m ({COMMANDED_JOINTS[joints][j]})")
    j = int(np.argmax(sag))
    yield Figure(
        "sag of body and arms while they are to hold still",
        f"most {sag[j] * 1e3:.2f} mrad ({COMMANDED_JOINTS[j]})",
    )
    beyond = sum(bool((np.abs(each.errors[:, :_BODY]) > _FAULT).any()) for each in followed)
    yield Figure(f"sentences that the driver ends in a fault, {_FAULT:g} rad", str(beyond))
    stuck = [each for each in followed if (np.abs(each.errors[:, _BODY:]) > _FAULT).any()]
    yield Figure(f"sentences in which a finger is kept back by over {_FAULT:g} rad", str(len(stuck)))
    forces: Counter[tuple[str, str]] = Counter()
    strongest: dict[tuple[str, str], float] = {}
    for each in followed:
        for pair, force in each.touched.items():
            if force > _GRIPS:
                forces[pair] += 1
                strongest[pair] = max(strongest.get(pair, 0.0), force)
    within = {pair for pair in forces if one_hand(*pair)}
    yield Figure(
        f"sentences in which parts of one hand press on each other with over {_GRIPS:g} N",
        _pressed(within, followed, strongest),
    )
    yield Figure(
        f"sentences in which other parts press on each other with over {_GRIPS:g} N",
        _pressed(set(forces) - within, followed, strongest),
    )
    seconds = sum(each.plant_seconds for each in followed)
    yield Figure("MuJoCo: simulated time for one second of one core", f"{duration / seconds:.1f} s")


def _pressed(
    pairs: set[tuple[str, str]], followed: list[Followed], strongest: dict[tuple[str, str], float]
) -> str:
    count = sum(any(each.touched.get(pair, 0.0) > _GRIPS for pair in pairs) for each in followed)
    if not pairs:
        return "0"
    pair = max(pairs, key=lambda each: strongest[each])
    return f"{count} of {len(followed)}; most {strongest[pair]:.0f} N, {pair[0]} on {pair[1]}"


if __name__ == "__main__":
    for figure in measure(int(sys.argv[1]) if len(sys.argv) > 1 else SENTENCES):
        print(f"{figure.what}: {figure.value}")
