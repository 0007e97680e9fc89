# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from PIL import Image

from teo_sign_training.cli import reproduce_paper
from teo_sign_training.corpus.paper_pairs import paper_pairs, paper_predictions


def test_curves_and_tables_are_written_and_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    reproduce_paper.run(tmp_path / "out", epochs=3, batch_size=8, seed=1)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "loss_0.0001.csv",
        "loss_0.0001.png",
        "loss_0.001.csv",
        "loss_0.001.png",
        "predictions.csv",
        "predictions.md",
    ]
    for rate in ("0.0001", "0.001"):
        rows = list(csv.DictReader(io.StringIO((tmp_path / "out" / f"loss_{rate}.csv").read_text("utf-8"))))
        assert [row["epoch"] for row in rows] == ["1", "2", "3"]
        assert float(rows[2]["training_loss"]) < float(rows[0]["training_loss"])
        assert float(rows[2]["validation_loss"]) > 0
        with Image.open(tmp_path / "out" / f"loss_{rate}.png") as picture:
            assert picture.width > 600
    rows = list(csv.DictReader(io.StringIO((tmp_path / "out" / "predictions.csv").read_text("utf-8"))))
    assert [row["Spanish"] for row in rows] == [pair.sentence for pair in paper_pairs()[:10]]
    assert [row["paper at 0.0001"] for row in rows] == [
        " ".join(pair.glosses) for pair in paper_predictions()
    ]
    assert all(row["ours at 0.0001"] and row["ours at 0.001"] for row in rows)
    report = (tmp_path / "out" / "predictions.md").read_text("utf-8")
    assert "The paper's model predicts 7 of its first 10 sentences" in report
    assert "of the 8 held-out sentences" in report
    assert "Venga Levantar" in report
    assert "The paper's model predicts 7" in capsys.readouterr().out.replace("\n", " ")
