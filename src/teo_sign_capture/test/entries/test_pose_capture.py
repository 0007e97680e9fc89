# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from importlib import resources
from pathlib import Path

import numpy as np
from typer.testing import CliRunner

from teo_description.robot import Robot
from teo_lut_executor.cli.lut import app
from teo_sign_authoring.alphabet.letter_clips import load_letter_clips
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign

CLIPS = Path(str(resources.files("spoken_to_signed"))) / "assets" / "fingerspelling_lexicon" / "ssp"
TIPS = tuple(f"Right{finger}FingerTip" for finger in ("Thumb", "Index", "Middle", "Ring", "Pinky"))


def handshape(robot: Robot, sign: Sign) -> np.ndarray:
    """Finger tips in the axes of the palm in the middle of a sign [m]. Shape (5, 3)."""
    middle = [np.interp(sign.duration / 2.0, sign.times, column) for column in sign.knots.T]
    q = robot.configuration(dict(zip(sign.joints, map(float, middle), strict=True)))
    palm, *tips = robot.placements(q, ("right_palm", *TIPS))
    return np.array([(tip[:3, 3] - palm[:3, 3]) @ palm[:3, :3] for tip in tips])


def test_an_imported_letter_looks_like_the_tables_letter(robot: Robot, tmp_path: Path) -> None:
    clip = CLIPS / load_letter_clips(load_language(DEFAULT_LANGUAGE))["T"].file
    line = f"import {clip} --gloss T --kind letter --lut {tmp_path} --licence MIT --recorded 2019-01-31"
    result = CliRunner(env={"COLUMNS": "200"}).invoke(app, line.split())
    assert result.exit_code == 0, result.output
    sign = Lut.open(tmp_path)["T"]
    assert sign.handedness == "right"
    assert sign.provenance.standing == "recorded"
    assert sign.provenance.recorded == "2019-01-31"
    assert clip.name in sign.provenance.source
    assert "one camera" in sign.provenance.notes
    assert (tmp_path / "T.png").stat().st_size > 10_000
    shape = handshape(robot, sign)
    away = {
        name: np.linalg.norm(handshape(robot, entry) - shape, axis=1).mean()
        for name, entry in Lut.open(default_lut_directory()).items()
        if entry.kind == "letter"
    }
    assert "T" in sorted(away, key=lambda name: away[name])[:3]

    again = CliRunner(env={"COLUMNS": "200"}).invoke(app, line.split())
    assert again.exit_code == 1
    assert "exists" in again.output
