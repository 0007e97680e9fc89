# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What signs runs where nothing that draws is installed."""

from __future__ import annotations

import subprocess
import sys

import pytest

# Imports fail as they do where the packages are absent.
BLOCKED = """
import importlib, sys
for name in ("cv2", "PIL", "av", "matplotlib"):
    sys.modules[name] = None
importlib.import_module(sys.argv[1])
"""


def run(code: str, *arguments: str) -> str:
    command = [sys.executable, "-c", code, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize(
    "module",
    [
        "teo_lut_executor.node.executor_node",
        "teo_lut_executor.cli.plan",
        "teo_sim_driver.driver_node",
        "teo_motion",
        "teo_signs.mirroring",
        "teo_signs.likeness",
        "teo_description.robot",
        "teo_description.hand_geometry",
    ],
)
def test_signing_imports_nothing_that_draws(module: str) -> None:
    run(BLOCKED, module)


@pytest.mark.parametrize("name", ["common", "description", "signs", "motion", "lut_executor", "sim_driver"])
def test_importing_a_package_loads_no_ros(name: str) -> None:
    loaded = run(f"import sys, teo_{name}; print(*sys.modules)").split()
    assert {"rclpy", "rcl_interfaces"}.isdisjoint(loaded)
