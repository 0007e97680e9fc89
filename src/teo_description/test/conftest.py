# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
import yaml

from teo_description.humanoid import Humanoid, robot_folders
from teo_description.robot import Robot
from teo_names import ALL_JOINTS, joint_limits


@pytest.fixture(scope="session")
def robot() -> Robot:
    return Robot.load()


@pytest.fixture
def random_positions() -> Callable[[], Mapping[str, float]]:
    """Positions of all 40 joints, uniform within their limits; the same sequence on every run."""
    limits = joint_limits(ALL_JOINTS)
    generator = np.random.default_rng(20)

    def positions() -> Mapping[str, float]:
        values = generator.uniform(limits.lower, limits.upper)
        return {name: float(value) for name, value in zip(ALL_JOINTS, values, strict=True)}

    return positions


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A robot of one's own, ``mine``, which is the second robot."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    mine = tmp_path / "teo" / "robots" / "mine"
    shutil.copytree(robot_folders()[1] / "gr1t2", mine)
    return mine


@pytest.fixture
def change(folder: Path) -> Callable[..., Humanoid]:
    """Changes a field of ``mine``, named by its path, or removes it; changes add up."""

    def apply(field: str, value: object = None) -> Humanoid:
        path = folder / "robot.yaml"
        content = yaml.load(path.read_text(), Loader=yaml.CSafeLoader)
        *way, last = field.split(".")
        place = content
        for key in way:
            place = place[int(key) if isinstance(place, list) else key]
        if value is None:
            del place[last]
        else:
            place[last] = value
        path.write_text(yaml.dump(content, Dumper=yaml.CSafeDumper, sort_keys=False))
        return Humanoid(folder)

    return apply
