# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Translating needs nothing of what training needs."""

from __future__ import annotations

import subprocess
import sys

import pytest

# Imported by training and by figures alone. A module that is None cannot be imported.
ABSENT = ("torch", "matplotlib", "sacrebleu", "simplemma")
WITHOUT = f"import sys\nsys.modules.update(dict.fromkeys({ABSENT}))\n"

TRANSLATE = """
from teo_sign_translator.cli.translate import main
sys.argv = ["translate", "--model", sys.argv[1], "Hola, me llamo Ana."]
assert "rclpy" not in sys.modules
try:
    import torch
except ModuleNotFoundError:
    main()
"""
NODE = """
import rclpy
from teo_sign_msgs.srv import Translate
from teo_sign_translator.node.translator_node import TranslatorNode
rclpy.init()
node = TranslatorNode()
assert node.start()
answer = node._on_translate(Translate.Request(text="Hola, me llamo Ana."), Translate.Response())
print(*(token.gloss for sentence in answer.sentences for token in sentence.tokens))
node.destroy_node()
rclpy.shutdown()
"""


def _run(code: str, *arguments: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT + code, *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.mark.parametrize("model", ["pointer", "lstm256"])
def test_translate_runs_without_them(model: str) -> None:
    assert _run(TRANSLATE, model) == "HOLA MI NOMBRE A-N-A"


@pytest.mark.usefixtures("domain_id")
def test_the_node_runs_without_them() -> None:
    assert _run(NODE) == "HOLA  MI NOMBRE A N A"
