# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What servos, gravity and contact make of random sentences; ideal joints are where they are asked to be."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from rich.progress import track

from executed_motion import following, one_hand
from report import Figure
from signs.random_signs import random_tokens
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_names import BODY_JOINTS, COMMANDED_JOINTS
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_sim_driver import MotionState
from teo_sim_driver.parameters import DEFAULT_FOLLOWING_ERROR
from teo_sim_driver.plants.physics import PhysicsPlant

PERIOD = 0.01  # [s]
_SECOND = 1_000_000_000
_SCALES = (0.7, 1.0, 1.0, 1.0, 1.5)
_GRIPS = 1.0  # [N]; lighter touches are not counted


class _Followed(NamedTuple):
    """What the joints made of one sentence."""

    errors: NDArray[np.float64]
    """Of position at every step [rad]. Shape (steps, joints)."""
    pressed: set[tuple[str, str]]
    """Parts that pressed on each other."""


def measure(sentences: int = 50) -> list[Figure]:
    """Execute so many sentences with masses (MuJoCo)."""
    table = Lut.open(default_lut_directory())
    planner = Planner(table, robot=Robot.load())
    followed = []
    for number in track(range(sentences), "sentences"):
        tokens = random_tokens(np.random.default_rng([50, number]), table, most=6, scales=_SCALES)
        followed.append(_followed(planner.plan(tokens)))
    return list(_figures(followed))


def _followed(plan: Plan) -> _Followed:
    follower, plant = following(plan, PERIOD), PhysicsPlant(load_humanoid())
    start = MotionState.at_rest(plan.positions[0])
    for duration in (3.0, 1.0):  # [s] from home, gently, and until nothing moves
        plant.step(start, duration)
    errors, pressed = [], set()
    for step in range(1, round(plan.duration / PERIOD) + 1):
        asked = follower.step(round(step * PERIOD * _SECOND))
        plant.step(asked, PERIOD)
        errors.append(np.abs(plant.positions - asked.positions))
        pressed |= {(each.first, each.second) for each in plant.contacts() if each.force > _GRIPS}
    return _Followed(np.array(errors), pressed)


def _figures(followed: list[_Followed]) -> Iterator[Figure]:
    errors = np.concatenate([each.errors for each in followed])
    body = len(BODY_JOINTS)
    for what, joints in (("body and arms", slice(0, body)), ("hands", slice(body, None))):
        worst = COMMANDED_JOINTS[joints][int(np.argmax(errors[:, joints].max(axis=0)))]
        p50, p99 = np.percentile(errors[:, joints].max(axis=1), [50, 99]) * 1e3
        yield Figure(
            f"tracking error of the worst joint of {what}",
            f"median {p50:.2f}, p99 {p99:.2f}, most {errors[:, joints].max() * 1e3:.2f} mrad ({worst})",
        )
    limit = DEFAULT_FOLLOWING_ERROR
    behind = sum(bool((each.errors[:, body:] > limit).any()) for each in followed)
    yield Figure(f"sentences with a hand axis over {limit:g} rad behind", str(behind))
    for what, same in (("of one hand", True), ("of other parts", False)):
        count = sum(any(one_hand(*pair) == same for pair in each.pressed) for each in followed)
        yield Figure(
            f"sentences in which parts {what} press on each other with over {_GRIPS:g} N", str(count)
        )
