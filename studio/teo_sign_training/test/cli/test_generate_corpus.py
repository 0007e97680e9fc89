# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from teo_sign_training.cli.generate_corpus import FILE_NAME, run
from teo_sign_training.corpus import read_pairs
from teo_sign_translator.morphology.spanish import unaccented


def test_a_corpus_leaves_out_the_sentences_of_a_test_however_they_are_typed(tmp_path, capsys):
    run(out=tmp_path, pairs=100, seed=1)
    first = list(read_pairs(tmp_path / FILE_NAME))
    assert sum(pair.rule != "paper" for pair in first) == 100
    assert "templates" in capsys.readouterr().err
    unwanted = [pair.text for pair in first if pair.rule != "paper"]
    typed = (unaccented(sentence).upper().replace(" ", "  ").strip("¿¡.?!") for sentence in unwanted)
    (tmp_path / "test.txt").write_text("\n".join(typed), encoding="utf-8")
    run(out=tmp_path, pairs=100, seed=1, leave_out=[tmp_path / "test.txt"])
    second = {pair.text for pair in read_pairs(tmp_path / FILE_NAME)}
    assert not second & set(unwanted)


def test_the_grammar_does_not_contradict_the_papers_sentences(tmp_path):
    run(out=tmp_path, pairs=2000, seed=2)
    made = {}
    for pair in read_pairs(tmp_path / FILE_NAME):
        bare = pair.text.lower().strip("¿¡.?!…")
        assert made.setdefault(bare, pair.rule == "paper") == (pair.rule == "paper"), pair.text


def test_constructions_are_held_out_when_asked(tmp_path):
    run(out=tmp_path, pairs=150, seed=1, hold_out_constructions=True)
    splits = [pair.split for pair in read_pairs(tmp_path / FILE_NAME)]
    assert splits.count("test_constructions") == 3


def test_a_corpus_is_made_for_the_language_that_is_asked_for(tmp_path):
    run(out=tmp_path, pairs=200, seed=1, language="ase")
    pairs = list(read_pairs(tmp_path / FILE_NAME))
    assert len(pairs) > 150
    assert all(pair.text.isascii() and pair.glosses for pair in pairs)
    assert any("WHERE" in pair.glosses for pair in pairs)
