# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the shipped model of ASL must do whatever it has learned, through the same pipeline as Spanish."""

from __future__ import annotations

from pathlib import Path

import pytest
from refusals import refused

from teo_sign_languages import load_language
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.output.sign_coverage import read_signs
from teo_sign_translator.output.translation import Kind
from teo_sign_translator.pipeline.completeness import Completeness
from teo_sign_translator.pipeline.translator import Translator
from teo_sign_translator.text.reading import SentenceType
from teo_sign_translator.text.source_words import source_words

ASE = load_language("ase")


@pytest.fixture(scope="module")
def translator() -> Translator:
    return Translator.load(language="ase")


@pytest.mark.parametrize(
    ("text", "glosses"),
    [
        # Order and courtesies as W. Vicars publishes them, lifeprint.com, lessons 1 to 3.
        ("How are you?", "HOW YOU"),
        ("Nice to meet you.", "NICE MEET YOU"),
        ("Is your house big?", "YOUR HOUSE BIG"),
        # Names and unknown words
        ("My name is Ana.", "MY NAME A-N-A"),
        ("My name is Guillermo.", "MY NAME G-U-I-L-L-E-R-M-O"),
        ("I like blorps.", "ME LIKE BLORP"),
        # Numbers, contractions, questions, negation, time
        ("I have twenty-one books.", "ME HAVE 21 BOOK"),
        ("I don't know.", "ME DONT_KNOW"),
        ("I can't go.", "ME CANT GO"),
        ("Where do you live?", "YOU LIVE WHERE"),
        ("What is your name?", "YOUR NAME WHAT"),
        ("Do you like coffee?", "YOU LIKE COFFEE"),
        ("I'm not hungry.", "ME NOT HUNGRY"),
        ("Yesterday I went to school.", "YESTERDAY ME GO SCHOOL"),
        ("I went to school yesterday.", "YESTERDAY ME GO SCHOOL"),
        ("If it rains, I will stay home.", "IF RAIN ME WILL STAY HOME"),
        # What "it" is for is pointed at or left out; what is said twice is done once
        ("I bought it yesterday.", "YESTERDAY ME BUY"),
        ("Is it raining?", "RAIN"),
        ("What is it?", "WHAT"),
        ("Have you finished your soup yet?", "YOU FINISH YOUR SOUP"),
        ("How long has a teacher been eating here?", "TEACHER EAT HERE HOW_LONG"),
        # As people type
        ("where do u live", "YOU LIVE WHERE"),
        ("I DON'T KNOW!!!", "ME DONT_KNOW"),
        ("i dont know 😀", "ME DONT_KNOW"),
    ],
)
def test_a_sentence_is_signed(translator: Translator, text: str, glosses: str) -> None:
    assert str(translator.translate(text)) == glosses


def test_a_word_without_a_sign_is_spelled_in_letters_of_the_language(translator: Translator) -> None:
    signs = read_signs(ASE.table("teo"))
    sentence = translator.translate("My friend has a blorpll.", signs).sentences[0]
    spelled = [token.gloss for token in sentence.tokens if token.kind is Kind.LETTER]
    assert spelled == list("BLORPLL")
    assert {token.gloss for token in sentence.tokens if token.kind is Kind.LEXICAL} <= signs


def test_a_sentence_has_its_kind_and_negation(translator: Translator) -> None:
    sentences = translator.translate("Are you deaf? Where is she? I don't know!").sentences
    assert [(sentence.type, sentence.negated) for sentence in sentences] == [
        (SentenceType.YES_NO_QUESTION, False),
        (SentenceType.WH_QUESTION, False),
        (SentenceType.EXCLAMATION, True),
    ]


def test_no_gloss_comes_from_nowhere(translator: Translator) -> None:
    """What no word says may be the opposite of what was typed."""
    completeness, morphology = Completeness.load(ASE.text), Morphology.load(ASE.text)
    folder = Path(__file__).parents[4] / "test" / "data" / "ase"
    sentences = [
        line
        for name in ("known.txt", "published.txt")
        for line in (folder / name).read_text(encoding="utf-8").splitlines()
    ]
    for sentence, answer in zip(sentences, translator.translate_all(sentences), strict=True):
        words = source_words(sentence, morphology)
        said = [gloss for gloss in str(answer).split() if gloss.isupper()]
        names = {word.text.upper() for word in words}
        lexical = [gloss for gloss in said if gloss.replace("-", "") not in names]
        assert completeness.without_words(words, lexical) == [], (sentence, said)


def test_a_text_in_other_letters_is_refused_in_the_name_of_the_language(translator: Translator) -> None:
    with refused("unsignable_text", "ASL"):
        translator.translate("Привет")
