# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from teo_description import DescriptionError
from teo_description.humanoid import load_humanoid
from teo_description.motion_files import read_motion, read_pose

GOOD = "time,AxialNeck,FrontalRightElbow\n0.0,0.0,-0.5\n0.5,0.2,-1.0\n1.0,0.4,-1.0\n"

TEO = load_humanoid("teo")


@pytest.fixture
def read(tmp_path):
    def from_text(text):
        path = tmp_path / "plan.csv"
        if text is not None:
            path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_motion(path, TEO)

    return from_text


def test_a_plan_is_read_as_it_was_written(read):
    motion = read(GOOD)
    assert motion.names == ("AxialNeck", "FrontalRightElbow")
    assert np.array_equal(motion.times, [0.0, 0.5, 1.0])
    assert np.array_equal(motion.positions, [[0.0, -0.5], [0.2, -1.0], [0.4, -1.0]])


def test_motion_is_linear_between_rows_and_held_outside(read):
    motion = read(GOOD.replace("0.0,0.0", "-1.0,0.0"))
    assert motion.duration == 2.0
    assert motion.at(0.75) == pytest.approx({"AxialNeck": 0.1, "FrontalRightElbow": -0.75})
    assert motion.at(-3.0) == pytest.approx({"AxialNeck": 0.0, "FrontalRightElbow": -0.5})
    assert motion.at(99.0) == pytest.approx({"AxialNeck": 0.4, "FrontalRightElbow": -1.0})


def test_blank_lines_spaces_and_a_byte_order_mark_do_no_harm(read):
    assert read("\ufeff" + GOOD.replace(",", ", ") + "\n\n").names == ("AxialNeck", "FrontalRightElbow")


@pytest.mark.parametrize(
    ("text", "code", "says"),
    [
        ("", "empty_motion", "header"),
        ("time,AxialNeck\n", "empty_motion", "at least one row"),
        ("0.0,0.1\n0.5,0.2\n", "unknown_joint", "0.1"),
        ("AxialNeck,FrontalNeck\n0.1,0.1\n", "bad_header", "time first"),
        ("time\n0.1\n", "bad_header", "joint names"),
        (GOOD.replace("AxialNeck", "Cuello"), "unknown_joint", "Cuello"),
        ("time,R_index_proximal_joint\n0.0,0.1\n", "unknown_joint", "gr1t2 has them: `--robot gr1t2`"),
        (GOOD.replace("AxialNeck", "FrontalRightElbow"), "bad_header", "each joint once"),
        (GOOD.replace("0.5,0.2,-1.0", "0.5,0.2"), "bad_row", "row 3"),
        (GOOD.replace("0.5,0.2", "0.5,mucho"), "bad_row", "mucho"),
        (GOOD.replace("0.5,0.2", "0.5,nan"), "not_finite", "row 3"),
        (GOOD.replace("0.5,0.2", "0.0,0.2"), "times_not_increasing", "row 3"),
        (GOOD.replace("0.5,0.2", "0.5,1.3"), "outside_limits", "row 3: expected AxialNeck"),
        (b"\xff\xfe\x00binary", "unreadable_file", "plan.csv"),
        (None, "unreadable_file", "plan.csv"),
    ],
)
def test_a_bad_plan_is_refused_with_the_place(read, text, code, says):
    with pytest.raises(DescriptionError) as caught:
        read(text)
    assert caught.value.code == code
    assert says in str(caught.value)


def test_a_position_rounded_at_a_limit_is_within_it(read):
    assert read(f"time,AxialNeck\n0,{math.radians(60):.6f}\n").duration == 0.0


class TestPose:
    def test_later_arguments_win_and_degrees_are_understood(self, tmp_path):
        path = tmp_path / "a=b.json"
        path.write_text('{"AxialNeck": 0.1, "FrontalNeck": 0}')
        pose = read_pose([str(path), "AxialNeck=-0.2", "FrontalRightElbow=-90deg"], TEO)
        assert pose == pytest.approx(
            {"AxialNeck": -0.2, "FrontalNeck": 0.0, "FrontalRightElbow": -math.pi / 2}
        )
        assert read_pose([], TEO) == {}

    @pytest.mark.parametrize(
        ("argument", "content", "code"),
        [
            ("Elbow=1", None, "unknown_joint"),
            ("AxialNeck=1rad", None, "bad_pose"),
            ("AxialNeck=nan", None, "not_finite"),
            ("AxialNeck=1e3deg", None, "outside_limits"),
            ("pose.json", None, "unreadable_file"),
            ("pose.json", "{", "unreadable_file"),
            ("pose.json", "[" * 100_000, "unreadable_file"),
            ("pose.json", "{}", "bad_pose"),
            ("pose.json", "[1, 2]", "bad_pose"),
            ("pose.json", '{"AxialNeck": "0"}', "bad_pose"),
            ("pose.json", '{"AxialNeck": NaN}', "not_finite"),
            ("pose.json", '{"Cuello": 0}', "unknown_joint"),
        ],
    )
    def test_bad_arguments_and_files_are_refused(self, tmp_path, monkeypatch, argument, content, code):
        monkeypatch.chdir(tmp_path)
        if content is not None:
            (tmp_path / "pose.json").write_text(content)
        with pytest.raises(DescriptionError) as caught:
            read_pose([argument], TEO)
        assert caught.value.code == code
