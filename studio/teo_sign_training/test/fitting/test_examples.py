# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_common.text_folding import folded, without_accents
from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.paper_pairs import (
    Reader,
    memorised_pairs,
    own_pairs,
    paper_pairs,
    training_pairs,
    written_pairs,
)
from teo_sign_training.fitting.batches import WordNumbers, batches
from teo_sign_training.fitting.examples import (
    ExampleReader,
    Examples,
    Typing,
    WordTable,
    typed,
    typed_sayably,
    unsayable,
)
from teo_sign_training.fitting.fitting import make_vocabulary
from teo_sign_translator.morphology import Morphology, gloss_name
from teo_sign_translator.pointer.config import POINTER
from teo_sign_translator.pointer.decoding import load_sentence_model
from teo_sign_translator.pointer.vocabulary import UNKNOWN_TAG, copied_gloss
from teo_sign_translator.text.source_words import source_words

PAIRS = (
    Pair("¿Cómo está María?", ("MARÍA", "CÓMO"), ((2,), (0,)), "paper", "train"),
    Pair(
        "Mañana, él comerá pan.", ("MAÑANA", "ÉL", "PAN", "COMER"), ((0,), (2,), (4,), (3,)), "paper", "train"
    ),
    Pair("No.", ("NO",), ((0,),), "paper", "train"),
    Pair("¡Qué bien!", ("BIEN", "QUÉ"), ((1,), (0,)), "paper", "train"),
    Pair("Luis, ven.", ("LUIS", "VENIR"), ((0,), (2,)), "paper", "train"),
)


@cache
def read() -> Reader:
    return partial(source_words, morphology=Morphology.load())


@cache
def examples() -> tuple[Examples, WordTable]:
    reader = ExampleReader(read())
    return reader.examples(PAIRS), reader.table()


def _sentences(pairs: Examples, table: WordTable) -> list[list[str]]:
    result = []
    for place in range(len(pairs)):
        words = [
            table.words[row] for row in pairs.words[pairs.word_start[place] : pairs.word_start[place + 1]]
        ]
        result.append([word.form for word in words if word is not None])
    return result


def _numbers(pairs: Examples) -> list[tuple[list[int], list[int], list[tuple[int, int]]]]:
    """Of each pair its words, its glosses, and which gloss goes with which word."""
    return [
        (
            pairs.words[word : pairs.word_start[place + 1]].tolist(),
            pairs.glosses[gloss : pairs.gloss_start[place + 1]].tolist(),
            [
                (pairs.link_gloss[link] - gloss, pairs.link_word[link] - word)
                for link in range(pairs.link_start[place], pairs.link_start[place + 1])
            ],
        )
        for place, (word, gloss) in enumerate(zip(pairs.word_start[:-1], pairs.gloss_start[:-1], strict=True))
    ]


def _typing(variant: int = 0, final: bool = False, marks: bool = False) -> Typing:
    count = len(PAIRS)
    return Typing(np.full(count, variant), np.full(count, final), np.full(count, marks))


def test_pairs_typed_as_written_are_what_was_read() -> None:
    pairs, table = examples()
    assert _sentences(pairs, table) == [[word.form for word in read()(pair.text)] for pair in PAIRS]
    written = typed(pairs, table, Typing.draw(len(PAIRS), 1.0, np.random.default_rng(0)))
    for name in ("words", "word_start", "glosses", "link_gloss", "link_word"):
        np.testing.assert_array_equal(getattr(written, name), getattr(pairs, name))


@pytest.mark.parametrize(
    ("typing", "typist"),
    [
        (_typing(variant=1), without_accents),
        (_typing(variant=2), str.lower),
        (_typing(variant=3), lambda sentence: without_accents(sentence).lower()),
        (_typing(final=True), lambda sentence: sentence.rstrip(".?!")),
        (_typing(marks=True), lambda sentence: "".join(c for c in sentence if c not in "¿?¡!.,")),
    ],
)
def test_typing_noise_gives_the_words_that_the_typed_sentence_would(typing: Typing, typist: object) -> None:
    assert callable(typist)
    pairs, table = examples()
    noisy = typed(pairs, table, typing)
    expected = [read()(typist(pair.text)) for pair in PAIRS]
    assert _sentences(noisy, table) == [[word.form for word in words] for words in expected]
    got = [table.words[row] for row in noisy.words]
    # A name that opens the sentence keeps its reading as a name; the readings are the same as well.
    readings = [{reading.lemma for reading in word.readings} for word in got if word is not None]
    assert readings == [{r.lemma for r in word.readings} for words in expected for word in words]


