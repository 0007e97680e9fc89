# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import zipfile
from pathlib import Path
from typing import Any

import pytest
from refusals import refused

from teo_sign_training.cli.build_morphology import Forms, correct, paradigm_lines, read_package
from teo_sign_translator.morphology.conjugation import Conjugations
from teo_sign_translator.morphology.readings import VERB_TAGS

FOLDER = "mlconjug3/data/conjug_manager/"


def six(*endings: str) -> list[list[Any]]:
    return [[number, ending] for number, ending in enumerate(endings)]


def template(of_first_person: str = "o", pronoun: str = "") -> dict[str, Any]:
    """The endings of -ar verbs as the package writes them; with a pronoun, those of a reflexive verb."""
    return {
        "Infinitivo": {"Infinitivo": [[0, "ar" + pronoun], [1, "ado"]]},
        "Gerundio": {"Gerundio": [[0, "ándose" if pronoun else "ando"], [1, "ado"]]},
        "Participo": {"Participo": [[0, "adjective"]]},
        "Condicional": {"Condicional": six("aría", "arías", "aría", "aríamos", "aríais", "arían")},
        "Imperativo": {"Imperativo": six("a", "e", "emos", "ad", "en")},
        "Indicativo": {
            "Indicativo presente": six(of_first_person, "as", "a", "amos", "áis", "an"),
            "Indicativo pretérito imperfecto": six("aba", "abas", "aba", "ábamos", "abais", "aban"),
            "Indicativo pretérito perfecto simple": six("é", "aste", "ó", "amos", "asteis", "aron"),
            "Indicativo futuro": six("aré", "arás", "ará", "aremos", "aréis", "arán"),
        },
        "Subjuntivo": {
            "Subjuntivo presente": six("e", "es", "e", "emos", "éis", "en"),
            "Subjuntivo pretérito imperfecto (1)": six("ara", "aras", "ara", "áramos", "arais", "aran"),
            "Subjuntivo pretérito imperfecto (2)": six("ase", "ases", "ase", "ásemos", "aseis", "asen"),
        },
    }


def package(folder: Path) -> Path:
    """A package like mlconjug3 with a regular, a reflexive, an empty and a broken verb."""
    path = folder / "mlconjug3.whl"
    templates = {"ar": template(), "arse": template(pronoun="se"), "empty": template(""), "broken": {}}
    verbs = {
        "cantar": {"root": "cant", "template": "ar"},
        "quejarse": {"root": "quej", "template": "arse"},
        "cantarse": {"root": "cant", "template": "arse"},
        "pasar": {"root": "pas", "template": "empty"},
        "abolir": {"root": "abol", "template": "broken"},
    }
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(FOLDER + "conjugation-es.json", json.dumps(templates))
        archive.writestr(FOLDER + "verbs-es.json", json.dumps(verbs))
    return path


def test_verbs_with_all_forms_are_read_and_the_others_left_out(tmp_path: Path) -> None:
    verbs = read_package(package(tmp_path))
    assert set(verbs) == {"cantar", "quejar"}
    assert all(set(forms) == set(VERB_TAGS) for forms in verbs.values())
    assert verbs["cantar"]["V:part:fs"] == ("cantada",)
    assert verbs["cantar"]["V:sub:impf:1p"] == ("cantáramos", "cantásemos")


def test_a_reflexive_verb_loses_its_pronoun(tmp_path: Path) -> None:
    forms = read_package(package(tmp_path))["quejar"]
    assert forms["V:inf"] == ("quejar",)
    assert forms["V:ger"] == ("quejando",)
    imperative = " ".join(forms[f"V:imp:{person}"][0] for person in ("2s", "3s", "1p", "2p", "3p"))
    assert imperative == "queja queje quejemos quejad quejen"


def test_the_file_gives_back_what_was_written(tmp_path: Path) -> None:
    verbs = read_package(package(tmp_path))
    path = tmp_path / "conjugations.tsv"
    path.write_text("\n".join(paradigm_lines(verbs)) + "\n", encoding="utf-8")
    read = Conjugations(path)
    for verb, forms in verbs.items():
        assert {tag: read.forms(verb, tag) for tag in VERB_TAGS} == forms


@pytest.mark.parametrize("content", [b"", b"not a wheel", b"PK\x05\x06" + bytes(18)])
def test_another_file_than_the_package_is_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "other.whl"
    path.write_bytes(content)
    with refused("invalid_data", "expected the wheel of mlconjug3"):
        read_package(path)


def corrected(tmp_path: Path, line: str) -> dict[str, Forms]:
    path = tmp_path / "corrections.tsv"
    path.write_text(line + "\n", encoding="utf-8")
    verbs = read_package(package(tmp_path))
    correct(verbs, path)
    return verbs


def test_corrections_replace_a_form_or_a_whole_verb(tmp_path: Path) -> None:
    assert corrected(tmp_path, "cantar\tV:imp:2s\tcantá,canta")["cantar"]["V:imp:2s"] == ("cantá", "canta")
    assert corrected(tmp_path, "pasar\tlike\tcantar")["pasar"]["V:ind:pret:3s"] == ("pasó",)


@pytest.mark.parametrize("line", ["cantar\tV:nope\tx", "pasar\tV:inf\tpasar", "pasar\tlike\tpesar"])
def test_a_correction_of_nothing_known_is_refused_with_its_place(line: str, tmp_path: Path) -> None:
    with refused("invalid_data", "line 1: expected"):
        corrected(tmp_path, line)
