# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whatever is typed: an answer that loses no word, or a reason."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from loaded import translator
from word_by_word_model import translator_with

from teo_sign_training.lstm256.word_by_word import GlossList
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.output.output_words import Spelling
from teo_sign_translator.output.translation import Kind, Translation
from teo_sign_translator.pipeline.translator import MAX_SENTENCE_TOKENS, Translator
from teo_sign_translator.pointer import Hypothesis, OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.cleaning import clean
from teo_sign_translator.text.source_word import SourceWord


class WildModel:
    """Says anything: loses words, makes glosses up, doubles and shuffles them."""

    name = "wild"

    def translate_all(
        self, sentences: Sequence[Sequence[SourceWord]], *, beam: int = 1, unsaid: object = None
    ) -> tuple[tuple[Hypothesis, ...], ...]:
        del unsaid
        return tuple(tuple(self._any(words, seed) for seed in range(beam)) for words in sentences)

    def _any(self, words: Sequence[SourceWord], seed: int) -> Hypothesis:
        random = Random(f"{seed} {[word.text for word in words]}")
        glosses: list[OutputGloss] = []
        for _ in range(random.randrange(2 * len(words) + 1)):
            place = random.randrange(len(words))
            if random.random() < 0.3:
                glosses.append(OutputGloss(random.choice(["YO", "PASADO", "7"]), (), random.random(), False))
            elif not words[place].is_mark:
                gloss = copied_gloss(random.choice(words[place].readings))
                glosses.append(OutputGloss(gloss, (place,), random.random(), True))
        return Hypothesis(tuple(glosses), -float(seed))


@cache
def translating(name: str) -> Translator:
    return translator_with(WildModel()) if name == "wild" else translator(name)


ALL = pytest.mark.parametrize("name", ["pointer", "lstm256", "wild"])
REASONS = {
    "empty_text", "nothing_to_sign", "unsignable_text", "other_language", "broken_encoding", "text_too_long",
}  # fmt: skip
OTHERS = """
    Ana, Pedro, Guillermo, me, llamo, tengo, años, 7, 12, 3,5, 1.000, treinta, y, cinco, mil, X,
    que, tal, COVID-19, nº, 1º, 15:30, 25/12, EE. UU., xq, tb, holaaaa, km, 5 km, III, venga,
    levántate, colegio, quién, es, dame, eso, cuidado, romperse, zzz, ñandú, café
"""
TYPED = st.sampled_from(
    [*GlossList.load(), *(word.strip() for word in OTHERS.replace("\n", " ").split(", "))]
)
SEPARATORS = st.sampled_from(
    [" ", " ", " ", ", ", ". ", "? ", "! ", " ¿", " ¡", "… ", "\n", " - ", "; ", " 😀 ", '" ']
)


def _assert_well_formed(translation: Translation) -> None:
    for sentence in translation.sentences:
        assert 1 <= len(sentence.tokens) <= MAX_SENTENCE_TOKENS
        assert any(token.kind is not Kind.PAUSE for token in sentence.tokens)
        assert sentence.tokens[0].word_index == 0
        assert {b.word_index - a.word_index for a, b in pairwise(sentence.tokens)} <= {0, 1}
        for token in sentence.tokens:
            assert 0 <= token.confidence <= 1
            assert token.duration_scale > 0
            assert len(token.gloss) <= 64
            if token.kind is Kind.LETTER:
                assert token.gloss in Spelling.load().alphabet
            elif token.kind is Kind.NUMBER:
                assert re.fullmatch("[0-9]{1,6}", token.gloss)
            elif token.kind is Kind.PAUSE:
                assert token.gloss == ""
            else:
                assert re.fullmatch(r"[A-ZÁÉÍÓÚÜÑ_]+", token.gloss)


def _assert_no_word_is_lost(text: str, translation: Translation) -> None:
    words = [w for s in translation.sentences for token in s.tokens for w in token.source_words]
    sources = " ".join([*words, *(word for s in translation.sentences for word in s.dropped)])
    # An ordinal's mark belongs to its number: "1ºA" is the words 1º and A.
    for word in re.findall(r"[^\W\d_]+|[0-9]+", re.sub("([0-9])[ºª]", r"\1 ", text)):
        assert word in sources, f"{word!r} of {text!r} is in none of: {sources}"


LATIN = st.text(st.characters(max_codepoint=0x17F, exclude_categories=["Cs"]), min_size=1)


@ALL
@given(st.text() | LATIN)
@settings(max_examples=200)
def test_any_text_gives_an_answer_or_a_reason(name: str, text: str) -> None:
    try:
        translation = translating(name).translate(text)
    except TranslationError as error:
        assert error.code in REASONS
        assert str(error)
        return
    _assert_well_formed(translation)
    _assert_no_word_is_lost(clean(text).text, translation)


@ALL
@given(st.lists(st.tuples(TYPED, SEPARATORS), min_size=1, max_size=25))
@settings(max_examples=150)
def test_any_spanish_text_is_translated_and_no_word_is_lost(name: str, parts: list[tuple[str, str]]) -> None:
    text = "".join(word + separator for word, separator in parts)
    translation = translating(name).translate("Hola " + text)
    _assert_well_formed(translation)
    _assert_no_word_is_lost(text, translation)
