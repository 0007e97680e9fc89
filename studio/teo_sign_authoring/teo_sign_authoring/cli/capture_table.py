# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Commands that fill a table: `capture_letters`, `_numbers`, `_demonstration`, `_scores`, `ease_letters`."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from teo_description.errors import DescriptionError
from teo_description.humanoid import DEFAULT_ROBOT
from teo_description.robot import Robot
from teo_sign_authoring.cli.command import chosen_scores, errors, fail, output, run_command
from teo_sign_capture.cli.options import LanguageCode, RobotName
from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, load_language
from teo_signs.errors import LutError, PlanError
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign
from teo_signs.sign_file import save_sign

_Out = Annotated[Path, typer.Option(help="Directory of the table to write into; made if it is not there.")]
_Replace = Annotated[bool, typer.Option(help="Replace entries that are there already.")]


def capture_letters(
    out: _Out,
    only: Annotated[
        list[str] | None, typer.Option(help="A letter; may be given again. All without it.")
    ] = None,
    language: LanguageCode = DEFAULT_LANGUAGE,
    replace: _Replace = False,
) -> None:
    """Capture a manual alphabet from the recordings in the package spoken-to-signed."""
    from teo_sign_authoring.alphabet.letters import capture_letter, read_alphabet

    robot = Robot.load()
    try:
        alphabet = read_alphabet(robot, load_language(language))
    except (LanguageError, LutError) as error:
        fail(error)
    known = alphabet.language.alphabet.letters
    unknown = [letter for letter in only or [] if letter not in known]
    if unknown:
        message = f"expected letters among {', '.join(known)}; got {', '.join(unknown)}"
        fail(LutError("unknown_letter", message))
    _save_all(
        only or known, lambda letter: capture_letter(robot, alphabet, letter), out, "letters", replace=replace
    )


def ease_letters(
    lut: Annotated[Path, typer.Option(help="Directory of the table whose letters get easy postures.")],
    language: LanguageCode = DEFAULT_LANGUAGE,
    robot: RobotName = DEFAULT_ROBOT,
) -> None:
    """Give each letter of a table the posture with which spelling needs least travel, as its alternative."""
    from teo_sign_authoring.alphabet.letter_likeness import recordings
    from teo_sign_authoring.alphabet.letters import read_alphabet
    from teo_sign_authoring.easing.easy_letters import ease_letters as easier_offsets
    from teo_sign_authoring.easing.easy_letters import with_easy_posture
    from teo_sign_authoring.easing.letter_tolerance import LetterTolerance

    try:
        speller = Robot.load(robot)
        table = Lut.open(lut, language=language, robot=robot)
        alphabet = read_alphabet(speller, table.language)
        recorded = recordings(speller, alphabet)
        letters = {letter: table[letter] for letter in recorded if letter in table}
        tolerances = {letter: LetterTolerance(speller, sign, recorded) for letter, sign in letters.items()}
        offsets = easier_offsets(speller, table.language.alphabet, tolerances)
    except (LutError, DescriptionError) as error:
        fail(error)
    eased = (with_easy_posture(sign, offsets[letter]) for letter, sign in letters.items())
    _save(eased, lut, replace=True)
    missing = [letter for letter in table.language.alphabet.letters if letter not in letters]
    if missing:
        errors.print(f"not eased, for the table has none: {', '.join(missing)}", soft_wrap=True)


def capture_numbers(out: _Out, language: LanguageCode = DEFAULT_LANGUAGE, replace: _Replace = False) -> None:
    """Bring the scores of numbers onto TEO; `capture_scores` does so with all."""
    from teo_sign_authoring.notation.score_file import read_scores
    from teo_sign_authoring.notation.score_retarget import score_sign

    robot = Robot.load()
    try:
        found = load_language(language)
        numbers = [score for score in read_scores(found.scores) if score.kind == "number"]
        _save((score_sign(robot, score, language=found.code) for score in numbers), out, replace=replace)
    except (LanguageError, LutError) as error:
        fail(error)


def capture_demonstration(out: _Out, replace: _Replace = False) -> None:
    """Write HOLA, MI and NOMBRE from the poses of TEO's own public demonstration."""
    from teo_sign_authoring.alphabet.demonstration import demonstrated_signs

    _save(demonstrated_signs(Robot.load()), out, replace=replace)


def capture_scores(
    out: _Out,
    scores: Annotated[
        Path | None, typer.Option(help="Directory of scores (YAML); the language's without it.")
    ] = None,
    only: Annotated[
        list[str] | None, typer.Option(help="A gloss; may be given again. All without it.")
    ] = None,
    language: LanguageCode = DEFAULT_LANGUAGE,
    replace: _Replace = False,
) -> None:
    """Bring sign scores, written descriptions of signs, onto TEO; what it cannot sign alone is left out."""
    from teo_sign_authoring.notation.score_retarget import score_sign
    from teo_sign_authoring.transfer.language_signs import played_alone

    robot = Robot.load()
    try:
        signed = load_language(language)
        chosen = chosen_scores(scores or signed.scores, only)
    except (LanguageError, LutError) as error:
        fail(error)

    def made(gloss: str) -> Sign:
        sign = score_sign(robot, chosen[gloss], language=signed.code)
        played_alone(robot, sign)
        return sign

    _save_all(chosen, made, out, "scores", replace=replace)


# What the entry points call.
letters_main = partial(run_command, capture_letters)
ease_letters_main = partial(run_command, ease_letters)
numbers_main = partial(run_command, capture_numbers)
demonstration_main = partial(run_command, capture_demonstration)
scores_main = partial(run_command, capture_scores)


def _save_all(
    glosses: Collection[str], made: Callable[[str], Sign], out: Path, what: str, *, replace: bool
) -> None:
    """Save what can be made, say why the others cannot, and end with status 1 if there are such."""
    failed: list[str] = []

    def signs() -> Iterator[Sign]:
        for gloss in glosses:
            try:
                yield made(gloss)
            except (LutError, PlanError) as error:
                failed.append(gloss)
                errors.print(f"{error.code}: {error}", soft_wrap=True)

    _save(signs(), out, replace=replace)
    if failed:
        left = f"{len(failed)} of {len(glosses)} {what} left out: {', '.join(failed)}"
        errors.print(left, soft_wrap=True)
        raise typer.Exit(1)


def _save(signs: Iterable[Sign], out: Path, *, replace: bool) -> None:
    for sign in signs:
        try:
            path = save_sign(out, sign, replace=replace)
        except LutError as error:
            fail(error)
        except OSError as error:
            fail(LutError("not_written", f"--out: expected a place to write to, got: {error}"))
        figures = "  ".join(f"{name} {value:g}" for name, value in sign.quality.items())
        output.print(
            f"{path.name:12} {len(sign.times):2} knots {sign.duration:5.2f} s  {figures}", soft_wrap=True
        )
