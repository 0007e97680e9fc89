# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What people see of the table."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import cv2
import numpy as np
import pytest
from made_signs import make_sign
from numpy.typing import NDArray
from typer.testing import CliRunner, Result

from teo_description.pictures.rendering import save_png
from teo_description.robot import Robot
from teo_lut_executor.cli.lut import app
from teo_signs.look_up_table import default_lut_directory
from teo_signs.pictures import in_one_picture

TABLE = default_lut_directory()


def run(*arguments: str | Path) -> Result:
    return CliRunner(env={"COLUMNS": "200"}).invoke(app, [str(argument) for argument in arguments])


def copied(folder: Path, *glosses: str) -> None:
    """Put entries of the package's table into a folder."""
    for gloss in glosses:
        shutil.copy(TABLE / f"{gloss}.json", folder)


def test_list_says_of_every_sign_what_it_is_and_as_json_its_motion(tmp_path: Path) -> None:
    glosses = {"A", "B", "7", "CASA", "MESA", "COCHE"}
    copied(tmp_path, *glosses)
    lines = {
        line.split()[0]: line for line in run("list", "--lut", tmp_path).output.splitlines() if line.strip()
    }
    assert all(word in lines["A"] for word in ("letter", "right", "spoken-to-signed"))
    signs = json.loads(run("list", "--lut", tmp_path, "--json").output)["signs"]
    listed = {sign["gloss"]: sign for sign in signs}
    assert listed.keys() == glosses <= lines.keys()
    assert (listed["7"]["kind"], listed["7"]["handedness"]) == ("number", "both")
    # Flat hands and fists, as their scores say; a letter looks like itself.
    assert all(listed[gloss]["handshapes"] == ["B"] for gloss in ("CASA", "MESA", "B"))
    assert all(listed[gloss]["handshapes"] == ["A"] for gloss in ("COCHE", "A"))
    assert len({sign["motion_hash"] for sign in signs}) == len(glosses)


def test_nearest_as_json_names_for_each_sign_those_most_like_it(tmp_path: Path) -> None:
    copied(tmp_path, "R", "U", "A")
    near = json.loads(run("nearest", "--lut", tmp_path, "--json", "--count", "1").output)
    assert near["R"][0]["gloss"] == "U" and near["U"][0]["gloss"] == "R"  # as LUT.md says
    assert len(near["A"]) == 1
    assert json.loads(run("nearest", "U", "A", "--lut", tmp_path, "--json", "--count", "1").output) == {
        "U": near["U"],
        "A": near["A"],
    }
    (tmp_path / "one").mkdir()
    copied(tmp_path / "one", "A")
    alone = run("nearest", "A", "--lut", tmp_path / "one", "--json")
    assert json.loads(alone.output) == {"A": []}  # nothing else is there
    unknown = run("nearest", "U", "Ñ", "--lut", tmp_path)
    assert unknown.exit_code == 1 and "unknown_sign" in unknown.output


def test_review_writes_what_enough_people_found_right_into_the_own_table(
    tmp_path: Path, data_home: Path
) -> None:
    copied(tmp_path, "CALLE", "CASA")
    listed = json.loads(run("list", "--lut", tmp_path, "--json").output)["signs"]
    motions = {sign["gloss"]: sign["motion_hash"] for sign in listed}
    answers = [
        {
            "kind": "sign",
            "reviewer": reviewer,
            "gloss": gloss,
            "motion_hash": motions[gloss],
            "rating": rating,
            "at": "2026-03-01T12:00:00+00:00",
        }
        for reviewer in ("Ana", "Luis", "Eva")
        for gloss, rating in (("CALLE", "right"), ("CASA", "wrong"))
    ]
    export = tmp_path / "reviews.json"
    export.write_text(json.dumps({"format": "teo-review-1", "answers": answers}), "utf-8")
    result = run("review", export)
    assert result.exit_code == 0, result.output
    assert [path.name for path in (data_home / "teo" / "lut").iterdir()] == ["CALLE.json"]
    assert "standing: reviewed" in run("show", "CALLE").output
    assert "3 of 3" in result.output and "0 of 3" in result.output


def test_show_json_is_the_file() -> None:
    assert run("show", "NOMBRE", "--lut", TABLE, "--json").output == (TABLE / "NOMBRE.json").read_text(
        "utf-8"
    )


def test_validate_passes_for_the_package() -> None:
    result = run("validate", TABLE)
    assert result.exit_code == 0
    assert "0 errors, 0 warnings" in result.output


def test_validate_names_every_entry_that_is_wrong(tmp_path: Path) -> None:
    copied(tmp_path, "A", "B")
    (tmp_path / "B.json").write_text(
        (tmp_path / "B.json").read_text("utf-8").replace('"letter"', '"word"'), "utf-8"
    )
    (tmp_path / "C.json").touch()
    result = run("validate", tmp_path)
    assert result.exit_code == 1
    assert "error bad_value: B.json: kind: expected" in result.output
    assert "error empty_file: C.json" in result.output
    assert "3 entries" in result.output
    assert "2 errors" in result.output


def test_render_draws_a_still_and_a_moving_sign(tmp_path: Path) -> None:
    assert run("render", "A", "--lut", TABLE, "--out", tmp_path / "a.png").exit_code == 0
    assert run("render", "J", "--lut", TABLE, "--out", tmp_path / "j.png").exit_code == 0
    still, moving = (cv2.imread(str(tmp_path / name)) for name in ("a.png", "j.png"))
    assert moving.shape[0] > still.shape[0]
    assert moving.shape[1] > still.shape[1]


