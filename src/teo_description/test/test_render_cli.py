# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import av
import cv2
import pytest

from teo_description.pictures import render_cli

PLAN = "time,FrontalRightElbow\n0.0,0.0\n0.4,-0.3\n"


@pytest.fixture
def render(monkeypatch, capsys):
    def run(*arguments):
        monkeypatch.setattr("sys.argv", ["render", *map(str, arguments)])
        with pytest.raises(SystemExit) as ended:
            render_cli.main()
        return ended.value.code, capsys.readouterr().err

    return run


@pytest.fixture
def plan(tmp_path):
    path = tmp_path / "plan.csv"
    path.write_text(PLAN)
    return path


def test_a_pose_becomes_a_picture(render, tmp_path):
    out = tmp_path / "pose.png"
    pose = ("--pose", "FrontalRightElbow=-90deg", "AxialNeck=0.2")
    code, said = render(*pose, "--out", out, "--camera", "full", "--size", "320x240")
    assert (code, str(out) in said.replace("\n", "")) == (0, True)
    assert cv2.imread(str(out)).shape == (240, 320, 3)


def test_a_plan_becomes_a_film_and_a_strip(render, plan, tmp_path):
    film, strip = tmp_path / "motion.mp4", tmp_path / "motion.png"
    code, _ = render(
        "--csv", plan, "--mp4", film, "--strip", strip, "--size", "160x120", "--moments", 4, "--columns", 2
    )
    assert code == 0
    with av.open(str(film)) as container:
        assert len(list(container.decode(video=0))) == 11  # 0.4 s at 25 frames per second, and the last pose
    assert cv2.imread(str(strip)).shape == (2 * 124 + 4, 2 * 164 + 4, 3)


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        ((), 2, "--out"),
        (("--pose", "Codo=1", "--out", "x.png"), 1, "Codo"),
        (("--out", "x.png", "--camera", "side"), 1, "front, hand, sign, sign_hand, full"),
        (("--out", "x.png", "--size", "big"), 2, "640x480"),
        (("--out", "nowhere/x.png"), 1, "nowhere"),
        (("--csv", "plan.csv"), 2, "--mp4 or --strip"),
        (("--csv", "plan.csv", "--out", "x.png"), 2, "either"),
        (("--csv", "none.csv", "--mp4", "x.mp4"), 1, "none.csv"),
    ],
)
def test_mistakes_end_with_a_sentence_and_no_picture(render, plan, monkeypatch, arguments, code, says):
    monkeypatch.chdir(plan.parent)
    ended, said = render(*arguments)
    assert ended == code
    assert says in said.replace("\n", " ")
    assert "Traceback" not in said
    assert not {file.suffix for file in plan.parent.iterdir()} & {".png", ".mp4"}
