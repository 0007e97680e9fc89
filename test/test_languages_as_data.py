# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Code names no language and holds no word of one: languages are data. What is left is listed, with why."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache

from package_folders import FOLDERS

from teo_sign_languages import DEFAULT_LANGUAGE, load_language

TRANSLATOR = "teo_sign_translator/teo_sign_translator"
TRAINING = "teo_sign_training/teo_sign_training"
CAPTURE = "teo_sign_capture/teo_sign_capture"
AUTHORING = "teo_sign_authoring/teo_sign_authoring"

_INFLECTS = "inflects Spanish by rule; a language with morphology/suffixes.tsv has its own forms as data"
_PAPER = "the published model's sentences, which are Spanish"
LEFT = {
    f"{AUTHORING}/alphabet/demonstration.py": "the three signs of TEO's own public demonstration",
    f"{CAPTURE}/cli/import_pose.py": "the dictionary that is imported where none is named",
    f"{AUTHORING}/notation/score_file.py": "names of places of the body in forms of a sign",
    f"{TRAINING}/cli/build_morphology.py": _INFLECTS,
    f"{TRAINING}/cli/reproduce_paper.py": _PAPER,
    f"{TRAINING}/corpus/paper_pairs.py": _PAPER,
    f"{TRANSLATOR}/morphology/conjugation.py": _INFLECTS,
    f"{TRANSLATOR}/morphology/lexicon.py": _INFLECTS,
    f"{TRANSLATOR}/morphology/spanish.py": _INFLECTS,
    "teo_sign_languages/teo_sign_languages/language.py": "the language that is signed where none is named",
}

NAMES = re.compile(r"\b(Spanish|LSE|ssp|lse|castellano|español\w*|English|ASL|ase)\b")
# Shorter words stand in too many strings that are no words.
SHORTEST = 4
# Packages that know no language: what their docstrings say is English.
ENGLISH = (
    "teo_common",
    "teo_description",
    "teo_ros2cli",
    "teo_sim_driver",
    "teo_skeleton_retriever",
    "teo_synthetic_signer",
)
# English too, though those packages do not say them.
ALSO_ENGLISH = {"animal", "chat", "clip", "final", "formal", "general", "media"}


@cache
def modules() -> dict[str, tuple[list[str], list[str]]]:
    """Strings and docstrings of every module, by its path."""
    return {
        str(path.relative_to(folder.parent)): texts(ast.parse(path.read_text("utf-8")))
        for name, folder in FOLDERS.items()
        for path in sorted((folder / name).rglob("*.py"))
    }


def texts(tree: ast.Module) -> tuple[list[str], list[str]]:
    """The strings of a module that code uses, and those that stand for themselves: docstrings."""
    nodes = list(ast.walk(tree))
    alone = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    strings = [node for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str)]
    return (
        [str(node.value) for node in strings if id(node) not in alone],
        [str(node.value) for node in strings if id(node) in alone],
    )


def words(text: str) -> Iterator[str]:
    yield from (word for word in re.findall(r"[^\W\d_]+", text))


@cache
def listed() -> tuple[frozenset[str], frozenset[str]]:
    """Glosses, and words in lower case, of the default language, but for those that are English words too."""
    language = load_language(DEFAULT_LANGUAGE)
    english = {
        word.lower()
        for path, (strings, docstrings) in modules().items()
        if path.startswith(ENGLISH)
        for text in (*strings, *docstrings)
        for word in words(text)
    }
    glosses = {word for entry in language.table("teo").glob("*.json") for word in words(entry.stem)}
    lexicon = {
        line.split("\t")[0].lower()
        for path in (language.text / "lexicon").glob("*.tsv")
        if path.stem != "names"  # Clara, Blas: names are the same in many languages
        for line in path.read_text("utf-8").splitlines()
        if not line.startswith("#")
    }
    return frozenset(gloss for gloss in glosses if len(gloss) > 2), frozenset(
        word for word in lexicon - english - ALSO_ENGLISH if len(word) >= SHORTEST
    )


def found(text: str) -> list[str]:
    """What of a string names a language, or is a word of the default one."""
    glosses, lexicon = listed()
    return [
        *NAMES.findall(text),
        *(word for word in words(text) if word in glosses or word.lower() in lexicon),
    ]


def test_no_module_names_a_language_or_holds_its_words_but_for_those_that_say_why() -> None:
    named = {
        path: sorted({each for text in strings for each in found(text)})
        for path, (strings, _) in modules().items()
    }
    named = {path: each for path, each in named.items() if each}
    unexpected = {path: each for path, each in named.items() if path not in LEFT}
    assert unexpected == {}, "put it into languages/<code>/"
    assert sorted(LEFT) == sorted(named), "no word is left there: take it off the list"
