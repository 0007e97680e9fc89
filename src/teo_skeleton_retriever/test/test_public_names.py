# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import subprocess
import sys

import teo_skeleton_retriever

HEAVY = ("cv2", "mediapipe", "rclpy", "rosbags", "scipy")


def test_every_public_name_is_there() -> None:
    for name in teo_skeleton_retriever.__all__:
        assert getattr(teo_skeleton_retriever, name) is not None


def test_importing_the_package_loads_no_library() -> None:
    look = f"import sys, teo_skeleton_retriever; sys.exit(' '.join(set({HEAVY}) & set(sys.modules)) or 0)"
    subprocess.run([sys.executable, "-c", look], check=True)


def test_the_synthetic_signers_commands_run_where_it_is_installed() -> None:
    command = ["ros2", "run", "teo_skeleton_retriever", "synthesize", "--list"]
    said = subprocess.run(command, check=True, capture_output=True, text=True, timeout=60)
    assert "woman_small" in said.stdout
