# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What signs needs nothing of what sees, draws, trains or stands in for ROS: it is imported without.

`test_graph.py` signs without it.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from absence import python_without

SOURCES = Path(__file__).parents[1] / "src"
# The packages that sign, and what of them does something else.
RUN_TIME = {
    "teo_bringup": (),
    "teo_common": ("teo_common.mcap_salvage",),  # reads bags
    "teo_description": ("teo_description.pictures",),  # draws: the demo and captures
    "teo_lut_executor": (
        "teo_lut_executor.cli.plan_film",  # draws a plan
    ),
    "teo_motion": (),
    "teo_sign_languages": (),
    "teo_sign_translator": (),
    "teo_signs": ("teo_signs.pictures",),  # draws
    "teo_sim_driver": ("teo_sim_driver.plants.physics",),  # only where physics is asked for
}

# Imports every module named and reports those that could not be.
_IMPORT_CODE = """
import importlib
offenders = {}
for module in json.loads(sys.argv[1]):
    try:
        importlib.import_module(module)
    except ImportError as error:
        offenders[module] = str(error)
print(json.dumps(offenders))
"""


def modules_that_sign() -> list[str]:
    """Every module of the run-time parts, from the source tree."""
    modules = []
    for package, others in RUN_TIME.items():
        for path in sorted((SOURCES / package / package).rglob("*.py")):
            parts = path.relative_to(SOURCES / package).with_suffix("").parts
            module = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            if not any(f"{module}.".startswith(f"{other}.") for other in others):
                modules.append(module)
    return modules


def test_every_module_that_signs_is_imported_without_what_a_robot_lacks() -> None:
    modules = modules_that_sign()
    assert len(modules) > 70
    command = python_without(_IMPORT_CODE, json.dumps(["cv2", *modules]))
    result = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    offenders = json.loads(result.stdout)
    assert offenders.pop("cv2") == "cv2 is absent here"
    assert not offenders, "\n".join(f"{module}: {error}" for module, error in offenders.items())


def test_importing_the_packages_loads_no_ros() -> None:
    command = [sys.executable, "-c", f"import sys, {', '.join(RUN_TIME)}; print(*sys.modules)"]
    loaded = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout.split()
    assert {"rclpy", "rcl_interfaces"}.isdisjoint(loaded)
