# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What of a text has signs, counted by hand."""

from __future__ import annotations

from dataclasses import replace

from teo_sign_translator.output.output_words import OutputWord, lexical, number, number_tokens
from teo_sign_translator.output.sign_choice import SignChooser
from teo_sign_translator.output.sign_coverage import Coverage, Showing, most_wanted, shown_words
from teo_sign_translator.output.substitutes import SubstituteLists
from teo_sign_translator.output.translation import Sentence, Translation
from teo_sign_translator.text.reading import SentenceType

_SIGNS = frozenset({"CASA", "DINERO", "MÁQUINA", "COCHE", "FLOR", "NO"})
_LISTS = SubstituteLists(
    synonyms={"AUTO": ("COCHE",), "COCHE": ("AUTO",)},
    paraphrases={"CAJERO": (("DINERO", "MÁQUINA"),)},
    hypernyms={"ROSA": ("FLOR",)},
)


def _word(gloss: str) -> OutputWord:
    return lexical(gloss, (gloss.lower(),), 1.0)


def _sentence(*words: OutputWord, dropped: tuple[str, ...] = ()) -> Sentence:
    chosen = SignChooser(_LISTS, None).choose(words, _SIGNS, general=True)
    return Sentence(
        text=" ".join(word.words[0] for word in words),
        type=SentenceType.STATEMENT,
        negated=False,
        tokens=number_tokens(chosen),
        uncertain=False,
        dropped=dropped,
    )


def _translation(*sentences: Sentence) -> Translation:
    return Translation(text="", sentences=sentences, ignored=(), model="none")


def test_a_word_is_shown_by_its_sign_another_a_number_or_letters() -> None:
    name = replace(_word("ANA"), is_name=True)
    words = shown_words(
        _sentence(
            _word("CASA"),
            _word("AUTO"),
            _word("CAJERO"),
            _word("ROSA"),
            _word("PEZ"),
            name,
            *number("352", ("352",), 1.0),
        )
    )
    assert [(word.gloss, word.signs, word.showing) for word in words] == [
        ("CASA", ("CASA",), Showing.SIGN),
        ("AUTO", ("COCHE",), Showing.SUBSTITUTE),
        ("CAJERO", ("DINERO", "MÁQUINA"), Showing.SUBSTITUTE),
        ("ROSA", ("FLOR",), Showing.SUBSTITUTE),
        ("PEZ", ("P", "E", "Z"), Showing.LETTERS),
        ("ANA", ("A", "N", "A"), Showing.NAME),
        ("352", ("352",), Showing.NUMBER),
    ]


def test_a_spelled_word_whose_sign_has_no_source_is_a_guess() -> None:
    (word,) = shown_words(_sentence(_word("PODER")), frozenset({"PODER"}))
    assert word.showing is Showing.GUESS


def test_a_paraphrase_of_a_word_that_has_no_sign_counts_once() -> None:
    counted = Coverage()
    counted.add(_translation(_sentence(_word("CAJERO"), _word("CASA"))))
    assert (counted.words, counted.signed, counted.whole) == (2, 2, 1)


def test_a_sentence_is_whole_with_a_spelled_name_and_not_with_a_spelled_word() -> None:
    name = replace(_word("ANA"), is_name=True)
    counted = Coverage()
    counted.add(_translation(_sentence(_word("CASA"), name), _sentence(_word("CASA"), _word("PEZ"))))
    assert (counted.sentences, counted.whole) == (2, 1)


def test_what_is_wanted_most_comes_first_with_its_first_sentence() -> None:
    counted = Coverage()
    for words in (("PEZ",), ("CASA", "MAR"), ("MAR", "NO")):
        counted.add(_translation(_sentence(*map(_word, words))))
    assert list(most_wanted(counted, 5)) == [("MAR", 2), ("PEZ", 1)]
    assert counted.examples["MAR"] == "casa mar"


def test_guesses_are_wanted_like_the_missing_and_told_apart() -> None:
    counted = Coverage()
    counted.add(_translation(_sentence(_word("PODER"), _word("PEZ"))), frozenset({"PODER"}))
    assert dict(counted.guessed) == {"PODER": 1}
    assert dict(counted.missing) == {"PEZ": 1}


def test_words_of_the_text_without_a_sign_are_counted() -> None:
    counted = Coverage()
    counted.add(
        _translation(_sentence(_word("CASA"), dropped=("la", "de")), _sentence(_word("NO"), dropped=("la",)))
    )
    assert dict(counted.dropped) == {"la": 2, "de": 1}
