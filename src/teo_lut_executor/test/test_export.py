# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Exports, read back by readers of their own: rows of doubles as C++ reads them, and YAML."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rclpy
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from msgspec.structs import replace as changed
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from typer.testing import CliRunner, Result

from teo_lut_executor.cli.lut import app
from teo_motion.planner import Planner, sign_motion
from teo_motion.sentence.signing_style import RestPosture
from teo_names import HOME, RIGHT_ARM
from teo_signs.errors import LutError
from teo_signs.export import (
    SignMotion,
    play_motion2_parameters,
    playback_table,
    save_playback_tables,
)
from teo_signs.sign import Sign


def parse_playback(text: str) -> list[list[float]]:
    """`while (stream >> number) row.push_back(number)` on each line; rows without a number are skipped."""
    rows = []
    for line in text.split("\n"):
        row: list[float] = []
        for word in line.split():
            try:
                row.append(float(word))
            except ValueError:
                break
        if row:
            rows.append(row)
    return rows


def parse_motions(text: str) -> dict[str, dict[str, Any]]:
    """As motion_loader.cpp: strings, doubles (an integer is none), and sizes that fit."""
    motions = yaml.safe_load(text)["play_motion2"]["ros__parameters"]["motions"]
    for key, motion in motions.items():
        assert isinstance(key, str)
        assert all(type(joint) is str for joint in motion["joints"])
        assert all(type(number) is float for number in motion["positions"] + motion["times_from_start"])
        assert len(motion["positions"]) == len(motion["joints"]) * len(motion["times_from_start"])
        assert set(motion["meta"]) == {"name", "usage", "description"}
        assert all(type(text) is str for text in motion["meta"].values())
    return motions


def dextra_angle(axis: int, value: float) -> float:
    """Radians of a hand's axis by the published line: 7 + 78 mm / 20, thumb -90 + 180 mm / 10."""
    if axis == 0:
        return math.radians(value)
    return math.radians(-90.0 + 18.0 * value) if axis == 1 else math.radians(7.0 + 3.9 * value)


def planned(signs: Mapping[str, Sign], gloss: str, **options: Any) -> SignMotion:
    planner = Planner(signs, least_standing="sketched", rest_posture=RestPosture.HANGING)
    return sign_motion(planner, signs[gloss], **options)


def run(*arguments: str | Path) -> Result:
    return CliRunner(env={"COLUMNS": "300"}).invoke(app, ["export", *(str(word) for word in arguments)])


def test_a_motion_goes_from_rest_over_every_knot_back_to_rest(table: Mapping[str, Sign]) -> None:
    motion = planned(table, "CASA")
    home = np.array([HOME[joint] for joint in motion.joints])
    np.testing.assert_allclose(motion.positions[[0, -1]], [home, home], atol=1e-12)
    columns = [motion.joints.index(joint) for joint in table["CASA"].joints]
    for knot in table["CASA"].knots:
        assert np.abs(motion.positions[:, columns] - knot).max(axis=1).min() < 0.02


def test_only_the_parts_that_move_are_exported(table: Mapping[str, Sign]) -> None:
    assert tuple(planned(table, "L").limbs) == ("right_arm", "right_hand")
    assert tuple(planned(table, "CASA").limbs) == ("left_arm", "right_arm", "left_hand", "right_hand")


