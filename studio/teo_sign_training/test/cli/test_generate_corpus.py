# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_languages import LanguageError
from teo_sign_training.cli.generate_corpus import FILE_NAME, run
from teo_sign_training.corpus import read_pairs


def test_the_command_writes_a_corpus_without_the_sentences_of_a_test(tmp_path, capsys):
    run(out=tmp_path, pairs=300, seed=1)
    first = list(read_pairs(tmp_path / FILE_NAME))
    assert sum(pair.rule != "paper" for pair in first) == 300
    assert "templates" in capsys.readouterr().err
    unwanted = [pair.text for pair in first if pair.rule != "paper"][:100]
    (tmp_path / "test.txt").write_text("\n".join(unwanted).upper(), encoding="utf-8")
    run(out=tmp_path, pairs=300, seed=1, leave_out=[tmp_path / "test.txt"])
    second = {pair.text for pair in read_pairs(tmp_path / FILE_NAME)}
    assert not second & set(unwanted)


def test_the_grammar_does_not_contradict_the_papers_sentences(tmp_path):
    run(out=tmp_path, pairs=3000, seed=2)
    made = {}
    for pair in read_pairs(tmp_path / FILE_NAME):
        bare = pair.text.lower().strip("¿¡.?!…")
        assert made.setdefault(bare, pair.rule == "paper") == (pair.rule == "paper"), pair.text


def test_constructions_are_held_out_when_asked_alone(tmp_path):
    for asked, count in ((False, 0), (True, 6)):
        run(out=tmp_path, pairs=300, seed=1, hold_out_constructions=asked)
        splits = [pair.split for pair in read_pairs(tmp_path / FILE_NAME)]
        assert splits.count("test_constructions") == count


def test_a_corpus_is_made_for_the_language_that_is_asked_for(tmp_path):
    run(out=tmp_path, pairs=200, seed=1, language="ase")
    pairs = list(read_pairs(tmp_path / FILE_NAME))
    assert len(pairs) > 150
    assert all(pair.text.isascii() and pair.glosses for pair in pairs)
    assert any("WHERE" in pair.glosses for pair in pairs)


def test_a_language_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(LanguageError, match="ase") as refusal:
        run(out=tmp_path, pairs=200, language="xyz")
    assert refusal.value.code == "unknown_language"
