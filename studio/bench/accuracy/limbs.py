# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Time to fit one limb's depths to its lengths: Ipopt as skeletonRetriever sets it, and our bounded solve."""

from __future__ import annotations

import time

import numpy as np

from report import Figure, percentiles
from teo_skeleton_retriever.compat.original_retriever import IpoptLimbSolver
from teo_skeleton_retriever.depth.limb_solver import FastLimbSolver, LimbChain

LIMBS = 200


def measure() -> list[Figure]:
    """Times of this thread alone: other programs share the machine."""
    figures = []
    for name, joints in (("arm", 3), ("leg", 4)):
        limbs = [_limb(np.random.default_rng(seed), joints) for seed in range(LIMBS)]
        for solver_name, solver in (("Ipopt", IpoptLimbSolver()), ("fast", FastLimbSolver())):
            solver.solve(limbs[0])
            times = []
            for limb in limbs:
                started = time.thread_time()
                solver.solve(limb)
                times.append(time.thread_time() - started)
            figures.append(percentiles(f"{name}, {solver_name}", times))
    return figures


def _limb(random: np.random.Generator, joints: int) -> LimbChain:
    """A limb before a camera, its middle seen up to 8 cm too near."""
    lengths = random.uniform(0.2, 0.32, joints - 1)
    directions = random.normal(size=(joints - 1, 3)) * [1.0, 1.0, 0.5]
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    first = random.uniform([-0.3, -0.3, 1.2], [0.3, 0.3, 2.5])
    points = np.vstack([first, first + np.cumsum(lengths[:, None] * directions, axis=0)])
    nearer = random.uniform(0.0, 0.08, joints)
    points *= 1.0 - nearer[:, None] / points[:, 2:]
    return LimbChain.original(points, lengths, anchor_depth=float(points[0, 2]))
