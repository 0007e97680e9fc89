# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import os
import subprocess
from pathlib import Path

import pytest
from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode

PACKAGE = Path(__file__).parents[1]
# Of the genuine package, field by field (docs.ros.org/en/jazzy/p/composition_interfaces).
GENUINE = {
    ListNodes.Request: [],
    ListNodes.Response: [("full_node_names", "sequence<string>"), ("unique_ids", "sequence<uint64>")],
    LoadNode.Request: [
        ("package_name", "string"),
        ("plugin_name", "string"),
        ("node_name", "string"),
        ("node_namespace", "string"),
        ("log_level", "uint8"),
        ("remap_rules", "sequence<string>"),
        ("parameters", "sequence<rcl_interfaces/Parameter>"),
        ("extra_arguments", "sequence<rcl_interfaces/Parameter>"),
    ],
    LoadNode.Response: [
        ("success", "boolean"),
        ("error_message", "string"),
        ("full_node_name", "string"),
        ("unique_id", "uint64"),
    ],
    UnloadNode.Request: [("unique_id", "uint64")],
    UnloadNode.Response: [("success", "boolean"), ("error_message", "string")],
}


@pytest.mark.parametrize("cls", GENUINE, ids=lambda cls: cls.__name__)
def test_fields_are_the_genuine_ones_in_their_order(cls):
    assert list(cls.get_fields_and_field_types().items()) == GENUINE[cls]


@pytest.mark.parametrize("genuine", [True, False])
def test_it_builds_nothing_where_the_genuine_package_is(tmp_path, genuine):
    prefix = tmp_path / "jazzy"
    (prefix / "share" / "composition_interfaces").mkdir(parents=True)
    if genuine:
        (prefix / "share" / "composition_interfaces" / "package.xml").touch()
    # Without it, what it builds with is looked for and not found, which ends the trial at once.
    run = subprocess.run(
        ["cmake", "-S", PACKAGE, "-B", tmp_path / "build", "-DCMAKE_INSTALL_PREFIX=/nowhere"],
        env={**os.environ, "AMENT_PREFIX_PATH": str(prefix), "CMAKE_PREFIX_PATH": ""},
        capture_output=True,
        text=True,
    )
    assert ("stepping aside" in run.stdout) == genuine
    assert (run.returncode == 0) == genuine
