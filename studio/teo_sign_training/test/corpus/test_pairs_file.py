# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from teo_sign_training.corpus import SPLITS, Pair, read_pairs, write_pairs
from teo_sign_translator.errors import TranslationError

words = st.text(st.characters(categories=("L", "N")), min_size=1, max_size=8)


@st.composite
def some_pairs(draw):
    glosses = tuple(draw(st.lists(words, min_size=1, max_size=6)))
    places = st.lists(st.integers(0, 30), max_size=3).map(tuple)
    alignment = tuple(draw(places) for _ in glosses)
    return Pair(
        " ".join(draw(st.lists(words, min_size=1))),
        glosses,
        alignment,
        draw(words),
        draw(st.sampled_from(SPLITS)),
    )


@given(st.lists(some_pairs(), max_size=5))
def test_what_is_written_is_read_again(tmp_path_factory, pairs):
    path = tmp_path_factory.mktemp("corpus") / "pairs.tsv"
    write_pairs(path, pairs)
    assert list(read_pairs(path)) == pairs


@pytest.mark.parametrize(
    "line",
    [
        "Hola.\tHOLA\t0\tgreetings.phrase\ttrian",
        "Hola.\tHOLA\tx\tgreetings.phrase\ttrain",
        "Hola.\tHOLA\t0 1\tgreetings.phrase\ttrain",
        "Hola.\tHOLA ANA\t0\tgreetings.phrase\ttrain",
        "",
    ],
)
def test_a_line_that_is_no_pair_is_reported_with_its_number(tmp_path, line):
    path = tmp_path / "pairs.tsv"
    path.write_text(f"text\tglosses\talignment\trule\tsplit\n{line}\n", encoding="utf-8")
    with pytest.raises(TranslationError, match=r"pairs\.tsv, line 2"):
        list(read_pairs(path))


@pytest.mark.parametrize("content", [b"es\tlse\n", b"\xff\n", None])
def test_a_file_of_something_else_or_none_is_refused(tmp_path, content):
    path = tmp_path / "pairs.tsv"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(TranslationError, match=r"pairs\.tsv"):
        list(read_pairs(path))
