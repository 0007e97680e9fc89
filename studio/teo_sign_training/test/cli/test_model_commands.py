# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import random
from pathlib import Path

import pytest
import typer
from PIL import Image
from refusals import refused

from teo_sign_training.cli import compare, evaluate, train
from teo_sign_training.corpus import Pair, write_pairs
from teo_sign_training.corpus.pairs import corpus_hash, read_splits, sample, without
from teo_sign_training.fitting.metrics import score
from teo_sign_translator.model_files import read_card
from teo_sign_translator.pointer import load_sentence_model

SUBJECTS = ("Ana", "Pedro", "Lucía", "Carmen")
OBJECTS = ("pan", "libro", "coche", "vaso", "perro", "gato")
VERBS = {"come": "COMER", "compra": "COMPRAR", "quiere": "QUERER", "busca": "BUSCAR"}


@pytest.fixture(scope="module")
def corpus(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a small corpus file of all splits."""
    rng = random.Random(1)
    folder = tmp_path_factory.mktemp("corpus")
    pairs = []
    for number in range(260):
        subject, noun, verb = rng.choice(SUBJECTS), rng.choice(OBJECTS), rng.choice(list(VERBS))
        split = "train" if number < 200 else ("dev", "test_words", "test_both")[number % 3]
        glosses = (subject.upper(), noun.upper(), VERBS[verb])
        pairs.append(
            Pair(f"{subject} {verb} un {noun}.", glosses, ((0,), (3,), (1,)), "statement.thing", split)
        )
    write_pairs(folder / "pairs.tsv", pairs)
    return folder


def test_train_writes_a_model_that_says_what_made_it(
    corpus: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # One pass teaches nobody the paper's sentences: the gate says so.
    with pytest.raises(typer.Exit):
        train.run("pointer", corpus=corpus, out=tmp_path, seed=3, epochs=1, pairs=150)
    said = capsys.readouterr().err
    assert "ways of typing the paper's sentences come out wrong" in said
    assert "test_words:" in said
    assert load_sentence_model("pointer", tmp_path).name == "pointer"
    card = read_card("pointer", tmp_path)
    assert card["command"] == "ros2 run teo_sign_translator train pointer --epochs 1 --seed 3 --pairs 150"
    assert card["data"]["sha256"] == corpus_hash(corpus)
    data = card["data"]
    assert data["pairs"] + data["left_out"] == 150 + data["by_heart"] + data["written"]
    assert card["training"]["seed"] == 3
    assert card["made_by"]["torch"]
    assert card["made_by"]["commit"]
    assert set(card["result"]["scores"]) == {"dev", "test_words", "test_both"}
    assert [len(losses) for losses in card["result"]["losses"]] == [1, 1]  # of each of its networks
    assert "TÚ" in card["lexis"]["glosses"]  # which the paper's pairs say without a word


@pytest.mark.slow  # reads every written pair twice
def test_train_goes_on_from_a_model_and_says_so(tmp_path: Path, corpus: Path) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    train.run("gru", corpus=corpus, out=first, seed=3, epochs=1, pairs=60)
    train.run("gru", corpus=corpus, out=second, seed=4, epochs=1, pairs=60, start=first)
    before, after = (read_card("gru", folder) for folder in (first, second))
    assert after["lexis"] == before["lexis"]
    assert after["result"]["losses"][0][0] < before["result"]["losses"][0][0]
    assert after["command"].startswith(f"{before['command']}, then ros2 run")
    (first / "lstm.json").write_bytes((first / "gru.json").read_bytes())
    (first / "lstm.safetensors").write_bytes((first / "gru.safetensors").read_bytes())
    with refused("invalid_model", "to go on from"):
        train.run("lstm", corpus=corpus, out=second, seed=4, start=first)


def test_train_refuses_a_model_and_a_corpus_that_do_not_exist(tmp_path: Path, corpus: Path) -> None:
    with refused("unknown_model", "pointer"):
        train.run("transformer", corpus=corpus, out=tmp_path, seed=1)
    with refused("invalid_data", "generate_corpus"):
        train.run("gru", corpus=tmp_path, out=tmp_path, seed=1)


def test_the_zoo_is_compared_in_a_table_and_plots_and_evaluated(
    corpus: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    compare.run(
        corpus=corpus, out=tmp_path, model=["gru", "pointer"], pairs=150, epochs=2, seed=1, device="cpu"
    )
    assert "pointer" in capsys.readouterr().out
    rows = (tmp_path / "comparison.csv").read_text("utf-8").splitlines()
    assert [row.split(",")[0] for row in rows] == ["model", "gru", "pointer"]
    assert (tmp_path / "comparison.md").read_text("utf-8").count("|\n") == 4
    for name in ("loss.png", "exact.png"):
        with Image.open(tmp_path / name) as picture:
            assert picture.width > 600

    evaluate.run(
        "pointer", corpus, models=tmp_path, beam=2, pairs=10, seed=1, worst=3, out=tmp_path / "wrong.tsv"
    )
    said = capsys.readouterr().out
    for word in ("test_words", "statement", "BLEU"):
        assert word in said
    wrong = (tmp_path / "wrong.tsv").read_text("utf-8").splitlines()
    assert wrong[0].startswith("split\trule\ttext")
    with refused("invalid_data"):
        evaluate.run("pointer", corpus, models=tmp_path, split=["holdout"], beam=1, pairs=10, seed=1, worst=0)


def test_scores_are_those_of_sacrebleu_on_glosses() -> None:
    expected = [("YO", "PAN", "COMER", "NO"), ("TÚ", "CASA", "IR", "DÓNDE")]
    assert score(expected, expected).exact == 1
    assert score(expected, expected).bleu == pytest.approx(100)
    half = score(expected, [expected[0], ("TÚ", "CASA", "DÓNDE", "IR")])
    assert half.exact == 0.5
    # 1-grams 8/8, 2-grams 4/6, 3-grams 2/4, 4-grams 1/2, lengths equal.
    assert half.bleu == pytest.approx(100 * (1 * 4 / 6 * 2 / 4 * 1 / 2) ** 0.25, abs=0.01)
    assert score([], []).count == 0


def test_a_corpus_is_read_by_split_and_sampled_always_alike(corpus: Path) -> None:
    splits = read_splits(corpus)
    assert len(splits["train"]) == 200
    assert splits["test_templates"] == []
    assert sample(splits["train"], 10, 1) == sample(splits["train"], 10, 1) != sample(splits["train"], 10, 2)
    assert sample(splits["dev"], None, 1) == splits["dev"]
    first = splits["train"][0].text
    assert len(without(splits["train"], [first.lower().rstrip(".")])) == sum(
        pair.text != first for pair in splits["train"]
    )
