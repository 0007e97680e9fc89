# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs and tables made for tests, and a driver's view of a plan."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import get_args

import numpy as np
import pytest
from numpy.typing import NDArray

from teo_description.humanoid import DEFAULT_ROBOT, SIDES, Humanoid, load_humanoid
from teo_motion.sentence.plan import Plan
from teo_names import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND
from teo_signs.sign import Sign
from teo_signs.sign_file import save_sign
from teo_signs.sign_schema import Kind, Provenance

RIGHT = RIGHT_ARM + RIGHT_HAND
LEFT = LEFT_ARM + LEFT_HAND

# Arm raised beside the face, palm out [rad]: about where TEO spells.
SPELLING = np.radians([-73.0, 10.0, 10.0, -75.0, 35.0, 2.0])

MakeSign = Callable[..., Sign]


def make_sign(
    gloss: str,
    knots: NDArray[np.float64] | Sequence[Sequence[float] | NDArray[np.float64]],
    times: Sequence[float] | NDArray[np.float64] = (0.0,),
    *,
    joints: tuple[str, ...] = RIGHT,
    kind: Kind = "lexical",
    robot: str = DEFAULT_ROBOT,
) -> Sign:
    humanoid = load_humanoid(robot)
    provenance = Provenance(
        standing="recorded",
        source="made up",
        method="by hand",
        recorded=None,
        created="2025-01-01",
        licence="Apache-2.0",
        description_hash=humanoid.description_hash,
        notes="",
    )
    sides = {side for side in SIDES if not set(humanoid.arm(side) + humanoid.hand(side)).isdisjoint(joints)}
    return Sign(
        gloss=gloss,
        language="ssp",
        kind=kind,
        handedness="both" if len(sides) != 1 else sides.pop(),
        joints=joints,
        times=np.asarray(times, dtype=float),
        knots=np.asarray(knots, dtype=float),
        provenance=provenance,
        quality=MappingProxyType({}),
        robot=robot,
    )


def letter(gloss: str, *bends: float, turn: float = 0.0) -> Sign:
    """A letter: the spelling arm, its wrist turned, and six angles of the hand [deg]."""
    arm = SPELLING.copy()
    arm[4] += np.radians(turn)
    return make_sign(gloss, [[*arm, *np.radians(bends)]], kind="letter")


def small_table() -> dict[str, Sign]:
    """Five letters of which one moves, two digits, a one-handed and a two-handed sign."""
    signs = [
        letter("A", 20, 10, 80, 80, 80, 80),
        letter("N", 60, 60, 10, 10, 80, 80, turn=30.0),
        letter("L", 10, 8, 8, 80, 80, 80),
        letter("C", 60, 30, 40, 40, 40, 40),
        letter("Ñ", 60, 60, 10, 10, 80, 80, turn=-20.0),
    ]
    still = [*SPELLING, *np.radians([10, 8, 8, 80, 80, 80])]
    aside = [*np.add(SPELLING, [0, 0, 0.15, 0, 0, 0]), *np.radians([10, 8, 8, 80, 80, 80])]
    signs.append(make_sign("LL", [still, aside, still], [0.0, 0.3, 0.6], kind="letter"))
    for digit, fingers in (("1", [60, 60, 8, 80, 80, 80]), ("7", [10, 8, 8, 8, 80, 80])):
        signs.append(make_sign(digit, [[*SPELLING, *np.radians(fingers)]], kind="number"))
    wave = np.tile([*SPELLING, *np.radians([10, 8, 8, 8, 8, 8])], (3, 1))
    wave[1, 4] += 0.3
    signs.append(make_sign("TÚ", wave, [0.0, 0.25, 0.5]))
    both = np.radians([-40, 5, 20, -60, 0, 0])
    mirrored = np.radians([-40, -5, -20, -60, 0, 0])
    bent = np.radians([0, 10, 10, 10, 10, 10])
    start = np.concatenate([both, bent, mirrored, bent])
    end = start.copy()
    end[[3, 15]] += 0.2
    signs.append(make_sign("CASA", [start, end], [0.0, 0.4], joints=LEFT + RIGHT))
    return {sign.gloss: sign for sign in signs}


@pytest.fixture
def table() -> Mapping[str, Sign]:
    return small_table()


