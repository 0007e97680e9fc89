# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The word lists: that a linguist's slip is found before it reaches a signer."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
import simplemma
from loaded import TEXT
from refusals import refused

from teo_sign_translator.morphology import lexicon

SPANISH_WORD = re.compile("[a-záéíóúüñ]+|mp3")
SPANISH_NAME = re.compile("[A-ZÁÉÍÓÚÑ][a-záéíóúüñàèòçöüï]+")


LISTS = {
    "nouns": [noun.lemma for noun in lexicon.nouns(TEXT)],
    "adjectives": [adjective.lemma for adjective in lexicon.adjectives(TEXT)],
    "adverbs": [adverb.lemma for adverb in lexicon.adverbs(TEXT)],
    "verbs": lexicon.verbs(TEXT),
}


@pytest.mark.parametrize("name", LISTS)
def test_lists_are_spelled_in_spanish_and_without_duplicates(name: str) -> None:
    assert [lemma for lemma in LISTS[name] if not SPANISH_WORD.fullmatch(lemma)] == []
    assert [lemma for lemma, count in Counter(LISTS[name]).items() if count > 1] == []


def test_names_are_capitalised_and_stand_once() -> None:
    assert [name for name in lexicon.names(TEXT) if not SPANISH_NAME.fullmatch(name.name)] == []
    assert [name for name, count in Counter(lexicon.names(TEXT)).items() if count > 1] == []


def test_simplemma_knows_nearly_every_word() -> None:
    """A word that a dictionary of 800,000 forms lacks is misspelled or very young; there are few of these."""
    words = [word for name in ("nouns", "adjectives", "verbs") for word in LISTS[name]]
    unknown = [word for word in words if not simplemma.is_known(word, lang="es")]
    assert len(unknown) / len(words) < 0.02, unknown


def test_simplemma_leads_nearly_every_plural_to_its_noun() -> None:
    pairs = [
        (form.written, noun.lemma)
        for noun in lexicon.nouns(TEXT)
        for form in lexicon.nominal_forms(noun)
        if form.tag in ("N:mp", "N:fp", "N:cp") and noun.gender in ("m", "f", "mf")
    ]
    agreed = sum(simplemma.lemmatize(written, lang="es") == lemma for written, lemma in pairs)
    assert agreed / len(pairs) > 0.93


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
    noun = next(noun for noun in lexicon.nouns(TEXT) if noun.lemma == lemma)
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
def test_a_slip_in_a_list_is_refused_with_its_place(name: str, row: str, tmp_path: Path) -> None:
    path = tmp_path / "lexicon" / f"{name}.tsv"
    path.parent.mkdir()
    path.write_text("# header\n" + row + "\n", encoding="utf-8")
    with refused("invalid_data", "line 2: expected"):
        getattr(lexicon, name)(tmp_path)
