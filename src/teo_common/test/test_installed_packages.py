# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Commands that one package has and another offers, as they are typed."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path

from ament_index_python.packages import get_package_prefix
from package_folders import FOLDERS

COMMANDS = {
    "teo_sign_capture": ("capture_letters", "capture_scores", "draw_signwriting", "perform_scores"),
    "teo_sign_translator": (
        "build_morphology",
        "compare",
        "evaluate",
        "generate_corpus",
        "reproduce_paper",
        "train",
    ),
    "teo_skeleton_retriever": ("sensor_study", "synthesize"),
}
# As if nothing of the studio were installed.
WITHOUT = """
import importlib.metadata, sys
importlib.metadata.entry_points = lambda **_: ()
from teo_common.installed_packages import main
sys.argv = [sys.argv[1]]
main()
"""


def test_every_command_of_the_studio_is_offered_under_the_name_of_a_package_that_runs() -> None:
    for package, names in COMMANDS.items():
        assert FOLDERS[package].parent.name == "src"
        for name in names:
            assert (Path(get_package_prefix(package)) / "lib" / package / name).is_file()
            (point,) = entry_points(group="teo.commands", name=name)
            assert FOLDERS[point.module.partition(".")[0]].parent.name == "studio"
            module = find_spec(point.module)  # not loaded: some take seconds
            assert module is not None and module.origin is not None
            assert point.attr in Path(module.origin).read_text(encoding="utf-8")


def test_without_the_studio_a_command_says_what_installs_it() -> None:
    command = [sys.executable, "-c", WITHOUT, "/anywhere/train"]
    said = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert said.returncode == 1
    assert said.stderr.startswith("not_installed: train: expected a package of the studio")
    assert "make setup" in said.stderr
