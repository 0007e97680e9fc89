# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Every word of a text is found in its explanation: beside what is signed for it, or among what is not."""

from __future__ import annotations

import re
from pathlib import Path

from loaded import translator
from typer.testing import CliRunner

from teo_sign_languages import load_language
from teo_sign_translator.cli.translate import app
from teo_sign_translator.output.sign_coverage import read_signs
from teo_sign_translator.output.translation import explained

SENTENCES = Path(__file__).parents[4] / "test" / "data" / "known.txt"
WORD = re.compile(r"[\wáéíóúüñÁÉÍÓÚÜÑ]+")


def test_no_word_of_a_text_is_missing() -> None:
    signs = read_signs(load_language("ssp").table("teo"))
    for text in SENTENCES.read_text(encoding="utf-8").splitlines()[::8]:
        lines = list(explained(translator().translate(text, signs)))
        rows = [line for line in lines if line.startswith("  ")]
        assert rows
        told = {word for row in rows for word in WORD.findall(row)}
        lost = [word for word in WORD.findall(text) if word not in told]
        assert lost == [] or any(line.startswith("ignored: ") for line in lines), (text, lines)


def test_each_token_says_for_which_words_and_why() -> None:
    result = CliRunner().invoke(app, ["--explain", "Mañana te ayudo, Ana."])
    rows = [re.split(r"\s{2,}", line.strip()) for line in result.stdout.splitlines()[1:]]
    assert ["MAÑANA", "Mañana"] in [row[:2] for row in rows]
    assert ["A-N-A", "Ana", "in letters"] in rows
    assert any(row[0] == "AYUDAR" and "form 1>2" in row[2] for row in rows)


def test_it_explains_one_text() -> None:
    assert CliRunner().invoke(app, ["--explain", "--stdin"], input="Hola.").exit_code == 2
    assert CliRunner().invoke(app, ["--explain", "--json", "Hola."]).exit_code == 2