@pytest.fixture
def table_directory(tmp_path: Path) -> Path:
    """The small table as a directory of entries."""
    directory = tmp_path / "lut"
    for sign in small_table().values():
        save_sign(directory, sign)
    return directory


@pytest.fixture(name="make_sign")
def make_sign_fixture() -> MakeSign:
    return make_sign


def _limb_sets(humanoid: Humanoid) -> tuple[tuple[str, ...], ...]:
    left, right = (humanoid.arm(side) + humanoid.hand(side) for side in SIDES)
    nodding = humanoid.head + humanoid.arm("right")
    return right, left, left + right, humanoid.hand("right"), nodding, humanoid.commanded_joints


def random_table(rng: np.random.Generator, signs: int = 4, *, robot: str = DEFAULT_ROBOT) -> dict[str, Sign]:
    """Signs that no person makes: anywhere within the limits, or shaking; knots 1 ms to 1 s apart."""
    humanoid, table = load_humanoid(robot), {}
    limb_sets = _limb_sets(humanoid)
    for number in range(signs):
        joints = limb_sets[rng.integers(len(limb_sets))]
        limits = humanoid.limits(joints)
        shape = (int(rng.integers(1, 7)), len(joints))
        gaps = rng.choice([0.001, 0.02, 0.1, 0.3, 1.0], shape[0] - 1) * rng.uniform(0.5, 1.0, shape[0] - 1)
        match rng.integers(4):
            case 3:  # as captured from video: knots at every frame, joints that swing
                shape = (int(rng.integers(8, 20)), len(joints))
                gaps = np.full(shape[0] - 1, 0.04)
                phase = rng.uniform(0.0, 2.0 * np.pi, shape[1])
                phase = phase + np.arange(shape[0])[:, None] * rng.uniform(0.2, 2.0)
                swing = rng.uniform(0.0, 0.3, shape[1]) * np.sin(phase)
                middle = rng.uniform(limits.lower, limits.upper)
                knots = np.clip(middle + swing, limits.lower, limits.upper)
            case 0:
                knots = rng.uniform(limits.lower, limits.upper, shape)
            case 1:
                steps = np.cumsum(rng.normal(0.0, 0.1, shape), axis=0)
                knots = np.clip(rng.uniform(limits.lower, limits.upper) + steps, limits.lower, limits.upper)
            case _:
                knots = np.where(rng.random(shape) < 0.5, limits.lower, limits.upper)
        times = np.concatenate([[0.0], np.cumsum(gaps)])
        kind: Kind = get_args(Kind)[rng.integers(3)]
        gloss = f"SIGN{number}"
        table[gloss] = make_sign(gloss, knots, times, joints=joints, kind=kind, robot=robot)
    return table


@pytest.fixture(name="random_table")
def random_table_fixture() -> Callable[..., dict[str, Sign]]:
    return random_table


class DriverView:
    """What a driver makes of a plan's points: a quintic between each two, looked at densely."""

    def __init__(self, plan: Plan, looks: int = 10) -> None:
        h = np.diff(plan.times)[:, None]
        p0, p1 = plan.positions[:-1], plan.positions[1:]
        v0, v1 = plan.velocities[:-1] * h, plan.velocities[1:] * h
        a0, a1 = plan.accelerations[:-1] * h**2, plan.accelerations[1:] * h**2
        d = p1 - p0
        c = [p0, v0, a0 / 2]
        c.append(10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1)
        c.append(-15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1)
        c.append(6 * d - 3 * v0 - 3 * v1 - 0.5 * a0 + 0.5 * a1)
        s = np.linspace(0.0, 1.0, looks + 1)[:, None, None]
        coefficients = [np.asarray(item)[None] for item in c]
        self.positions = sum(item * s**k for k, item in enumerate(coefficients))
        self.velocities = sum(k * item * s ** (k - 1) for k, item in enumerate(coefficients) if k) / h
        self.accelerations = (
            sum(k * (k - 1) * item * s ** (k - 2) for k, item in enumerate(coefficients) if k > 1) / h**2
        )
        self.jerks = sum(k * (k - 1) * (k - 2) * coefficients[k] * s ** (k - 3) for k in (3, 4, 5)) / h**3


@pytest.fixture
def driver_view() -> type[DriverView]:
    return DriverView
