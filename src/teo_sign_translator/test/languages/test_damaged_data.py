# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A language whose files are damaged is refused by file and field."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from teo_sign_languages import load_language
from teo_sign_training.corpus.grammar_file import load_grammar
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pipeline.completeness import PipelineWords
from teo_sign_translator.text.rules import TextRules

TEXT = load_language("ase").text


@pytest.fixture
def text(tmp_path: Path) -> Path:
    return Path(shutil.copytree(TEXT, tmp_path / "text"))


@pytest.mark.parametrize(
    ("file", "old", "new", "named"),
    [
        ("reading.yaml", "numbers:\n", "numerals:\n", "sections"),
        ("reading.yaml", "  joiner: ", "  joint: ", "numbers"),
        ("reading.yaml", "  month_first: true", "  month_first: maybe", "month_first"),
        ("reading.yaml", "  ordinal: '(", "  ordinal: '((", "ordinal"),
        ("reading.yaml", "  variants: {}", "  variants: {once: often}", "variants"),
        ("reading.yaml", "numbers:\n", "numbers: [\n", "YAML"),
        ("pipeline.yaml", '  goes_to: ""', "  goes_to: [to]", "goes_to"),
        ("pipeline.yaml", "completeness:", "covering:", "sections"),
        ("morphology/suffixes.tsv", "V:inf\t", "V:infinitive\t", "V:infinitive"),
        ("morphology/suffixes.tsv", "(.+e)\t", "(.+e\t", "regular expression"),
        ("grammar/words.yaml", '"don\'t": do not', '"don\'t": do not ever', "don't"),
        ("grammar/words.yaml", "an: 'a (", "an: 'a @nouns (", "meetings"),
    ],
)
def test_the_file_and_the_field_are_named(text: Path, file: str, old: str, new: str, named: str) -> None:
    path = text / file
    content = path.read_text(encoding="utf-8")
    assert old in content
    path.write_text(content.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(TranslationError) as refusal:
        TextRules.load(text)
        PipelineWords.load(text)
        Morphology.load(text)
        load_grammar(text / "grammar")
    assert refusal.value.code in ("invalid_data", "invalid_grammar")
    assert named in str(refusal.value)
