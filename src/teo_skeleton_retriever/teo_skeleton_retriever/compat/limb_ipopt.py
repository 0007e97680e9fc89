# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The limb optimisation of the original: Ipopt, with its options."""

from __future__ import annotations

import importlib
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from teo_skeleton_retriever.depth.limb_solver import LimbChain, LimbSolution

# Fixed in the original's code. With the tolerance on an objective in m^4 it stops some millimetres before the
# minimum.
_ORIGINAL_OPTIONS: dict[str, object] = {
    "tol": 1e-4,
    "acceptable_iter": 0,
    "mu_strategy": "adaptive",
    "hessian_approximation": "limited-memory",
    "max_iter": 100,
    "max_cpu_time": 0.05,  # [s]
}
# The same problem solved to its end: what the fast solve is measured against.
CONVERGED_OPTIONS: dict[str, object] = _ORIGINAL_OPTIONS | {
    "tol": 1e-10,
    "max_iter": 500,
    "max_cpu_time": 1.0,
}
_ACCEPTED = ("Solve_Succeeded", "Solved_To_Acceptable_Level", "Feasible_Point_Found")


class IpoptLimbSolver:
    """Moves the depths of a limb so that its lengths hold. One solver serves limbs of any length."""

    def __init__(self, options: dict[str, object] | None = None) -> None:
        """Build a solver.

        Args:
            options: Of Ipopt; the original's if None.
        """
        self._options = tuple((options or _ORIGINAL_OPTIONS).items())

    def solve(self, chain: LimbChain) -> LimbSolution:
        """Solve one limb. Takes about 2 ms."""
        nlp = _problem(len(chain.rays), self._options)
        found = nlp(
            x0=chain.start,
            p=np.concatenate([chain.rays.ravel(), chain.lengths**2]),
            lbx=chain.lower,
            ubx=chain.upper,
        )
        depths = np.array(found["x"], dtype=np.float64).ravel()
        return LimbSolution(depths, nlp.stats()["return_status"] in _ACCEPTED)


@cache
def _problem(joints: int, options: tuple[tuple[str, object], ...]) -> Any:
    """Build the problem of so many keypoints; its parameters are the rays, then the squared lengths."""
    # Here, for its half a second: who does not solve limbs does not wait for it.
    casadi: Any = importlib.import_module("casadi")
    depths = casadi.SX.sym("depths", joints)
    parameters = casadi.SX.sym("parameters", 3 * joints - 1)
    points = [
        depths[i] * casadi.vertcat(parameters[2 * i], parameters[2 * i + 1], 1.0) for i in range(joints)
    ]
    steps = [a - b for a, b in pairwise(points)]
    missed = [casadi.dot(step, step) - parameters[2 * joints + i] for i, step in enumerate(steps)]
    cost = sum(value**2 for value in missed)
    ipopt = {"print_level": 0, "sb": "yes", **dict(options)}
    quiet = {"print_time": False, "calc_f": False, "calc_g": False, "calc_lam_x": False, "calc_lam_p": False}
    return casadi.nlpsol(
        "limb", "ipopt", {"x": depths, "p": parameters, "f": cost}, {**quiet, "ipopt": ipopt}
    )
