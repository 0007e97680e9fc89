# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A language whose files are damaged is refused by file and field, or by file and line."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from refusals import refused

from teo_sign_languages import load_language
from teo_sign_training.corpus.grammar_file import load_grammar
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.morphology.conjugation import Conjugations
from teo_sign_translator.output.senses import read_senses
from teo_sign_translator.output.sign_choice import read_incorporated, read_paraphrases, read_synonyms
from teo_sign_translator.output.sign_coverage import read_signs
from teo_sign_translator.pipeline.agreement import Agreement
from teo_sign_translator.pipeline.completeness import FunctionWords, read_gloss_words
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.text.rules import Expressions, TextRules

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


@pytest.mark.parametrize(
    ("read", "lines"),
    [
        (FunctionWords.load, ["DEF\tel", "PREP\ta\nPREP\tde", "PREP"]),
        (read_gloss_words, ["edad\taño", "EDAD\taño\nEDAD\tvejez", "EDAD", "EDAD\taño,,vejez"]),
        (
            lambda path: Agreement.load(path.parent),
            [
                "DAR\tdar\tgives\t-",
                "DAR\tdar\tdative\tCABEZA",
                "DOLER\tdoler\tbody\t-",
                "DAR\tdar\tdative\t-\nDAR\tdar\tdative\t-",
            ],
        ),
        (Expressions.load, ["km\tlength\tkilómetros", "KM\tword\tkilómetros", "km,\tword\tkilómetros"]),
        (read_synonyms, ["COCHE", "COCHE, AUTO\nAUTO, CARRO", "COCHE, el auto", "COCHE, "]),
        (
            read_paraphrases,
            ["CAJERO\tcajero", "CAJERO\tCAJERO DINERO", "CAJERO\tDINERO\nCAJERO\tDINERO", "CAJERO"],
        ),
        (read_incorporated, ["MES\tDOS\tDOS_MESES", "mes\t2\tDOS_MESES", "MES\t2\tA\nMES\t2\tB"]),
        (read_senses, ["CUARTO\tBAÑO", "cuarto\tBAÑO\tbaño", "CUARTO\t-\t(de"]),
        (Conjugations, ["amar\to as a\tam", "amar\to as"]),
        (read_signs, ["HOLA ADIÓS", "A-N-A", "12"]),
    ],
)
def test_a_damaged_list_is_refused_with_file_and_line(
    tmp_path: Path, read: Callable[[Path], object], lines: list[str]
) -> None:
    path = tmp_path / "agreement.tsv"
    for line in (*lines, b"\xff\xfe"):
        path.write_bytes(line if isinstance(line, bytes) else line.encode())
        with refused("invalid_data", r"agreement\.tsv") as error:
            read(path)
        assert isinstance(line, bytes) or ", line " in str(error.value)


@pytest.mark.parametrize(
    "content", ["", "[]", '{"gloss": "A"}', '{"gloss": "A", "kind": "lexical", "provenance": 1}', None]
)
def test_a_damaged_table_of_signs_is_refused_by_file(tmp_path: Path, content: str | None) -> None:
    if content is not None:
        (tmp_path / "A.json").write_text(content, encoding="utf-8")
    with refused("invalid_data", "got none" if content is None else r"A\.json"):
        read_signs(tmp_path)