@pytest.mark.slow
@settings(max_examples=8, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(seed=st.integers(0, 2**32 - 1), period=st.sampled_from([0.01, 0.02, 0.05]))
def test_what_is_written_is_read_back(
    random_table: Callable[..., dict[str, Sign]], seed: int, period: float
) -> None:
    signs = random_table(np.random.default_rng(seed), signs=1)
    motion = planned(signs, "SIGN0", period=period)

    read = parse_motions(play_motion2_parameters([motion]))["SIGN0"]
    assert tuple(read["joints"]) == motion.joints
    rows = np.array(read["positions"]).reshape(-1, len(read["joints"]))
    np.testing.assert_allclose(rows, motion.positions, atol=5.1e-10)
    np.testing.assert_allclose(read["times_from_start"], motion.times, atol=1e-9)

    for limb in motion.limbs:
        rows = np.array(parse_playback(playback_table(motion, limb)))
        np.testing.assert_allclose(rows[:, 0], np.arange(len(rows)) * period, atol=1e-9)
        if limb.endswith("hand"):
            angles = [[dextra_angle(axis, v) for axis, v in enumerate(row)] for row in rows[:, 1:]]
            # Half a digit of a thumb's millimetre, 1e-4, is 18 times as much in degrees.
            np.testing.assert_allclose(angles, motion.limb(limb), atol=math.radians(18.1 * 0.5e-4))
            assert (rows[:, 1:] >= 0.0).all()
            assert (rows[:, 1:] <= [90.0, 10.0, 20.0, 20.0, 20.0, 20.0]).all()
        else:
            np.testing.assert_allclose(np.radians(rows[:, 1:]), motion.limb(limb), atol=math.radians(0.51e-4))


def test_a_gloss_that_yaml_takes_for_something_else_stays_a_text(make_sign: Callable[..., Sign]) -> None:
    knots = [[HOME[joint] + 0.1 for joint in RIGHT_ARM]]
    glosses = ("NO", "Y", "N", "7", "ÑANDÚ", "ON", "NULL", "POR_QUÉ")
    signs = {gloss: make_sign(gloss, knots, joints=RIGHT_ARM) for gloss in glosses}
    motions = parse_motions(play_motion2_parameters([planned(signs, gloss) for gloss in glosses]))
    assert [motion["meta"]["name"] for motion in motions.values()] == list(motions) == list(glosses)


def test_ros_itself_reads_the_parameters(
    tmp_path: Path, domain_id: int, make_sign: Callable[..., Sign]
) -> None:
    """rcl's parser is another one than PyYAML: as play_motion2 starts, so does this node."""
    knots = [[HOME[joint] + 0.1 for joint in RIGHT_ARM]]
    signs = {gloss: make_sign(gloss, knots, joints=RIGHT_ARM) for gloss in ("NO", "POR_QUÉ")}
    motions = [planned(signs, gloss) for gloss in signs]
    file = tmp_path / "motions.yaml"
    file.write_text(play_motion2_parameters(motions), encoding="utf-8")
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    try:
        node = Node(
            "play_motion2",
            context=context,
            cli_args=["--ros-args", "--params-file", str(file)],
            automatically_declare_parameters_from_overrides=True,
            start_parameter_services=False,
        )
        for motion in motions:
            read = node.get_parameters_by_prefix(f"motions.{motion.sign.gloss}")
            assert read["joints"].type_ == Parameter.Type.STRING_ARRAY
            assert read["positions"].type_ == Parameter.Type.DOUBLE_ARRAY
            assert read["times_from_start"].type_ == Parameter.Type.DOUBLE_ARRAY
            assert read["meta.name"].value == motion.sign.gloss
            np.testing.assert_allclose(read["positions"].value, motion.positions.ravel(), atol=5.1e-10)
        node.destroy_node()
    finally:
        rclpy.shutdown(context=context)


def test_a_planner_that_would_spell_the_sign_is_refused(make_sign: Callable[..., Sign]) -> None:
    sign = make_sign("OLA", [[HOME[joint] + 0.1 for joint in RIGHT_ARM]], joints=RIGHT_ARM)
    sketched = changed(sign.provenance, standing="sketched")
    letters = {
        letter: make_sign(
            letter, [[HOME[joint] + 0.2 for joint in RIGHT_ARM]], joints=RIGHT_ARM, kind="letter"
        )
        for letter in "OLA"
    }
    signs = {"OLA": dataclasses.replace(sign, provenance=sketched), **letters}
    assert planned(signs, "OLA").sign.gloss == "OLA"
    with pytest.raises(LutError, match="spelled") as error:
        sign_motion(Planner(signs, least_standing="described"), signs["OLA"])
    assert error.value.code == "not_signed"


@pytest.mark.parametrize("period", [0.0, -0.02, 0.5, math.nan, math.inf])
def test_a_period_out_of_range_is_refused(table: Mapping[str, Sign], period: float) -> None:
    with pytest.raises(LutError) as error:
        planned(table, "L", period=period)
    assert error.value.code == "bad_period"


def test_a_folder_is_replaced_whole_and_only_on_request(tmp_path: Path, table: Mapping[str, Sign]) -> None:
    motion = planned(table, "CASA")
    save_playback_tables(tmp_path, motion)
    (tmp_path / "CASA" / "head.txt").write_text("0 0 0\n")  # of an older version that moved the head
    with pytest.raises(LutError) as error:
        save_playback_tables(tmp_path, motion)
    assert error.value.code == "exists"
    assert (tmp_path / "CASA" / "head.txt").exists()
    files = save_playback_tables(tmp_path, motion, replace=True)
    about = tmp_path / "CASA" / "SIGN.txt"
    assert sorted([*files, about]) == sorted((tmp_path / "CASA").iterdir())
    assert "of ssp for teo" in about.read_text()
    assert [path.name for path in tmp_path.iterdir()] == ["CASA"]


def test_the_command_writes_both_formats(tmp_path: Path, table_directory: Path) -> None:
    out = tmp_path / "motions.yaml"
    result = run("TÚ", "L", "--out", out, "--lut", table_directory)
    assert result.exit_code == 0, result.output
    assert set(parse_motions(out.read_text("utf-8"))) == {"TÚ", "L"}
    result = run("TÚ", "--format", "yarp", "--out", tmp_path / "yarp", "--lut", table_directory)
    assert result.exit_code == 0, result.output
    assert {path.name for path in (tmp_path / "yarp" / "TÚ").iterdir()} == {
        "rightArm.txt",
        "rightHand.txt",
        "SIGN.txt",
    }
    assert "timeIdx 0, timeScale 1, (mask 0 1 1 1 1 1 1)" in result.output


def test_the_command_refuses_with_a_code(tmp_path: Path, table_directory: Path) -> None:
    out = tmp_path / "motions.yaml"
    for arguments, code in (
        (("SIN_SIGNO", "--out", out), "unknown_sign"),
        (("L", "--out", out, "--period", "9"), "bad_period"),
        (("L", "--out", table_directory / "L.json"), "exists"),
        (("L", "--out", table_directory / "L.json" / "below.yaml"), "not_written"),
    ):
        result = run(*arguments, "--lut", table_directory)
        assert result.exit_code == 1
        assert code in result.output
        assert not out.exists()