def test_render_films_a_sign_for_its_duration(tmp_path: Path) -> None:
    assert run("render", "HOLA", "--lut", TABLE, "--out", tmp_path / "hola.mp4").exit_code == 0
    film = cv2.VideoCapture(str(tmp_path / "hola.mp4"))
    assert film.get(cv2.CAP_PROP_FRAME_COUNT) / film.get(cv2.CAP_PROP_FPS) == pytest.approx(1.25, abs=0.1)


def test_render_all_makes_a_sheet_of_each_kind(tmp_path: Path) -> None:
    copied(tmp_path, "A", "J", "7", "MI")
    result = run("render", "--all", "--lut", tmp_path, "--out", tmp_path / "sheets")
    assert result.exit_code == 0
    assert sorted(path.name for path in (tmp_path / "sheets").iterdir()) == [
        "letters.png",
        "numbers.png",
        "signs.png",
    ]


def test_overview_shows_two_moments_of_each_sign(tmp_path: Path) -> None:
    copied(tmp_path, *"123456789")
    result = run("overview", "--kind", "number", "--lut", tmp_path, "--out", tmp_path / "all.png")
    assert result.exit_code == 0, result.output
    assert "9 signs" in result.output
    picture = cv2.imread(str(tmp_path / "all.png"))
    # Eighteen moments, sixteen a row.
    assert picture.shape[1] > 16 * 150 and 2 * 150 < picture.shape[0] < 2 * 250
    assert run("overview", "--kind", "none", "--lut", tmp_path, "--out", tmp_path / "no.png").exit_code == 1


def test_compare_lays_each_sign_beside_its_picture(tmp_path: Path) -> None:
    photograph = np.full((300, 200, 3), (40, 90, 30), np.uint8)
    for name in ("casa.png", "libro.jpg"):
        cv2.imwrite(str(tmp_path / name), photograph)
    out = tmp_path / "sheet.png"
    pairs = ("CASA", tmp_path / "casa.png", "LIBRO", tmp_path / "libro.jpg")
    result = run("compare", *pairs, "--lut", TABLE, "--out", out)
    assert result.exit_code == 0, result.output
    sheet = cv2.imread(str(out))
    cells = np.array_split(sheet, 4, axis=1)
    # The photographs whole and in their colour, not the robots.
    greens = [float((np.abs(cell.astype(int) - (40, 90, 30)).max(axis=2) < 20).mean()) for cell in cells]
    assert min(greens[0], greens[2]) > 0.55 and max(greens[1], greens[3]) < 0.05


def test_compare_draws_the_way_of_a_hand_and_how_often_it_goes(tmp_path: Path) -> None:
    def drawn(name: str, knots: list[list[float]]) -> NDArray[np.int64]:
        """What is drawn over the robot, which is grey: where the picture is pure white or black."""
        times = [0.4 * index for index in range(len(knots))]
        sign = make_sign("OLA", knots, times, joints=("FrontalRightShoulder", "FrontalRightElbow"))
        picture = in_one_picture(Robot.load(), sign).astype(int)
        save_png(tmp_path / f"{name}.png", picture.astype(np.uint8))
        return np.argwhere(picture.min(axis=2) == 255)

    low, high = [-0.6, -1.0], [-0.6, -1.7]
    up, down = drawn("up", [low, high]), drawn("down", [high, low])
    twice = drawn("twice", [low, high, low, high])
    assert len(drawn("still", [high, high])) == 0
    # The head, the broadest part, is where the hand ends: above (rows count downwards) or below.
    middle = np.mean([up[:, 0].min(), up[:, 0].max()])
    assert np.bincount(up[:, 0]).argmax() < middle < np.bincount(down[:, 0]).argmax()
    # The same ends and way; a second head right behind the first.
    differing = np.array([*set(map(tuple, up)).symmetric_difference(map(tuple, twice))])
    assert len(differing) > 50 and np.median(differing[:, 0]) < middle


def test_compare_refuses_what_is_no_pair_and_no_picture(tmp_path: Path) -> None:
    (tmp_path / "text.png").write_text("no picture")
    for pairs, code in (
        (("CASA",), "bad_arguments"),
        (("SIN_SIGNO", tmp_path / "text.png"), "unknown_sign"),
        (("CASA", tmp_path / "text.png"), "bad_picture"),
        (("CASA", tmp_path / "absent.png"), "bad_picture"),
    ):
        result = run("compare", *pairs, "--lut", TABLE, "--out", tmp_path / "sheet.png")
        assert result.exit_code == 1 and code in result.output
    assert not (tmp_path / "sheet.png").exists()


def test_schema_knows_every_field_of_an_entry() -> None:
    fields = json.loads(run("schema").output)["$defs"]["SignFile"]["properties"]
    assert json.loads((TABLE / "CASA.json").read_text("utf-8")).keys() <= fields.keys()


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (["show", "SIN_SIGNO"], "unknown_sign"),
        (["list", "--lut", "nowhere"], "no_directory"),
        (["review", "none.json"], "unreadable"),
        (["render", "A"], "bad_arguments"),
        (["render", "--out", "x.png"], "bad_arguments"),
        (["render", "A", "--all", "--out", "x.png"], "bad_arguments"),
        (["render", "A", "--out", "x.gif"], "bad_arguments"),
    ],
)
def test_what_cannot_be_done_is_said_with_its_code(arguments: list[str], code: str) -> None:
    result = run(*arguments)
    assert result.exit_code == 1
    assert code in result.output
