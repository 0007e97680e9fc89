# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sign, or which letters, a gloss is shown by."""

from __future__ import annotations

from pathlib import Path

import pytest
from word_by_word_model import MORPHOLOGY

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.output.output_words import OutputWord, lexical
from teo_sign_translator.output.sign_choice import SignChooser
from teo_sign_translator.output.sign_coverage import read_signs
from teo_sign_translator.output.substitutes import SubstituteLists, read_synonyms
from teo_sign_translator.output.translation import Kind, Origin

CHOOSER = SignChooser(SubstituteLists.load(), MORPHOLOGY)


def _output_word(gloss: str) -> OutputWord:
    return OutputWord(signs=(gloss,), kind=Kind.LEXICAL, confidence=0.8, words=("x",), origin=Origin.MODEL)


def _chosen(output_word: OutputWord, *signs: str) -> list[tuple[str, Origin]]:
    return [(" ".join(d.signs), d.origin) for d in CHOOSER.choose([output_word], set(signs))]


def test_a_gloss_with_a_sign_keeps_it() -> None:
    assert _chosen(_output_word("AMIGA"), "AMIGA", "AMIGO") == [("AMIGA", Origin.MODEL)]


def test_else_the_sign_of_its_lemma_is_taken() -> None:
    assert _chosen(_output_word("AMIGA"), "AMIGO") == [("AMIGO", Origin.LEMMA)]


def test_else_that_of_a_word_that_means_the_same() -> None:
    assert _chosen(_output_word("AUTO"), "COCHE") == [("COCHE", Origin.SYNONYM)]
    assert _chosen(_output_word("COCHE"), "AUTO") == [("AUTO", Origin.SYNONYM)]


def test_else_it_is_spelled() -> None:
    assert _chosen(_output_word("LÁPIZ"), "COCHE") == [("L A P I Z", Origin.SPELLED)]


def test_a_gloss_of_several_words_is_shown_word_by_word() -> None:
    assert _chosen(_output_word("POR_FAVOR"), "POR") == [("POR", Origin.MODEL), ("F A V O R", Origin.SPELLED)]


def test_a_name_is_spelled_unless_it_has_a_sign_of_its_own() -> None:
    ana = lexical("ANA", ("Ana",), 0.8, is_name=True)
    assert _chosen(ana, "HOLA") == [("A N A", Origin.SPELLED)]
    assert _chosen(ana, "ANA") == [("ANA", Origin.MODEL)]
    assert [output_word.signs for output_word in CHOOSER.choose([ana], None)] == [("A", "N", "A")]


def test_without_an_inventory_every_possible_sign_is_kept() -> None:
    assert CHOOSER.choose([_output_word("LÁPIZ")], None) == [_output_word("LÁPIZ")]
    (odd,) = CHOOSER.choose([_output_word("ŁÓDŹ")], None)
    assert odd.signs == ("L", "O", "D", "Z")
    (long,) = CHOOSER.choose([_output_word("A" * 65)], None)
    assert long.kind is Kind.LETTER


def test_letters_share_the_confidence_and_the_words_of_their_gloss() -> None:
    (output_word,) = CHOOSER.choose([_output_word("LÁPIZ")], set())
    assert (output_word.confidence, output_word.words) == (0.8, ("x",))


def test_a_file_of_signs_holds_one_gloss_a_line(tmp_path: Path) -> None:
    path = tmp_path / "signs.txt"
    path.write_text("# comment\nHOLA\n\nniño\n", encoding="utf-8")
    assert read_signs(path) == {"HOLA", "NIÑO"}


@pytest.mark.parametrize("content", [b"HOLA ADI\xc3\x93S", b"A-N-A", b"\xff", b"12"])
def test_a_damaged_file_of_signs_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "signs.txt"
    path.write_bytes(content)
    with pytest.raises(TranslationError, match=r"signs\.txt") as error:
        read_signs(path)
    assert error.value.code == "invalid_data"


@pytest.mark.parametrize("line", ["COCHE", "COCHE, AUTO\nAUTO, CARRO", "COCHE, el auto", "COCHE, "])
def test_a_damaged_list_of_synonyms_is_refused_with_file_and_line(tmp_path: Path, line: str) -> None:
    path = tmp_path / "synonyms.tsv"
    path.write_text(line, encoding="utf-8")
    with pytest.raises(TranslationError, match=r"synonyms\.tsv, line") as error:
        read_synonyms(path)
    assert error.value.code == "invalid_data"
