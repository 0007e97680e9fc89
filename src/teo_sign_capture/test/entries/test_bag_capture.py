# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from made_bags import signing, write_bag
from refusals import refused

from teo_description.robot import Robot
from teo_sign_capture.entries.bag_capture import CaptureJob, Settings, capture_bags, is_captured
from teo_sign_capture.entries.take import Cut
from teo_signs.look_up_table import Lut

slow = functools.partial(signing, rate=15.0)  # half the frames take half the time


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(table=tmp_path / "lut", cache=tmp_path / "cache")


def job(*bags: Path, gloss: str = "SIGNO", cut: Cut | None = None) -> CaptureJob:
    return CaptureJob(gloss=gloss, bags=bags, cut=cut or Cut())


def test_a_bag_becomes_an_entry_with_a_picture(robot: Robot, settings: Settings, tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "SIGNO.mcap", slow())
    saved = capture_bags(robot, job(bag), replace(settings, pictures=tmp_path / "pictures", film=True))
    sign = Lut.open(settings.table)["SIGNO"]
    assert sign.provenance.standing == "recorded"
    assert sign.provenance.recorded == "2024-03-09"
    assert sign.provenance.source.startswith("SIGNO.mcap, sha256 ")
    assert saved.pictures == tuple(tmp_path / "pictures" / name for name in ("SIGNO.png", "SIGNO.mp4"))
    picture = cv2.imread(str(saved.pictures[0]))
    # Two rows: the person who is drawn above, TEO below, neither empty.
    above, below = np.vsplit(picture[: 2 * (picture.shape[0] // 2)], 2)
    assert above.std() > 5.0
    assert below.std() > 5.0
    film = cv2.VideoCapture(str(tmp_path / "pictures" / "SIGNO.mp4"))
    assert film.get(cv2.CAP_PROP_FRAME_COUNT) >= 0.6 * film.get(cv2.CAP_PROP_FPS)


def test_the_same_recordings_are_known_again_others_are_not(
    robot: Robot, settings: Settings, tmp_path: Path
) -> None:
    bag = write_bag(tmp_path / "SIGNO.mcap", slow())
    assert not is_captured(job(bag), settings.table)
    capture_bags(robot, job(bag), settings)
    assert is_captured(job(bag), settings.table)
    assert not is_captured(job(bag, cut=Cut(start=0.5)), settings.table)
    assert not is_captured(job(bag, bag), settings.table)
    write_bag(bag, slow(seed=3))
    assert not is_captured(job(bag), settings.table)


def test_a_gloss_that_exists_is_refused_before_anything_is_read(
    robot: Robot, settings: Settings, tmp_path: Path
) -> None:
    settings.table.mkdir()
    (settings.table / "SIGNO.json").write_text("{}")
    assert not is_captured(job(tmp_path / "nowhere.mcap"), settings.table)
    with refused("exists", "--replace"):
        capture_bags(robot, job(tmp_path / "nowhere.mcap"), settings)
    assert (settings.table / "SIGNO.json").read_text() == "{}"


@pytest.mark.parametrize("gloss", ["hola", "", "../HOLA", "HOLA!", "A" * 61])
def test_a_name_that_is_no_gloss_is_refused(robot: Robot, settings: Settings, gloss: str) -> None:
    with refused("bad_gloss"):
        capture_bags(robot, job(Path("nowhere"), gloss=gloss), settings)
    assert not settings.table.exists()


def test_a_take_that_is_no_good_is_left_out_with_the_reason(
    robot: Robot, settings: Settings, tmp_path: Path
) -> None:
    good = write_bag(tmp_path / "good.mcap", slow())
    bad = write_bag(tmp_path / "bad.mcap", slow(moves=[]))
    saved = capture_bags(robot, job(bad, good), settings)
    assert "no_motion: bad.mcap" in saved.captured.sign.provenance.notes
    with refused("no_motion"):
        capture_bags(robot, job(bad, bad, gloss="OTRO"), settings)


def test_a_sign_is_captured_from_a_bag_whose_recorder_was_killed(
    robot: Robot, settings: Settings, tmp_path: Path
) -> None:
    """Its index at the end is missing."""
    bag = write_bag(tmp_path / "SIGNO.mcap", slow())
    bag.write_bytes(bag.read_bytes()[:-200])
    saved = capture_bags(robot, job(bag), replace(settings, pictures=tmp_path / "pictures"))
    assert saved.captured.take.span.start == pytest.approx(1.1, abs=0.1)
    assert any("SIGNO.mcap: cut off" in warning for warning in saved.warnings)
    assert len(saved.pictures) == 1


def test_a_table_that_cannot_be_looked_at_is_refused_at_once(robot: Robot, tmp_path: Path) -> None:
    too_long = Settings(table=tmp_path / ("x" * 300))  # longer than file systems allow
    with refused("not_written"):
        capture_bags(robot, job(tmp_path / "nowhere.mcap"), too_long)


def test_a_table_that_cannot_be_written_is_said(robot: Robot, tmp_path: Path) -> None:
    (tmp_path / "lut").write_text("a file where the table should be")
    bag = write_bag(tmp_path / "SIGNO.mcap", slow())
    with refused("not_written"):
        capture_bags(robot, job(bag), Settings(table=tmp_path / "lut"))


def test_a_picture_that_cannot_be_drawn_costs_no_entry(
    robot: Robot, settings: Settings, tmp_path: Path
) -> None:
    (tmp_path / "pictures").write_text("a file where the pictures should be")
    bag = write_bag(tmp_path / "SIGNO.mcap", slow())
    saved = capture_bags(robot, job(bag), replace(settings, pictures=tmp_path / "pictures"))
    assert saved.pictures == ()
    assert "not drawn" in saved.warnings[-1]
    assert "SIGNO" in Lut.open(settings.table)
