# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The word lists: that a linguist's slip is found before it reaches a signer."""

from __future__ import annotations

import re
from collections import Counter

import pytest
import simplemma
from refusals import refused

from teo_sign_translator.morphology import lexicon

SPANISH_WORD = re.compile("[a-záéíóúüñ]+|mp3")
SPANISH_NAME = re.compile("[A-ZÁÉÍÓÚÑ][a-záéíóúüñàèòçöüï]+")


@pytest.mark.parametrize("name", ["nouns", "adjectives", "adverbs", "verbs"])
def test_lists_are_spelled_in_spanish_and_without_duplicates(name: str) -> None:
    lemmas = [row.lemma for row in getattr(lexicon, name)()]
    assert [lemma for lemma in lemmas if not SPANISH_WORD.fullmatch(lemma)] == []
    assert [lemma for lemma, count in Counter(lemmas).items() if count > 1] == []


def test_names_are_capitalised_and_stand_once() -> None:
    assert [name for name in lexicon.names() if not SPANISH_NAME.fullmatch(name.name)] == []
    assert [name for name, count in Counter(lexicon.names()).items() if count > 1] == []


def test_simplemma_knows_nearly_every_word() -> None:
    """A word that a dictionary of 800,000 forms lacks is misspelled or very young; there are few of these."""
    words = [row.lemma for rows in (lexicon.nouns(), lexicon.adjectives(), lexicon.verbs()) for row in rows]
    unknown = [word for word in words if not simplemma.is_known(word, lang="es")]
    assert len(unknown) / len(words) < 0.02, unknown


def test_simplemma_leads_nearly_every_plural_to_its_noun() -> None:
    pairs = [
        (form.written, noun.lemma)
        for noun in lexicon.nouns()
        for form in lexicon.nominal_forms(noun)
        if form.tag in ("N:mp", "N:fp", "N:cp") and noun.gender in ("m", "f", "mf")
    ]
    agreed = sum(simplemma.lemmatize(written, lang="es") == lemma for written, lemma in pairs)
    assert agreed / len(pairs) > 0.93


WELL_KNOWN = """
    mano f body, día m time, problema m abstract, foto f object, agua f drink, mapa m object,
    estudiante mf person, profesor m+f profession, hermana f family, gafas fp object, leche f food,
    coche m vehicle, salud f abstract
"""


@pytest.mark.parametrize("row", WELL_KNOWN.split(","))
def test_well_known_nouns_have_their_gender_and_class(row: str) -> None:
    lemma, gender, kind = row.split()
    noun = next(noun for noun in lexicon.nouns() if noun.lemma == lemma)
    assert noun.gender == gender
    assert kind in noun.classes


@pytest.mark.parametrize(
    ("lemma", "forms"),
    [
        ("régimen", {"régimen", "regímenes"}),
        ("menú", {"menú", "menús"}),
        ("club", {"club", "clubes"}),
        ("alcalde", {"alcalde", "alcaldes", "alcaldesa", "alcaldesas"}),
        ("tijeras", {"tijeras"}),
        ("dentista", {"dentista", "dentistas"}),
    ],
)
def test_irregular_nouns_have_their_forms(lemma: str, forms: set[str]) -> None:
    noun = next(noun for noun in lexicon.nouns() if noun.lemma == lemma)
    assert {form.written for form in lexicon.nominal_forms(noun)} == forms


@pytest.mark.parametrize(
    ("name", "row"),
    [
        ("nouns", "mesa\tx\tfurniture\t-"),
        ("nouns", "mesa\tf\tfurnitur\t-"),
        ("adjectives", "alto\tm+f\tperson\tnever\t-"),
        ("adverbs", "ayer\tyesterday"),
        ("verbs", "comer\tperhaps"),
        ("names", "Ana\tw"),
        ("nouns", "mesa\tf"),
    ],
)
def test_a_slip_in_a_list_is_refused_with_its_place(
    name: str, row: str, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path_factory.mktemp("lexicon") / f"{name}.tsv"
    path.write_text("# header\n" + row + "\n", encoding="utf-8")
    monkeypatch.setattr(lexicon, "data_file", lambda _: path)
    with refused("invalid_data", "line 2: expected"):
        getattr(lexicon, name).__wrapped__()
