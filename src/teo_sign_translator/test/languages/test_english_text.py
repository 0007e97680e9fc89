# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""English is read by the code that reads Spanish, from its own data."""

from __future__ import annotations

import pytest
import simplemma
from hypothesis import given
from hypothesis import strategies as st

from teo_common.text_folding import fold
from teo_sign_languages import load_language
from teo_sign_training.corpus.phrases import LIMIT
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.morphology.suffixing import SuffixedForms
from teo_sign_translator.text.cleaning import clean
from teo_sign_translator.text.reading import SentenceType, is_negated, read, sentence_type
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.source_words import source_words

TEXT = load_language("ase").text
MORPHOLOGY = Morphology.load(TEXT)
RULES = TextRules.load(TEXT)


def forms(sentence: str) -> str:
    return " ".join(word.form for word in source_words(sentence, MORPHOLOGY) if not word.is_mark)


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("I don't know.", "i do not know"),
        ("I don’t know.", "i do not know"),
        ("dont know", "do not know"),
        ("I'm deaf, she isn't.", "i am deaf she is not"),
        ("We can't go; we won't.", "we can not go we will not"),
        ("I cannot go", "i can not go"),
        ("What's that?", "what is that"),
        ("Ana's book", "ana 's book"),
        ("Let's eat", "let us eat"),
    ],
)
def test_contractions_are_two_words(typed: str, words: str) -> None:
    assert forms(typed) == words


@pytest.mark.parametrize(
    ("typed", "value"),
    [
        ("zero", "0"),
        ("twelve", "12"),
        ("twenty-one", "21"),
        ("twenty one", "21"),
        ("ninety-nine", "99"),
        ("a hundred", "100"),
        ("one hundred and five", "105"),
        ("two hundred fifty", "250"),
        ("a thousand", "1000"),
        ("three thousand two hundred", "3200"),
        ("1,000", "1000"),
        ("3.5", "3,5"),
        ("15:30", "15:30"),
    ],
)
def test_numbers_are_one_word_in_digits(typed: str, value: str) -> None:
    assert forms(typed) == value


@given(st.integers(0, LIMIT - 1))
def test_numbers_in_words_are_read_as_the_same_number(value: int) -> None:
    words = fold(RULES.numbers.in_words(value)).split()
    assert RULES.numbers.read_words(words) == (value, len(words))


def test_an_article_is_no_number_and_a_date_has_its_month_first() -> None:
    assert forms("a book") == "a book"
    assert forms("on 12/25") == "on december 25"
    assert forms("the 2nd of May") == "the second of may"


@pytest.mark.parametrize(
    ("text", "kind", "negated"),
    [
        ("Where do you live?", SentenceType.WH_QUESTION, False),
        ("And you, what do you want?", SentenceType.WH_QUESTION, False),
        ("where is my book", SentenceType.WH_QUESTION, False),
        ("Do you like coffee?", SentenceType.YES_NO_QUESTION, False),
        ("Don't you know where he is?", SentenceType.YES_NO_QUESTION, True),
        ("I never smoke.", SentenceType.STATEMENT, True),
        ("I can't go.", SentenceType.STATEMENT, True),
        ("Nobody knows.", SentenceType.STATEMENT, True),
        ("When I was a child, I lived here.", SentenceType.STATEMENT, False),
        ("You like tea, no?", SentenceType.YES_NO_QUESTION, False),
        ("Don't touch it!", SentenceType.EXCLAMATION, True),
    ],
)
def test_kind_and_negation_come_from_marks_and_words(text: str, kind: SentenceType, negated: bool) -> None:
    clauses = read(clean(text).text, RULES).clauses
    assert (sentence_type(clauses, RULES), is_negated(clauses, RULES)) == (kind, negated)


@pytest.mark.parametrize(
    ("sentence", "word", "lemma", "tag"),
    [
        ("My name is Ana.", "Ana", "Ana", "NAME:f"),
        ("My name is Xylo.", "Xylo", "Xylo", "NAME"),
        ("I live in Boston.", "Boston", "Boston", "NAME:place"),
        ("Two children ran.", "children", "child", "N:p"),
        ("She goes home.", "goes", "go", "V:ind:pres:3s"),
        ("They stopped.", "stopped", "stop", "V:ind:pret"),
        ("I am writing.", "writing", "write", "V:ger"),
        ("It is bigger.", "bigger", "big", "A:comp"),
        ("See me.", "me", "me", "PRON:obj:1s"),
        ("Three blorps.", "blorps", "blorp", "N:p"),
    ],
)
def test_a_word_in_its_sentence_is_read(sentence: str, word: str, lemma: str, tag: str) -> None:
    (read_word,) = (each for each in source_words(sentence, MORPHOLOGY) if each.text == word)
    assert (read_word.readings[0].lemma, read_word.readings[0].tag) == (lemma, tag)


def test_forms_made_by_rule_are_those_of_a_dictionary_that_we_did_not_write() -> None:
    made = [entry.form for entry in SuffixedForms(TEXT).entries() if entry.form.tag.startswith(("N:", "V:"))]
    known = [form for form in made if form.written.islower() and form.written != form.lemma]
    wrong = [form for form in known if not simplemma.is_known(form.written, lang="en")]
    assert len(known) > 1000
    assert len(wrong) < 0.01 * len(known), wrong
