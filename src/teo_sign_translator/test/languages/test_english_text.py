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
from teo_sign_translator.pipeline.completeness import Completeness
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
        ("twenty-one", "21"),
        ("a hundred", "100"),
        ("one hundred and five", "105"),
        ("two hundred fifty", "250"),
        ("a thousand", "1000"),
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
    assert (read_word.readings[0].lemma, read_word.tag) == (lemma, tag)


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("I woke up at six.", "i|woke up|at|6"),
        ("She woke my little son up.", "she|woke up|my|little|son"),
        ("Turn it off, please.", "turn off|it|please"),
        # "on" governs what stands behind it
        ("Put the book on the table.", "put|the|book|on|the|table"),
        ("How much do two ice creams cost?", "how much|do|2|ice creams|cost"),
        ("I like that one, no one else does.", "i|like|that one|no one|else|does"),
        ("They live next door in New York.", "they|live|next door|in|new york"),
    ],
)
def test_words_that_the_lexicon_lists_together_are_one(typed: str, words: str) -> None:
    assert "|".join(word.form for word in source_words(typed, MORPHOLOGY) if not word.is_mark) == words


def test_a_verb_with_its_particle_is_inflected_as_the_verb_alone() -> None:
    assert MORPHOLOGY.inflect("wake_up", "V:ind:pret") == "woke up"
    assert MORPHOLOGY.inflect("put_on", "V:ger") == "putting on"


@pytest.mark.parametrize(
    ("sentence", "word", "tag", "may_be"),
    [
        ("The man who called is deaf.", "who", "PRON:rel", True),
        ("My uncle, who called, is deaf.", "who", "PRON:rel", True),
        ("Who called?", "who", "PRON:rel", False),
        ("Mom, who called?", "who", "PRON:rel", False),
        ("Do you know who called?", "who", "PRON:rel", False),
        ("I have already eaten.", "have", "AUX", True),
        ("Has your mother called?", "has", "AUX", True),
        ("They have put it there.", "have", "AUX", True),
        ("I have a broken chair.", "have", "AUX", False),
        ("We have to go.", "have", "AUX", False),
        # Verbs without a participle.
        ("What I have can wait.", "have", "AUX", False),
    ],
)
def test_what_a_clause_rules_out_is_no_reading(sentence: str, word: str, tag: str, may_be: bool) -> None:
    (read_word,) = (each for each in source_words(sentence, MORPHOLOGY) if each.form == word)
    assert (tag in {reading.tag for reading in read_word.readings}) == may_be


@pytest.mark.parametrize(
    ("sentence", "without"),
    [
        ("How much does it cost?", {"HOW_OLD", "DONT_KNOW", "NEVER"}),
        ("I never knew how old she was.", {"HOW_MUCH", "DONT_KNOW"}),
        ("I don't know.", {"HOW_OLD", "HOW_MUCH", "NEVER"}),
    ],
)
def test_a_gloss_that_no_word_says_is_told(sentence: str, without: set[str]) -> None:
    glosses = ["HOW_MUCH", "HOW_OLD", "DONT_KNOW", "NEVER", "THEY"]  # THEY may do what a passive tells
    words = source_words(sentence, MORPHOLOGY)
    assert set(Completeness.load(TEXT).without_words(words, glosses)) == without


def test_forms_made_by_rule_are_those_of_a_dictionary_that_we_did_not_write() -> None:
    made = [entry.form for entry in SuffixedForms(TEXT).entries() if entry.form.tag.startswith(("N:", "V:"))]
    known = [form for form in made if form.written.islower() and form.written != form.lemma]
    known = [form for form in known if " " not in form.written]
    wrong = [form for form in known if not simplemma.is_known(form.written, lang="en")]
    assert len(known) > 1000
    assert len(wrong) < 0.01 * len(known), wrong
