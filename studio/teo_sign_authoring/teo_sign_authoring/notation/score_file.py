# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The file of a score: YAML, every error with its line and field.

A score may be made of others: a compound, or one sign under a second name.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import yaml
from pydantic import ValidationError

from teo_sign_authoring.notation.inflection import inflected_scores
from teo_sign_authoring.notation.score_schema import Compound, HandScore, HeadScore, Score, Step, flattened
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.errors import LutError
from teo_signs.sign import gloss_key

# [s] From one part to the next. In the dictionary's compounds (BUENOS_DÍAS and the like) 0.2 s to 0.4 s.
_BETWEEN = 0.3

# A left hand that is not needed yet: before the hip, where no other hand comes by.
_WAITING = HandScore(
    shape="relaxed", place="belly 16 front 28 out", part="palm", palm="in down", fingers="front"
)


def performed(compound: Compound, parts: Sequence[Score]) -> Score:
    """The score of a compound: its parts one after the other.

    Where a part is made with the right hand alone, the left one waits low at its side until it is needed, and
    afterwards stays where it was.

    Args:
        compound: What it is called, and what it rests on.
        parts: The scores of its signs, in order.
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
        data = path.read_bytes()
    except OSError as error:
        raise LutError(
            "unreadable", f"{path.name}: expected a file to read, got: {error.strerror}"
        ) from error
    if len(data) > _MOST_BYTES:
        raise LutError("too_large", f"{path.name}: expected at most {_MOST_BYTES} bytes, got {len(data)}")
    try:
        text = data.decode("utf-8")
        root = yaml.compose(text, Loader=yaml.SafeLoader)
        content = yaml.safe_load(text)
    except UnicodeDecodeError as error:
        raise LutError("not_utf8", f"{path.name}: expected UTF-8, got byte {data[error.start]:#x}") from error
    except yaml.YAMLError as error:
        raise LutError(
            "not_yaml", f"{path.name}: expected YAML, got: {' '.join(str(error).split())}"
        ) from error
    if not isinstance(root, yaml.MappingNode):
        raise LutError("bad_score", f"{path.name}:1: expected fields such as 'gloss: YO', got none")
    compound = any(key.value == "signs" for key, _ in root.value)
    score: Compound | Score
    try:
        score = (Compound if compound else Score).model_validate(content)
    except ValidationError as error:
        first = error.errors()[0]
        where = [part for part in first["loc"] if not (isinstance(part, str) and part in _UNION_NAMES)]
        field = ".".join(map(str, where)) or "score"
        expected = first["msg"].removeprefix("Value error, ")
        raise LutError("bad_score", f"{path.name}:{_line(root, where)}: {field}: {expected}") from error
    if gloss_key(score.gloss) != path.stem:
        message = f"{path.name}:1: gloss: expected {path.stem!r}, the file's name, got {score.gloss!r}"
        raise LutError("gloss_mismatch", message)
    if isinstance(score, Score):
        _check_forms(path, root, score)
        return score
    return performed(score, [_part(path, root, score, index, within) for index in range(len(score.signs))])


def _check_forms(path: Path, root: yaml.Node, score: Score) -> None:
    """Refuse forms whose words mean nothing: they are filled in for each person or place."""
    try:
        for form in inflected_scores(score).values():
            Score.model_validate(form.model_dump(exclude_unset=True))
    except ValidationError as error:
        expected = error.errors()[0]["msg"].removeprefix("Value error, ")
        line = _line(root, ["forms"])
        raise LutError("bad_score", f"{path.name}:{line}: forms: {expected}") from error


def _part(path: Path, root: yaml.Node, compound: Compound, index: int, within: tuple[str, ...]) -> Score:
    gloss = compound.signs[index]
    beside = path.with_name(f"{gloss_key(gloss)}.yaml")
    where = f"{path.name}:{_line(root, ['signs', index])}: signs.{index}"
    within = (*within, compound.gloss)
    if gloss in within:
        raise LutError("bad_score", f"{where}: expected a sign that is not made of itself, got {gloss!r}")
    if not beside.is_file():
        raise LutError("bad_score", f"{where}: expected a sign with a score beside this one, got {gloss!r}")
    part = _read(beside, within)
    if not compound.inflection:
        return part
    forms = inflected_scores(part)
    if compound.inflection not in forms:
        there = ", ".join(forms) or "none"
        raise LutError(
            "bad_score", f"{where}: expected a form of {gloss} ({there}), got {compound.inflection!r}"
        )
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


def _line(node: yaml.Node, path: list[int | str]) -> int:
    """Line of the deepest part of a path that the text has, from 1."""
    line = node.start_mark.line + 1
    for part in path:
        if isinstance(node, yaml.MappingNode):
            found = next((pair for pair in node.value if pair[0].value == part), None)
            if found is None:
                break
            line, node = found[0].start_mark.line + 1, found[1]
        elif isinstance(node, yaml.SequenceNode) and isinstance(part, int) and part < len(node.value):
            node = node.value[part]
            line = node.start_mark.line + 1
        else:
            break
    return line