def test_the_alignment_follows_the_words_when_marks_are_left_out() -> None:
    pairs, table = examples()
    noisy = typed(pairs, table, _typing(variant=3, marks=True))
    for examined in (pairs, noisy):
        linked = [table.words[row] for row in examined.words[examined.link_word]]
        forms = [word.form for word in linked if word is not None]
        said = " ".join(without_accents(form) for form in forms)
        assert said.replace("ñ", "n") == "maria como manana el pan comera no bien que luis ven"


def test_a_gloss_that_needs_its_accent_keeps_it() -> None:
    pairs, table = examples()
    closed = np.zeros(len(table.glosses), np.bool_)
    for variant in range(4):
        noisy = typed_sayably(pairs, table, _typing(variant=variant, marks=True), closed, copy=True)
        lost = unsayable(noisy, table, closed, copy=True)
        np.testing.assert_array_equal(lost, unsayable(pairs, table, closed, copy=True))


def test_drawn_ways_of_typing_are_of_every_kind_and_leave_the_rest_clean() -> None:
    typing = Typing.draw(4000, 0.5, np.random.default_rng(1))
    untouched = (typing.variant == 0) & ~typing.drop_final & ~typing.drop_marks
    assert 0.5 < untouched.mean() < 0.6
    assert set(typing.variant) == {0, 1, 2, 3}
    assert not (typing.drop_final & typing.drop_marks).any()
    assert Typing.draw(100, 1.0, np.random.default_rng(1)).variant.max() == 0


@given(st.lists(st.integers(0, 4), max_size=12))
@settings(max_examples=60, deadline=None)
def test_taken_pairs_are_the_pairs(places: list[int]) -> None:
    pairs, _ = examples()
    all_of_them = _numbers(pairs)
    assert _numbers(pairs.take(np.array(places, np.int64))) == [all_of_them[place] for place in places]


@pytest.mark.parametrize("known", [lambda: memorised_pairs(read()), lambda: [*own_pairs(Morphology.load())]])
def test_each_pair_of_the_paper_and_the_project_is_known_by_heart_and_in_the_corpus(
    known: Callable[[], Sequence[Pair]],
) -> None:
    pairs = known()
    assert {pair.sentence for pair in training_pairs() if "{" not in pair.sentence} <= {
        pair.text for pair in pairs
    }
    taught = {(pair.text, pair.glosses) for pair in pairs}
    for pair in paper_pairs():
        glosses = tuple("7" if gloss == "X" else gloss_name(gloss) for gloss in pair.glosses)
        assert (pair.sentence.replace(" X ", " 7 "), glosses) in taught
    assert ("Me llamo Lucía", ("MI", "NOMBRE", "LUCÍA")) in taught
    for each in pairs:
        assert len(each.alignment) == len(each.glosses)


def test_no_sentence_is_known_by_heart_in_two_ways() -> None:
    known = {(folded(pair.text), pair.glosses) for pair in memorised_pairs(read())}
    assert len({sentence for sentence, _ in known}) == len(known)


def test_hidden_nouns_may_be_words_of_which_nothing_is_known() -> None:
    pairs, table = examples()
    vocabulary = make_vocabulary(pairs, table, 0, copy=True)
    numbers = WordNumbers.of(table, vocabulary, pairs)
    unknown = vocabulary.tag_index[UNKNOWN_TAG]
    tags = [
        tag
        for seed in range(200)
        for batch in batches(pairs, table, numbers, 8, random=np.random.default_rng(seed), rare_word=1e9)
        for tag in batch.tags[..., 0].ravel().tolist()
    ]
    assert tags.count(unknown) == pytest.approx(100, abs=40)  # "pan" alone: half of 200 times


def test_no_sentence_is_written_twice_and_every_gloss_of_a_written_pair_is_said_by_a_word_or_taught() -> None:
    """Else its pair would teach nothing: training leaves it out without a word."""
    pairs = written_pairs(read())
    assert len({folded(pair.text) for pair in pairs}) == len(pairs) > 1000
    taught = frozenset(load_sentence_model(POINTER).arrays.vocabulary.glosses)
    for pair in pairs:
        words = read()(pair.text)
        for gloss, places in zip(pair.glosses, pair.alignment, strict=True):
            copies = {copied_gloss(reading) for place in places for reading in words[place].readings}
            assert gloss in copies | taught, pair
