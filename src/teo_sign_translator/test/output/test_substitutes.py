# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is signed for a word without a sign, and the lists that say it."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.output.output_words import OutputWord, lexical
from teo_sign_translator.output.sign_choice import SignChooser
from teo_sign_translator.output.sign_coverage import read_signs
from teo_sign_translator.output.substitutes import (
    SubstituteLists,
    Substitutes,
    read_hypernyms,
    read_paraphrases,
)
from teo_sign_translator.output.translation import Origin

MORPHOLOGY = Morphology.load()
LISTS = SubstituteLists.load()
CHOOSER = SignChooser(LISTS, MORPHOLOGY)


def _chosen(gloss: str, *signs: str, general: bool = True) -> list[tuple[str, Origin]]:
    words: list[OutputWord] = [lexical(gloss, ("x",), 0.8)]
    return [(" ".join(w.signs), w.origin) for w in CHOOSER.choose(words, {*signs}, general=general)]


@pytest.mark.parametrize(
    ("gloss", "sign"),
    [("MEDICACIÓN", "MEDICINA"), ("CANSANCIO", "CANSADO"), ("OPERACIÓN", "OPERAR"), ("FREGAR", "FREGADO")],
)
def test_the_same_sign_by_another_name_comes_first(gloss: str, sign: str) -> None:
    assert _chosen(gloss, sign, "DINERO") == [(sign, Origin.SYNONYM)]


def test_then_a_paraphrase_if_all_its_parts_have_signs() -> None:
    assert _chosen("CAJERO", "DINERO", "MÁQUINA") == [
        ("DINERO", Origin.PARAPHRASE),
        ("MÁQUINA", Origin.PARAPHRASE),
    ]
    assert _chosen("CAJERO", "DINERO") == [("C A J E R O", Origin.SPELLED)]
    assert [gloss for gloss, _ in _chosen("PEDIATRA", "DOCTOR", "CRÍO")] == ["DOCTOR", "CRÍO"]  # by synonyms


def test_then_what_is_more_general_and_closest_where_it_may() -> None:
    assert _chosen("ROSA", "FLOR", "PLANTA") == [("FLOR", Origin.HYPERNYM)]
    assert _chosen("ROSA", "PLANTA") == [("PLANTA", Origin.HYPERNYM)]
    assert _chosen("ROSA", "FLOR", general=False) == [("R O S A", Origin.SPELLED)]
    assert _chosen("FLOR", "ROSA") == [("F L O R", Origin.SPELLED)]  # never downward


def test_two_words_never_become_the_same() -> None:
    words = [lexical("ROSA", ("rosa",), 0.8), lexical("TULIPÁN", ("tulipán",), 0.8)]
    chosen = CHOOSER.choose(words, {"FLOR"}, general=True)
    assert [word.signs[0] for word in chosen].count("FLOR") == 1


def test_a_name_is_never_replaced() -> None:
    rosa = lexical("ROSA", ("Rosa",), 0.8, is_name=True)
    assert CHOOSER.choose([rosa], {"FLOR"}, general=True)[0].signs == ("R", "O", "S", "A")


@pytest.mark.parametrize("allowed", list(Substitutes))
def test_each_step_can_be_switched_off(allowed: Substitutes) -> None:
    chooser = SignChooser(LISTS, MORPHOLOGY, allowed)
    signs = {"MEDICINA", "DINERO", "MÁQUINA", "FLOR"}
    glosses = ("MEDICACIÓN", "CAJERO", "ROSA")
    words = [lexical(gloss, (gloss,), 0.8) for gloss in glosses]
    origins = {word.origin for word in chooser.choose(words, signs, general=True)} - {Origin.SPELLED}
    steps = (Origin.SYNONYM, Origin.PARAPHRASE, Origin.HYPERNYM)
    assert origins == {*steps[: int(allowed)]}


def test_unknown_substitutes_are_refused_with_those_that_there_are() -> None:
    assert Substitutes.named("paraphrase") is Substitutes.PARAPHRASE
    with pytest.raises(TranslationError, match="none, synonym, paraphrase, hypernym") as error:
        Substitutes.named("all")
    assert error.value.code == "unknown_substitutes"


def test_the_lists_are_long_enough_to_matter_and_lead_nowhere_back() -> None:
    assert len(LISTS.synonyms) > 1000
    assert len(LISTS.paraphrases) > 200
    assert len(LISTS.hypernyms) > 500
    assert all(gloss not in above for gloss, above in LISTS.hypernyms.items())
    assert all(gloss not in others for gloss, others in LISTS.synonyms.items())


@pytest.mark.parametrize(
    ("reader", "content"),
    [
        (read_paraphrases, "CAJERO\tcajero"),
        (read_paraphrases, "CAJERO\tCAJERO DINERO"),
        (read_paraphrases, "CAJERO\tDINERO\nCAJERO\tDINERO"),
        (read_paraphrases, "CAJERO"),
        (read_hypernyms, "ROSA\tFLOR\nROSA\tPLANTA"),
        (read_hypernyms, "ROSA\tFLOR\nFLOR\tROSA"),
        (read_hypernyms, "ROSA\tROSA"),
        (read_hypernyms, "rosa\tFLOR"),
    ],
)
def test_damaged_lists_are_refused(tmp_path: Path, reader: Callable[[Path], object], content: str) -> None:
    path = tmp_path / "list.tsv"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(TranslationError, match=r"list\.tsv, line") as error:
        reader(path)
    assert error.value.code == "invalid_data"


def _entry(folder: Path, gloss: str, kind: str, standing: str) -> None:
    content = {"gloss": gloss, "kind": kind, "provenance": {"standing": standing}}
    (folder / f"{gloss}.json").write_text(json.dumps(content), encoding="utf-8")


def test_a_tables_folder_says_which_glosses_have_signs_by_their_standing(tmp_path: Path) -> None:
    _entry(tmp_path, "HOLA", "lexical", "recorded")
    _entry(tmp_path, "CASA", "lexical", "described")
    _entry(tmp_path, "TREN", "lexical", "sketched")
    _entry(tmp_path, "A", "letter", "recorded")
    assert read_signs(tmp_path) == {"HOLA", "CASA"}
    assert read_signs(tmp_path, "recorded") == {"HOLA"}
    assert read_signs(tmp_path, "sketched") == {"HOLA", "CASA", "TREN"}
    with pytest.raises(TranslationError, match="described"):
        read_signs(tmp_path, "good")


@pytest.mark.parametrize(
    "content", ["", "[]", '{"gloss": "A"}', '{"gloss": "A", "kind": "lexical", "provenance": 1}']
)
def test_a_damaged_entry_is_refused_by_its_name(tmp_path: Path, content: str) -> None:
    (tmp_path / "A.json").write_text(content, encoding="utf-8")
    with pytest.raises(TranslationError, match=r"A\.json") as error:
        read_signs(tmp_path)
    assert error.value.code == "invalid_data"


def test_a_folder_without_entries_is_refused(tmp_path: Path) -> None:
    with pytest.raises(TranslationError, match="got none"):
        read_signs(tmp_path)
