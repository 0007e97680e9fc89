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

from teo_bringup.graph import NODES, SIGNING

DEPLOY = Path(__file__).parents[1] / "deploy"
UNITS = sorted(DEPLOY.glob("*.service"))


def nodes_of_unit(unit: Path) -> list[str]:
    found = re.search(r"teo_bringup up (.*?) --log-folder", unit.read_text())
    assert found is not None
    return found[1].split()


def nodes_of_service(name: str) -> list[str]:
    services = yaml.safe_load((DEPLOY / "compose.yaml").read_text())["services"]
    return list(services[name]["command"])


def test_units_and_containers_share_the_nodes_out_alike() -> None:
    machines = {unit.stem.removeprefix("teo-"): nodes_of_unit(unit) for unit in UNITS}
    assert machines == {name: nodes_of_service(name) for name in ("robot", "workstation")}
    started = [name for nodes in machines.values() for name in nodes]
    assert sorted(name for name in started if name in SIGNING) == sorted(SIGNING)
    assert set(started) <= set(NODES)


def test_what_an_image_copies_is_there_and_not_left_out_of_its_context() -> None:
    dockerfile = (DEPLOY / "Dockerfile").read_text()
    copied = [words.split()[0] for words in re.findall(r"^COPY (.*)$", dockerfile, re.M)]
    ignored = (DEPLOY.parent / ".dockerignore").read_text().splitlines()
    sent = {line.removeprefix("!") for line in ignored if line.startswith("!")}
    assert sorted(copied) == sorted(sent)
    assert [name for name in copied if not (DEPLOY.parent / name).exists()] == []


def test_each_service_is_built_from_the_file_and_level_that_it_names() -> None:
    services = yaml.safe_load((DEPLOY / "compose.yaml").read_text())["services"]
    levels = re.findall(r"^    (\w+)(?: \||\)) ", (DEPLOY.parent / "scripts" / "setup.sh").read_text(), re.M)
    for service in services.values():
        build = service["build"]
        assert (DEPLOY / build["context"] / build["dockerfile"]).is_file()
        assert build.get("args", {}).get("LEVEL", "run") in levels
        volume, place = service["volumes"][0].split(":")
        assert volume in yaml.safe_load((DEPLOY / "compose.yaml").read_text())["volumes"]
        assert place == "/home/teo"  # as `useradd --create-home teo` in the image


@pytest.mark.skipif(shutil.which("docker-compose") is None, reason="docker-compose is not installed")
def test_compose_takes_the_file() -> None:
    words = ("--profile", "robot", "--profile", "workstation", "config", "--services")
    checked = subprocess.run(
        ["docker-compose", "--file", DEPLOY / "compose.yaml", *words],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (checked.returncode, sorted(checked.stdout.split())) == (0, ["robot", "workstation"]), (
        checked.stderr
    )


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
