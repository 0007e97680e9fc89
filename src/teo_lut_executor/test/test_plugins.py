# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import subprocess
import sys

# Runs `lut` as on a robot's computer: whatever starts with one of the names cannot be imported, and its
# entry points are not installed.
WITHOUT = """
import importlib.abc, importlib.metadata, sys

class Absent(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {missing!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Absent())
found = importlib.metadata.entry_points
importlib.metadata.entry_points = lambda **group: [
    point for point in found(**group) if point.module.partition(".")[0] not in {uninstalled!r}
]
sys.argv = ["lut", *{arguments!r}]
from teo_lut_executor.cli.lut import main
main()
"""


def lut(
    *arguments: str, missing: tuple[str, ...] = (), uninstalled: tuple[str, ...] = ()
) -> subprocess.CompletedProcess[str]:
    program = WITHOUT.format(missing=missing, uninstalled=uninstalled, arguments=arguments)
    return subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False
    )


def test_lut_without_the_capture_package_lists_its_commands_and_says_what_to_install():
    without = {"missing": ("teo_sign_capture",), "uninstalled": ("teo_sign_capture",)}
    overview = lut("--help", **without)
    assert overview.returncode == 0
    for command in ("capture", "import", "record"):
        assert command in overview.stdout
    refused = lut("capture", "bag", "--gloss", "X", **without)
    assert refused.returncode == 1
    assert refused.stderr.startswith("not_installed: lut capture: expected the package teo_sign_capture")
    assert "requirements/capture.txt" in refused.stderr


def test_lut_with_a_capture_package_whose_libraries_are_missing_says_which():
    refused = lut("import", "clip.pose", "--gloss", "X", missing=("teo_sign_capture",))
    assert refused.returncode == 1
    assert "not_installed: lut import: expected what teo_sign_capture needs" in refused.stderr
    assert "No module named 'teo_sign_capture" in refused.stderr
