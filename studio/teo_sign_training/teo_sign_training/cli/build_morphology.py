# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`build_morphology`: conjugations out of the mlconjug3 package (MIT), as text/morphology/conjugations.tsv.

    pip download --no-deps mlconjug3==3.7.22
    ros2 run teo_sign_translator build_morphology mlconjug3-3.7.22-py3-none-any.whl

The package itself is only read, never run: it asks for scikit-learn, which nothing here needs.
"""

from __future__ import annotations

import json
import zipfile
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from teo_common.atomic_files import write_atomically
from teo_sign_translator.data_files import data_file, read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology.readings import IMPERATIVE_PERSONS, PERSONS, VERB_TAGS
from teo_sign_translator.morphology.spanish import unaccented

#: Forms of one verb by tag, the usual one first.
Forms = dict[str, tuple[str, ...]]

_FOLDER = "mlconjug3/data/conjug_manager/"
_TENSES = {
    "V:ind:pres": (("Indicativo", "Indicativo presente"),),
    "V:ind:impf": (("Indicativo", "Indicativo pretérito imperfecto"),),
    "V:ind:pret": (("Indicativo", "Indicativo pretérito perfecto simple"),),
    "V:ind:fut": (("Indicativo", "Indicativo futuro"),),
    "V:cond": (("Condicional", "Condicional"),),
    "V:sub:pres": (("Subjuntivo", "Subjuntivo presente"),),
    "V:sub:impf": (
        ("Subjuntivo", "Subjuntivo pretérito imperfecto (1)"),
        ("Subjuntivo", "Subjuntivo pretérito imperfecto (2)"),
    ),
    "V:imp": (("Imperativo", "Imperativo"),),
}
_HEADER = """\
# Conjugations, made by `ros2 run teo_sign_translator build_morphology` from mlconjug3 3.7.22 (MIT) and
# corrections.tsv, not by hand. One line a paradigm: the verb it is named after; the endings in the order
# of VERB_TAGS, "_" for an empty one, "," between equals; the stems of its verbs, "." for an empty one.
"""


def _conjugate(verb: Mapping[str, str], templates: Mapping[str, Any]) -> Forms | None:
    """All forms of a verb of the package; None where its template is empty (verbs of the weather)."""
    root, template = verb["root"], templates[verb["template"]]
    forms: Forms = {}
    try:
        forms["V:inf"] = (root + template["Infinitivo"]["Infinitivo"][0][1],)
        forms["V:ger"] = (root + template["Gerundio"]["Gerundio"][0][1],)
        # Of the compound gerund (habiendo comido): the table of participles has adjectives (despierto).
        participle = root + template["Gerundio"]["Gerundio"][1][1]
        for tense, places in _TENSES.items():
            persons = IMPERATIVE_PERSONS if tense == "V:imp" else PERSONS
            series = [dict(template[mood][name]) for mood, name in places]
            for number, person in enumerate(persons):
                forms[f"{tense}:{person}"] = tuple(root + endings[number] for endings in series)
    except KeyError:
        return None
    if forms["V:ind:pres:1s"] == (root,):
        return None
    for ending, form in (("o", "ms"), ("a", "fs"), ("os", "mp"), ("as", "fp")):
        forms[f"V:part:{form}"] = (participle[:-1] + ending,)
    return _without_pronoun(forms) if forms["V:inf"][0].endswith("se") else forms


def _without_pronoun(forms: Forms) -> Forms:
    """The forms of a verb that is only reflexive (`arrepentirse`), its pronouns taken off."""
    infinitive = forms["V:inf"][0].removesuffix("se")
    return {
        **forms,
        "V:inf": (infinitive,),
        "V:ger": (unaccented(forms["V:ger"][0].removesuffix("se")),),
        "V:imp:2s": forms["V:ind:pres:3s"],
        "V:imp:3s": forms["V:sub:pres:3s"],
        "V:imp:1p": forms["V:sub:pres:1p"],
        "V:imp:2p": (infinitive[:-1] + "d",),
        "V:imp:3p": forms["V:sub:pres:3p"],
    }


def paradigm_lines(verbs: Mapping[str, Forms]) -> list[str]:
    """The verbs as lines of the file, verbs of the same endings on one line."""
    paradigms: dict[tuple[str, ...], list[str]] = defaultdict(list)
    for _, forms in sorted(verbs.items()):
        stem = _common_start([form for every in forms.values() for form in every])
        endings = tuple(",".join(form[len(stem) :] or "_" for form in forms[tag]) for tag in VERB_TAGS)
        paradigms[endings].append(stem)
    lines = []
    for endings, stems in paradigms.items():
        name = stems[0] + endings[0].replace("_", "")
        lines.append("\t".join((name, " ".join(endings), " ".join(stem or "." for stem in stems))))
    return sorted(lines)


def _common_start(words: Sequence[str]) -> str:
    """The letters with which all words begin."""
    first, last = min(words), max(words)
    return next(
        (first[:index] for index, pair in enumerate(zip(first, last, strict=False)) if len(set(pair)) > 1),
        first,
    )


def read_package(wheel: Path) -> dict[str, Forms]:
    """All verbs of the package, by infinitive.

    Raises:
        TranslationError: "invalid_data" if the file is not the package.
    """
    try:
        with zipfile.ZipFile(wheel) as archive:
            templates = json.loads(archive.read(_FOLDER + "conjugation-es.json"))
            listed = json.loads(archive.read(_FOLDER + "verbs-es.json"))
    except (OSError, zipfile.BadZipFile, KeyError, ValueError) as error:
        raise TranslationError(
            "invalid_data", f"{wheel}: expected the wheel of mlconjug3 3.7.22: {error}"
        ) from error
    verbs: dict[str, Forms] = {}
    for _, verb in sorted(listed.items()):  # "acostar" comes before "acostarse", which it stands for
        forms = _conjugate(verb, templates)
        if forms:
            verbs.setdefault(forms["V:inf"][0], forms)
    return verbs


def correct(verbs: dict[str, Forms], path: Path) -> None:
    """Put the forms of corrections.tsv in the place of the package's.

    Raises:
        TranslationError: "invalid_data" if a line names an unknown tag, or a verb that is not there yet.
    """
    for number, (verb, what, forms) in read_rows(path, 3):
        if what == "like" and forms in verbs:
            verbs[verb] = conjugate_like(verb, verbs[forms])
        elif what in VERB_TAGS and verb in verbs:
            verbs[verb] = {**verbs[verb], what: tuple(forms.split(","))}
        else:
            raise TranslationError(
                "invalid_data",
                f"{path}, line {number}: expected a known verb with a tag, or a verb, like and a known verb, "
                f"got {verb}, {what}, {forms}",
            )


def conjugate_like(verb: str, model: Forms) -> Forms:
    """The forms of a verb that has the endings of another, as `parecer` those of `aparecer`."""
    other = model["V:inf"][0]
    shared = len(_common_start([verb[::-1], other[::-1]]))
    head = len(other) - shared
    return {tag: tuple(verb[:-shared] + form[head:] for form in every) for tag, every in model.items()}


def build(wheel: Annotated[Path, typer.Argument(help="The wheel of mlconjug3 3.7.22.")]) -> None:
    """Make text/morphology/conjugations.tsv anew."""
    try:
        verbs = read_package(wheel)
        correct(verbs, data_file("morphology/corrections.tsv"))
    except TranslationError as error:
        typer.echo(f"{error.code}: {error}", err=True)
        raise typer.Exit(1) from None
    lines = paradigm_lines(verbs)
    path = data_file("morphology/conjugations.tsv")
    write_atomically(path, (_HEADER + "\n".join(lines) + "\n").encode())
    typer.echo(f"{len(verbs)} verbs in {len(lines)} paradigms: {path}")


def main() -> None:
    """Entry point of `ros2 run teo_sign_translator build_morphology`."""
    typer.run(build)
