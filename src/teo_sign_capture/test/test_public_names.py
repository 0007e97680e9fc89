# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import subprocess
import sys

import pytest

import teo_sign_capture


def test_every_public_name_is_there_and_belongs_to_the_project() -> None:
    for name in teo_sign_capture.__all__:
        assert getattr(teo_sign_capture, name).__module__.startswith("teo_"), name
    with pytest.raises(AttributeError, match="nothing"):
        _ = teo_sign_capture.nothing


def test_importing_the_package_imports_nothing_heavy() -> None:
    heavy = "numpy", "scipy", "cv2", "pinocchio", "rosbags", "rclpy"
    code = f"import sys, teo_sign_capture; print([m for m in {heavy!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
