# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import csv
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_synthetic_signer.camera.sensors import SENSORS
from teo_synthetic_signer.cli.sensor_study import DISTANCES, Study, _app, seen_share, write_csv

WIDE = CameraModel.from_field_of_view(width=640, height=640, horizontal=math.radians(110))
D435 = SENSORS["d435"]


def share(distance: float, camera: CameraModel = WIDE, farthest: float = 10.0) -> float:
    """Of a person 1.7 m tall who faces a camera at the height of the chest."""
    from_chest = {
        "Nose": (0.0, -0.2, -0.1), "MidHip": (0.0, 0.5, 0.0),
        "RShoulder": (-0.18, 0.0, 0.0), "LShoulder": (0.18, 0.0, 0.0),
    }  # fmt: skip
    body = np.full((25, 3), math.nan)
    for name, way in from_chest.items():
        body[BODY_25.index[name]] = np.array([0.0, 0.0, distance]) + way
    return seen_share(camera, replace(D435, farthest=farthest), body)


def test_a_camera_sees_all_of_the_signing_space_from_afar_less_from_near_and_nothing_out_of_range() -> None:
    assert (share(2.0), share(2.5, farthest=1.5)) == (1.0, 0.0)
    narrow = CameraModel.from_field_of_view(width=640, height=400, horizontal=math.radians(60))
    shares = [share(distance, narrow) for distance in DISTANCES]
    assert shares == sorted(shares)
    assert shares[0] < 0.3 < 0.95 < shares[-1]


def test_the_csv_holds_what_was_measured(tmp_path: Path) -> None:
    path = tmp_path / "study.csv"
    write_csv([Study("d435", 1.5, 0.83, 0.026, 1.0, 0.028, 0.97)], path)
    (row,) = csv.DictReader(path.open())
    assert row["sensor"] == "d435"
    assert float(row["tips"]) == pytest.approx(0.028)
    assert list(tmp_path.iterdir()) == [path]


def test_a_device_that_is_not_known_is_refused() -> None:
    result = CliRunner().invoke(_app, ["--sensors", "d435,eyes"])
    assert result.exit_code == 2
    assert "eyes" in result.output
