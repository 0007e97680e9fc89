# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What signs needs nothing of what sees, draws, trains or stands in for ROS: shown by doing without it."""

from __future__ import annotations

import json
import math
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectory

from teo_bringup.graph import NODES, SIGNING, Graph

SOURCES = Path(__file__).parents[1] / "src"
START_TIMEOUT = 60.0  # [s] for three processes to listen, on a loaded machine
SIGNING_TIMEOUT = 60.0  # [s] from a text to its trajectory
RESEND = 5.0  # [s] after which a text that was not signed is sent again

# What a robot's computer does without.
ABSENT = (
    "anny", "av", "casadi", "cv2", "embreex", "matplotlib", "mcap", "mediapipe", "mujoco", "PIL",
    "pose_format", "rosbags", "spoken_to_signed", "torch",
    "teo_ros2cli", "teo_sign_authoring", "teo_sign_capture", "teo_sign_training", "teo_skeleton_retriever",
    "teo_synthetic_signer",
)  # fmt: skip
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
    "teo_signs": ("teo_signs.pictures",),  # draws: captures
    "teo_sim_driver": ("teo_sim_driver.plants.physics",),  # only where physics is asked for
}

# Makes the packages absent, then imports every module named and reports those that could not be.
_ABSENT_CODE = """
import importlib.abc, json, sys

class Absence(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in absent:
            raise ModuleNotFoundError(f"{name} is absent here", name=name)

absent = set(json.loads(sys.argv.pop(1)))
sys.meta_path.insert(0, Absence())
"""
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
    assert len(modules) > 100
    command = [sys.executable, "-c", _ABSENT_CODE + _IMPORT_CODE, json.dumps(ABSENT), json.dumps(modules)]
    result = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    offenders = json.loads(result.stdout)
    assert not offenders, "\n".join(f"{module}: {error}" for module, error in offenders.items())


@pytest.mark.parametrize("package", RUN_TIME)
def test_importing_a_package_loads_no_ros(package: str) -> None:
    command = [sys.executable, "-c", f"import sys, {package}; print(*sys.modules)"]
    loaded = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout.split()
    assert {"rclpy", "rcl_interfaces"}.isdisjoint(loaded)


def test_what_the_rooms_beside_signing_are_called_still_stands() -> None:
    for package, others in RUN_TIME.items():
        for other in others:
            path = SOURCES / package / Path(*other.split("."))
            assert path.is_dir() or path.with_suffix(".py").is_file(), (
                f"{other} is gone: take it off the list"
            )


def test_the_absent_packages_are_really_absent_in_that_process() -> None:
    command = [sys.executable, "-c", _ABSENT_CODE + "import cv2", json.dumps(ABSENT)]
    result = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert result.returncode != 0
    assert "cv2 is absent here" in result.stderr


@pytest.fixture
def listener(domain_id: int) -> Iterator[tuple[Node, SingleThreadedExecutor, list[JointTrajectory]]]:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    node = Node("listener", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    heard: list[JointTrajectory] = []
    node.create_subscription(JointTrajectory, "joint_trajectory", heard.append, 10)
    yield node, executor, heard
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_the_nodes_sign_a_text_without_what_a_robot_lacks(
    listener: tuple[Node, SingleThreadedExecutor, list[JointTrajectory]], tmp_path: Path
) -> None:
    node, executor, heard = listener
    texts = node.create_publisher(String, "text", 10)
    with Graph(tmp_path) as graph:
        for name in SIGNING:
            package, executable = NODES[name]
            # What the installed executable does, after the packages are made absent.
            entry = f"load_entry_point = importlib.metadata.distribution('{package}').entry_points"
            run = f"next(iter(load_entry_point.select(name='{executable}'))).load()([])"
            code = f"{_ABSENT_CODE}\nimport importlib.metadata\n{entry}\n{run}"
            graph.start(name, sys.executable, "-c", code, json.dumps(ABSENT))

        def wait(expected: str, timeout: float) -> Iterator[None]:
            deadline = time.monotonic() + timeout
            while True:
                graph.check()
                assert time.monotonic() < deadline, f"no {expected} within {timeout} s"
                executor.spin_once(timeout_sec=0.1)
                yield

        waiting = wait("nodes that listen", START_TIMEOUT)
        while not (
            texts.get_subscription_count()
            and node.count_subscribers("sign_tokens")
            and node.count_subscribers("joint_trajectory") == 2
            and node.count_publishers("joint_states")
            and graph.is_ready()
        ):
            next(waiting)
        waiting = wait("trajectory", SIGNING_TIMEOUT)
        said = -math.inf
        while not heard:
            # Again and again: that the translator and the executor have found each other cannot be seen
            # from here, and what is said before is lost.
            if time.monotonic() - said > RESEND:
                texts.publish(String(data="Hola, me llamo Al."))
                said = time.monotonic()
            next(waiting)
    assert heard[0].points
