# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The examples of deploy/: two machines that together run what signs, each node once."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
import yaml

from teo_bringup.graph import SIGNING
from teo_bringup.up import parse

DEPLOY = Path(__file__).parents[1] / "deploy"
UNITS = sorted(DEPLOY.glob("*.service"))


def nodes_of_unit(unit: Path) -> list[str]:
    found = re.search(r"teo_bringup up (.*?) --log-folder", unit.read_text())
    assert found is not None
    return parse(found[1].split()).nodes


def nodes_of_service(name: str) -> list[str]:
    services = yaml.safe_load((DEPLOY / "compose.yaml").read_text())["services"]
    return parse(services[name]["command"]).nodes


def test_units_and_containers_share_the_nodes_out_alike() -> None:
    machines = {unit.stem.removeprefix("teo-"): nodes_of_unit(unit) for unit in UNITS}
    assert machines == {name: nodes_of_service(name) for name in ("robot", "workstation")}
    signing = [name for nodes in machines.values() for name in nodes if name in SIGNING]
    assert sorted(signing) == sorted(SIGNING)


@pytest.mark.skipif(shutil.which("systemd-analyze") is None, reason="systemd-analyze is not installed")
def test_the_units_are_valid() -> None:
    # Not those that they name: a container has not got network-online.target.
    checked = subprocess.run(
        ["systemd-analyze", "verify", "--recursive-errors=no", *map(str, UNITS)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert checked.returncode == 0, checked.stderr
    assert not [line for line in checked.stderr.splitlines() if "deploy/" in line]
