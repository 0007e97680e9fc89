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
)


def _word(gloss: str) -> OutputWord:
    return lexical(gloss, (gloss.lower(),), 1.0)


def _sentence(*words: OutputWord, dropped: tuple[str, ...] = ()) -> Sentence:
    chosen = SignChooser(_LISTS, None).choose(words, _SIGNS)
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
            _word("PEZ"),
            name,
            *number("352", ("352",), 1.0),
        )
    )
    assert [(word.gloss, word.signs, word.showing) for word in words] == [
        ("CASA", ("CASA",), Showing.SIGN),
        ("AUTO", ("COCHE",), Showing.SUBSTITUTE),
        ("CAJERO", ("DINERO", "MÁQUINA"), Showing.SUBSTITUTE),
        ("PEZ", ("P", "E", "Z"), Showing.LETTERS),
        ("ANA", ("A", "N", "A"), Showing.NAME),
        ("352", ("352",), Showing.NUMBER),
    ]


def test_words_sentences_and_wishes_are_counted() -> None:
    counted = Coverage()
    name = replace(_word("ANA"), is_name=True)
    sentences = (
        _sentence(_word("CAJERO"), _word("CASA"), dropped=("la", "de")),  # a paraphrase counts once
        _sentence(_word("CASA"), name, dropped=("la",)),
        _sentence(_word("MAR"), _word("PEZ")),
        _sentence(_word("MAR"), _word("PODER")),
    )
    for sentence in sentences:
        counted.add(_translation(sentence), frozenset({"PODER"}))
    assert (counted.words, counted.signed) == (8, 3)
    assert (counted.sentences, counted.whole) == (4, 2)  # a spelled name is no lack
    assert dict(counted.missing) == {"MAR": 2, "PEZ": 1}
    assert dict(counted.guessed) == {"PODER": 1}
    assert dict(counted.dropped) == {"la": 2, "de": 1}
    assert list(most_wanted(counted, 1)) == [("MAR", 2)]
    assert counted.examples["MAR"] == "mar pez"
