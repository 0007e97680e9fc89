# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Inflected forms of a score: a verb's way from person to person, or a sign at a place of the body.

In verbs that agree the movement begins at the place of who acts and ends at that of whom it is done to; a
hand that turns shows its back to the one, palm or finger tips to the other (GramLSE, Costello and
Villameriel 2023, Lexicon 3.2.2.1). A score with `forms` says that way once, with `giver`, `receiver`,
`onward` and `homeward` in its places and directions, or `there` for a place of the body; here they become
ordinary words for every pair of persons, or every place.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import permutations

import numpy as np

from teo_sign_authoring.notation.score_schema import Forms, Score, Step, flattened

# Where persons are: the first before the signer's chest, the second farther away, the third to the right,
# as far as the arm reaches without help of the trunk (GramLSE, Morphology 3.1.1.1: a place of the signing
# space that is neither the signer's nor the addressee's). Each a place, and its distance from it in
# centimetres.
_PERSONS = {"1": "space 4 back", "2": "space 14 front 2 up", "3": "space 6 front 20 out 4 up"}
# The same seen from above [cm]: front, out. Only their directions from each other are used.
_SEEN_FROM_ABOVE = {"1": (-4.0, 0.0), "2": (14.0, 0.0), "3": (6.0, 20.0)}

# What is out for the right hand is in for the left one beside it.
_MIRROR = {"out": "in", "in": "out"}

# Where the part of the body is that a gloss names.
BODY_PLACES = {
    "CABEZA": "forehead 2 front",
    "FRENTE": "forehead 2 front",
    "OJO": "eye 2 front",
    "OÍDO": "ear 3 front 3 out",
    "OREJA": "ear 3 front 3 out",
    "NARIZ": "nose 2 front",
    "BOCA": "mouth 2 front",
    "DIENTE": "mouth 2 front 3 out",
    "MUELA": "cheek 2 front 1 down",
    "CUELLO": "throat 8 front 4 out",
    "GARGANTA": "throat 8 front",
    "HOMBRO": "other_shoulder 5 front",
    "PECHO": "chest 5 front",
    "CORAZÓN": "other_chest 5 front",
    "ESTÓMAGO": "belly 7 front 6 up",
    "BARRIGA": "belly 7 front",
    "TRIPA": "belly 7 front",
}


def inflected_scores(score: Score) -> dict[str, Score]:
    """The forms of a score, each as a score of its own, by inflection; none of a score without `forms`."""
    if score.forms is None:
        return {}
    return {
        inflection: score.model_copy(
            update={
                "hands": score.forms.hands or score.hands,
                "steps": [_worded(step, words) for step in flattened(score.forms.steps)],
                "forms": None,
            }
        )
        for inflection, words in _wordings(score.forms).items()
    }


def _wordings(forms: Forms) -> Mapping[str, Mapping[str, str]]:
    """For each inflection what the words stand for."""
    if forms.along == "body":
        return {gloss: {"there": place} for gloss, place in BODY_PLACES.items()}
    made = {}
    for giver, receiver in permutations(_PERSONS, 2):
        if forms.only is not None and f"{giver}>{receiver}" not in forms.only:
            continue
        way = np.subtract(_SEEN_FROM_ABOVE[receiver], _SEEN_FROM_ABOVE[giver])
        front, out = way / np.linalg.norm(way)
        made[f"{giver}>{receiver}"] = {
            "giver": _PERSONS[giver],
            "receiver": _PERSONS[receiver],
            "onward": _words(front, out),
            "homeward": _words(-front, -out),
        }
    return made


def _words(front: float, out: float) -> str:
    """A direction in words, e.g. `0.8 front 0.6 in`."""
    said = [(front, "front", "back"), (out, "out", "in")]
    return " ".join(f"{abs(size):.2f} {ahead if size > 0 else behind}" for size, ahead, behind in said)


def _worded(step: Step, words: Mapping[str, str]) -> Step:
    """A step with each of the words replaced by what it stands for."""
    said = step.model_dump(exclude_unset=True)
    across = {
        word: " ".join(_MIRROR.get(part, part) for part in text.split()) for word, text in words.items()
    }
    for side, own in (("right", words), ("left", across)):
        for field in ("place", "palm", "fingers"):
            if said.get(side) and said[side].get(field):
                said[side][field] = _replaced(said[side][field], own)
    if said.get("arc"):
        said["arc"] = _replaced(said["arc"], words)
    return Step.model_validate(said)


def _replaced(text: str, words: Mapping[str, str]) -> str:
    """Text with words replaced; a number before a direction multiplies it: `2 onward up`."""

    def said(match: re.Match[str]) -> str:
        factor, word = match[1], match[2]
        if word not in words:
            return match[0]
        if factor is None:
            return words[word]
        return re.sub(r"[\d.]+", lambda number: f"{float(factor) * float(number[0]):.2f}", words[word])

    return re.sub(r"(?:([\d.]+) )?\b([a-z_]+)\b", said, text)
