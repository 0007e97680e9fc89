# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The file of a score: YAML, every error with its line and field; compounds and inflected forms.

A score may be made of others: a compound, or one sign under a second name.

A verb that agrees goes from person to person, and a sign may be made at a place of the body. The movement
begins at the place of who acts and ends at that of whom it is done to; a hand that turns shows its back
to the one, palm or finger tips to the other (GramLSE, Costello and Villameriel 2023, Lexicon 3.2.2.1). A
score with `forms` says that way once, with `giver`, `receiver`, `onward` and `homeward` in its places and
directions, or `there` for a place of the body; here they become ordinary words for every pair of persons,
or every place.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import permutations
from pathlib import Path

import numpy as np
from pydantic import ValidationError

from teo_sign_authoring.notation.score_schema import (
    Compound,
    Forms,
    HandScore,
    HeadScore,
    Score,
    Step,
    flattened,
)
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.errors import LutError
from teo_signs.sign import gloss_key
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.yaml_lines import YamlLines

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


# [s] From one part to the next. In the dictionary's compounds (BUENOS_DÍAS and the like) 0.2 s to 0.4 s.
_BETWEEN = 0.3

# A left hand that is not needed yet: before the hip, where no other hand comes by.
_WAITING = HandScore(
    shape="relaxed", place="belly 16 front 28 out", part="palm", palm="in down", fingers="front"
)


def _performed(compound: Compound, parts: Sequence[Score]) -> Score:
    """The score of a compound: its parts one after the other.

    Where a part is made with the right hand alone, the left one waits low at its side until it is needed, and
    afterwards stays where it was.
    """
    together = {part.hands for part in parts}
    hands = together.pop() if len(together) == 1 else "both"
    steps: list[Step] = []
    for part in parts:
        own = _steps(part, hands=hands)
        # Said in full: a part knows nothing of how the one before it ended.
        own[0] = own[0].model_copy(
            update={
                "time": _BETWEEN,
                "right": _in_full(own[0].right),
                "left": _in_full(own[0].left),
                "head": own[0].head or HeadScore(turn=0.0, bow=0.0),
            }
        )
        steps += own
    if hands == "both" and steps[0].left is None:
        steps[0] = steps[0].model_copy(update={"left": _WAITING})
    return Score(
        gloss=compound.gloss,
        kind=compound.kind,
        standing=compound.standing,
        source=compound.source,
        hands=hands,
        face=compound.face or ", then ".join(dict.fromkeys(part.face for part in parts if part.face)),
        forms=None,
        notes=" ".join(filter(None, (compound.notes, *(part.notes for part in parts)))),
        steps=list(steps),
    )


def _steps(part: Score, *, hands: str) -> list[Step]:
    """The steps of a part; the left hand written out where it mirrors the right one and others do not."""
    steps = flattened(part.steps)
    if part.hands == "mirrored" and hands == "both":
        return [step.model_copy(update={"left": step.right}) for step in steps]
    return steps


def _in_full(hand: HandScore | None) -> HandScore | None:
    return hand if hand is None or hand.part else hand.model_copy(update={"part": "palm"})


# Names of models that pydantic puts into the place of an error, where a field may be one of two.
_UNION_NAMES = ("Step", "Repeat", "FormStep", "FormRepeat")

# A score of a dozen steps is 2 kB; this is no score.
_MOST_BYTES = 100_000


def default_scores_directory() -> Path:
    """The scores of the default language."""
    return load_language(DEFAULT_LANGUAGE).scores


def read_score(path: Path) -> Score:
    """Read and check one score; those it is made of, if any, are read beside it.

    Raises:
        LutError: "unreadable", "too_large", "not_utf8", "not_yaml", "bad_score", "gloss_mismatch"; the
        message
            begins with file and line and names the field.
    """
    return _read(path, ())


def _read(path: Path, within: tuple[str, ...]) -> Score:
    """Read a score that is part of compounds of those names."""
    try:
        lines = YamlLines(path, most_bytes=_MOST_BYTES, fields="fields such as 'gloss: YO'")
    except SyntheticError as error:
        code = "bad_score" if error.code == "no_fields" else error.code
        raise LutError(code, error.sentence) from error
    score: Compound | Score
    try:
        score = (Compound if "signs" in lines.content else Score).model_validate(lines.content)
    except ValidationError as error:
        first = error.errors()[0]
        where = [part for part in first["loc"] if part not in _UNION_NAMES]
        raise _refusal(lines, where, first["msg"]) from error
    if gloss_key(score.gloss) != path.stem:
        message = f"{path.name}:1: gloss: expected {path.stem!r}, the file's name, got {score.gloss!r}"
        raise LutError("gloss_mismatch", message)
    if isinstance(score, Score):
        try:
            for form in inflected_scores(score).values():
                Score.model_validate(form.model_dump(exclude_unset=True))
        except ValidationError as error:  # words of the forms that mean nothing once persons are filled in
            raise _refusal(lines, ["forms"], error.errors()[0]["msg"]) from error
        return score
    return _performed(score, [_part(path, lines, score, index, within) for index in range(len(score.signs))])


def _refusal(lines: YamlLines, where: list[int | str], expected: str) -> LutError:
    field = ".".join(map(str, where)) or "score"
    return LutError("bad_score", f"{lines.place(where)}: {field}: {expected.removeprefix('Value error, ')}")


def _part(path: Path, lines: YamlLines, compound: Compound, index: int, within: tuple[str, ...]) -> Score:
    """The score of one of a compound's signs, which is beside it."""
    gloss = compound.signs[index]
    where: list[int | str] = ["signs", index]
    beside = path.with_name(f"{gloss_key(gloss)}.yaml")
    within = (*within, compound.gloss)
    if gloss in within:
        raise _refusal(lines, where, f"expected a sign that is not made of itself, got {gloss!r}")
    if not beside.is_file():
        raise _refusal(lines, where, f"expected a sign with a score beside this one, got {gloss!r}")
    part = _read(beside, within)
    if not compound.inflection:
        return part
    forms = inflected_scores(part)
    if compound.inflection not in forms:
        there = ", ".join(forms) or "none"
        message = f"expected a form of {gloss} ({there}), got {compound.inflection!r}"
        raise _refusal(lines, where, message)
    return forms[compound.inflection]


def read_scores(directory: Path) -> Iterator[Score]:
    """All scores of a directory, by name.

    Raises:
        LutError: As `read_score`; "no_directory".
    """
    if not directory.is_dir():
        raise LutError("no_directory", f"expected a directory of scores, got {directory}")
    for path in sorted(directory.glob("*.yaml")):
        yield read_score(path)
