# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused

from teo_skeleton_retriever.compat.original_retriever import ORIGINAL_OPTIONS, IpoptLimbSolver
from teo_skeleton_retriever.depth.limb_solver import FastLimbSolver, LimbChain

# The original's problem solved to its end.
CONVERGED_OPTIONS = {**ORIGINAL_OPTIONS, "tol": 1e-10, "max_iter": 500, "max_cpu_time": 1.0}
CONVERGED = IpoptLimbSolver(CONVERGED_OPTIONS)


def random_chain(random: np.random.Generator, joints: int) -> LimbChain:
    """A limb before a camera, seen by its skin: nearer than its joints by up to 8 cm."""
    lengths = random.uniform(0.2, 0.32, joints - 1)
    directions = random.normal(size=(joints - 1, 3)) * [1.0, 1.0, 0.5]
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    first = random.uniform([-0.3, -0.3, 1.2], [0.3, 0.3, 2.5])
    points = np.vstack([first, first + np.cumsum(lengths[:, None] * directions, axis=0)])
    nearer = random.uniform(0.0, 0.08, joints)
    nearer[-1] /= 4.0
    points *= 1.0 - nearer[:, None] / points[:, 2:]
    return LimbChain.original(points, lengths, anchor_depth=float(points[0, 2]))


def chains(joints: int, count: int) -> list[LimbChain]:
    random = np.random.default_rng(joints)
    return [random_chain(random, joints) for _ in range(count)]


def missed(chain: LimbChain, depths: np.ndarray) -> float:
    """Norm of the squared lengths less the known ones [m^2]."""
    squares = (np.diff(chain.points(depths), axis=0) ** 2).sum(axis=1)
    return float(np.linalg.norm(squares - chain.lengths**2))


@pytest.mark.parametrize("joints", [3, 4])
def test_the_fast_solve_ends_where_ipopt_ends_or_as_near_to_the_lengths(joints: int) -> None:
    """Ipopt's own variants disagree where several depths are as good: those chains say nothing."""
    exact = IpoptLimbSolver({**CONVERGED_OPTIONS, "hessian_approximation": "exact"})
    fast, same, worse = FastLimbSolver(joints), [], []
    for chain in chains(joints, 80):
        truth, found = CONVERGED.solve(chain).depths, fast.solve(chain).depths
        worse.append(missed(chain, found) - missed(chain, truth))
        if np.abs(truth - exact.solve(chain).depths).max() <= 1e-4:
            same.append(bool(np.abs(found - truth).max() < 1e-3))
    assert len(same) > 60
    assert np.mean(same) >= 0.95
    # 0.5e-3 m^2 is a millimetre of a limb of 0.25 m.
    assert np.mean(np.array(worse) < 0.5e-3) >= 0.95


GOOD = LimbChain.original(np.array([[0.0, 0.0, 2.0], [0.2, 0.0, 2.0]]), np.array([0.2]), anchor_depth=2.0)


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"lengths": np.array([0.2, 0.2])}, "wrong_shape"),
        ({"rays": np.zeros((1, 2))}, "wrong_shape"),
        ({"start": np.array([2.0, math.nan])}, "not_finite"),
        ({"lengths": np.array([0.0])}, "bad_length"),
        ({"upper": GOOD.lower}, "bad_bounds"),
        ({"lower": np.array([-1.0, 1.0])}, "bad_bounds"),
    ],
)
def test_what_makes_no_problem_is_refused(changes: dict[str, np.ndarray], code: str) -> None:
    fields = {name: getattr(GOOD, name) for name in ("rays", "lengths", "start", "lower", "upper")}
    with refused(code):
        LimbChain(**{**fields, **changes})
