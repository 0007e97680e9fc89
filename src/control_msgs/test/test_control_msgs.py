# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import json
import os
import subprocess
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_share_directory

# Of the genuine package, as its own build wrote it into follow_joint_trajectory__struct.h. It covers names,
# types and order of all fields, also of the messages within: both tolerances are in this one.
GENUINE = "RIHS01_738ebcb7a2d7cfa42f9f1001cc99ce3a4383d1cfe508015d9be8485e4b1c66f6"


PACKAGE = Path(__file__).parents[1]


def test_the_action_is_the_genuine_one_to_the_last_field():
    share = Path(get_package_share_directory("control_msgs"))
    description = json.loads((share / "action" / "FollowJointTrajectory.json").read_text())
    hashes = {row["type_name"]: row["hash_string"] for row in description["type_hashes"]}
    assert hashes["control_msgs/action/FollowJointTrajectory"] == GENUINE


@pytest.mark.parametrize("genuine", [True, False])
def test_it_builds_nothing_where_the_genuine_package_is(tmp_path, genuine):
    prefix = tmp_path / "jazzy"
    (prefix / "share" / "control_msgs").mkdir(parents=True)
    if genuine:
        (prefix / "share" / "control_msgs" / "package.xml").touch()
    # Without it, what it builds with is looked for and not found, which ends the trial at once.
    run = subprocess.run(
        [
            "cmake",
            "-S",
            Path(__file__).parents[1],
            "-B",
            tmp_path / "build",
            "-DCMAKE_INSTALL_PREFIX=/nowhere",
        ],
        env={**os.environ, "AMENT_PREFIX_PATH": str(prefix), "CMAKE_PREFIX_PATH": ""},
        capture_output=True,
        text=True,
    )
    assert ("stepping aside" in run.stdout) == genuine
    assert (run.returncode == 0) == genuine
