# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Processes in which the packages that a robot's computer does without cannot be imported."""

from __future__ import annotations

import json
import sys

from teo_bringup.graph import NODES

# What a robot's computer does without.
ABSENT = (
    "anny", "av", "casadi", "cv2", "embreex", "matplotlib", "mcap", "mediapipe", "mujoco", "PIL",
    "pose_format", "rosbags", "spoken_to_signed", "torch",
    "teo_ros2cli", "teo_sign_authoring", "teo_sign_capture", "teo_sign_training", "teo_skeleton_retriever",
    "teo_synthetic_signer",
)  # fmt: skip

_ABSENT_CODE = """
import importlib.abc, json, sys

class Absence(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in absent:
            raise ModuleNotFoundError(f"{name} is absent here", name=name)

absent = set(json.loads(sys.argv.pop(1)))
sys.meta_path.insert(0, Absence())
"""


def python_without(code: str, *arguments: str) -> tuple[str, ...]:
    """The command that runs code in such a process."""
    return sys.executable, "-c", f"{_ABSENT_CODE}\n{code}", json.dumps(ABSENT), *arguments


def node_without(name: str) -> tuple[str, ...]:
    """The command that runs a node of `NODES` in such a process, by what its installed executable calls."""
    package, executable = NODES[name]
    points = f"importlib.metadata.distribution('{package}').entry_points.select(name='{executable}')"
    return python_without(f"import importlib.metadata\nnext(iter({points})).load()([])")
