# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut ease`, `lut retarget`, `lut fit`: quicker postures, tables for other robots and how good they are."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import Progress, track
from rich.table import Table

from teo_description.errors import DescriptionError
from teo_sign_authoring.cli.command import errors, fail, output
from teo_sign_capture.cli.options import LanguageCode, RobotName
from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, load_language
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut, user_lut_directory

if TYPE_CHECKING:  # they take a second to load, which the other commands of `lut` need not wait for
    from teo_sign_authoring.alphabet.letter_likeness import Likeness
    from teo_sign_authoring.transfer.fit import SignFit
    from teo_sign_authoring.transfer.language_signs import LanguageSigns


def ease(
    context: typer.Context,
    glosses: Annotated[
        list[str] | None, typer.Argument(metavar="[GLOSS]...", help="Which words; all without it.")
    ] = None,
    lut: Annotated[Path | None, typer.Option(help="Directory of the table; your own without it.")] = None,
) -> None:
    """Give words another posture that shows the same and is quicker to reach; the planner chooses."""
    from teo_description.robot import Robot
    from teo_sign_authoring.easing.easy_words import EasyTable
    from teo_signs.sign_file import save_sign

    eased = 0
    try:
        directory = context.obj()[0] if lut is None else lut
        table = Lut.open(directory)
        # A table of a few signs stands among those of the package.
        easy = EasyTable(Robot.load(), dict(Lut.open()) | dict(table))
        chosen = [table[gloss] for gloss in glosses or table]
        hidden = not errors.is_terminal
        for sign in track(chosen, "easing", console=errors, transient=True, disable=hidden):
            if sign.kind != "lexical":
                continue
            easier = easy.eased(sign)
            save_sign(directory, easier, replace=True)
            eased += bool(easier.alternatives)
    except LutError as error:
        fail(error)
    output.print(f"{directory}: {eased} of {len(chosen)} signs have an easier posture")


def retarget(
    robot: RobotName,
    glosses: Annotated[
        list[str] | None, typer.Argument(metavar="[GLOSS]...", help="Which signs; all without it.")
    ] = None,
    language: LanguageCode = DEFAULT_LANGUAGE,
    out: Annotated[
        Path | None,
        typer.Option(help="Directory of the table; your own of that language and robot without it."),
    ] = None,
    replace: Annotated[bool, typer.Option("--replace", help="Make entries that are there anew.")] = False,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="Signs made at a time; one for each core without it.")
    ] = None,
) -> None:
    """Make the signs of a language for a robot, each from its recording, its score, or what TEO shows.

    Exit status: 0 all are there, 1 some are not (each with code and reason on standard error).
    """
    from teo_description.robot import Robot
    from teo_sign_authoring.transfer.language_signs import LanguageSigns, Transferred, transfer_table

    try:
        signs = LanguageSigns(load_language(language), Robot.load(robot))
        chosen = tuple(glosses or signs.glosses)
        _check_known(chosen, signs)
        table = out or user_lut_directory(language, robot)
        if table.is_dir():  # what is there stays, if it is of this language and robot
            Lut.open(table, language=language, robot=robot)
    except (LanguageError, LutError, DescriptionError) as error:
        fail(error)
    with Progress(console=errors, transient=True) as progress:
        task = progress.add_task(f"{language} for {robot}", total=len(chosen))

        def done(sign: Transferred) -> None:
            progress.advance(task)
            if sign.refused:
                errors.print(f"{sign.code}: {sign.message}", markup=False, soft_wrap=True)

        count = jobs or os.cpu_count() or 1
        found = transfer_table(language, robot, chosen, table, replace=replace, jobs=count, done=done)
    refused = sum(sign.refused for sign in found)
    made = sum(sign.code == "made" for sign in found)
    output.print(
        f"{table}: {made} signs made, {len(found) - made - refused} there already, {refused} refused",
        soft_wrap=True,
    )
    if refused:
        raise typer.Exit(1)


def fit(
    robot: RobotName,
    glosses: Annotated[
        list[str] | None, typer.Argument(metavar="[GLOSS]...", help="Which signs; all without it.")
    ] = None,
    language: LanguageCode = DEFAULT_LANGUAGE,
    lut: Annotated[
        Path | None,
        typer.Option(
            help="Directory of the robot's table; your own and, beneath it, the language's without it."
        ),
    ] = None,
    letters: Annotated[bool, typer.Option("--letters", help="The manual alphabet alone.")] = False,
    everything: Annotated[
        bool, typer.Option("--all", help="A row for every sign, not only for those that are off or refused.")
    ] = False,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="Signs looked at at a time; one for each core without it.")
    ] = None,
) -> None:
    """Tell of each sign what is off on a robot, how slow it is, and why it is refused where it is.

    What the robot's table lacks is made to be looked at, and not kept. Exit status: 0 every sign is made and
    every letter told apart, 1 not.
    """
    from teo_description.robot import Robot
    from teo_sign_authoring.alphabet.letter_likeness import letter_likenesses
    from teo_sign_authoring.transfer.fit import entries, fit_table
    from teo_sign_authoring.transfer.language_signs import LanguageSigns

    try:
        signs = LanguageSigns(load_language(language), Robot.load(robot))
        alphabet = [letter for letter in signs.language.alphabet.letters if letter in signs.glosses]
        chosen = tuple(glosses or (alphabet if letters else signs.glosses))
        _check_known(chosen, signs)
        kept = entries(language, robot, lut)
        beyond = set()
        for letter, reason in signs.letters_beyond(chosen):
            output.print(reason, markup=False, soft_wrap=True)
            beyond.add(letter)
        with Progress(console=errors, transient=True) as progress:
            task = progress.add_task(f"{language} on {robot}", total=len(chosen))

            def done(_: SignFit) -> None:
                progress.advance(task)

            fits = fit_table(language, robot, chosen, lut, jobs=jobs or os.cpu_count() or 1, done=done)
        spelled = {found.gloss for found in fits if found.kind == "letter" and not found.refused}
        made = {letter: kept[letter] if letter in kept else signs.sign(letter) for letter in spelled}
        likenesses = letter_likenesses(signs.robot, signs.language, made) if made else []
    except (LanguageError, LutError, DescriptionError) as error:
        fail(error)
    _print_rows([found for found in fits if everything or not found.within])
    for found in fits:
        if found.refused and found.gloss not in beyond:
            output.print(f"{found.refused}: {found.reason}", markup=False, soft_wrap=True)
    confused = [one for one in likenesses if one.posture == 0 and not one.right]
    for one in confused:
        output.print(f"{one.letter} looks more like {one.ranking[0]} than like itself")
    _print_summary(f"{signs.language.names.en} on {signs.robot.humanoid.file.title}", fits, likenesses)
    if confused or any(found.refused for found in fits):
        raise typer.Exit(1)


def _check_known(glosses: Sequence[str], signs: LanguageSigns) -> None:
    unknown = [gloss for gloss in glosses if gloss not in signs.glosses]
    if unknown:
        there = f"signs of {signs.language.code} ({len(signs.glosses)} there are)"
        raise LutError("unknown_sign", f"expected {there}, got {', '.join(unknown)}")


def _print_rows(fits: Sequence[SignFit]) -> None:
    if not fits:
        return
    table = Table(
        "sign", "kind", "place [mm]", "palm [deg]", "fingers [deg]", "tips [mm]", "stretch", "refused"
    )
    for found in fits:
        figures = (found.place_mm, found.palm_deg, found.finger_deg, found.tip_mm)
        cells = (
            ["-"] * 5 if found.refused else [*(f"{figure:.0f}" for figure in figures), f"{found.stretch:.2f}"]
        )
        table.add_row(found.gloss, found.kind, *cells, found.refused)
    output.print(table)


def _print_summary(title: str, fits: Sequence[SignFit], likenesses: Sequence[Likeness]) -> None:
    from teo_sign_authoring.transfer.fit import ANGLE_DEG, PLACE_MM, median_stretch, within_share

    captured = [one for one in likenesses if one.posture == 0]
    letters = sum(found.kind == "letter" for found in fits)
    refused = sum(bool(found.refused) for found in fits)
    table = Table("measure", "figure", title=title)
    if letters:
        table.add_row(
            "letters most like their own recording", f"{sum(one.right for one in captured)} of {letters}"
        )
    table.add_row("signs refused", f"{refused} of {len(fits)}")
    table.add_row(
        f"signs within {PLACE_MM:.0f} mm and {ANGLE_DEG:.0f} deg",
        f"{100.0 * within_share(fits):.0f} % of {len(fits)}",
    )
    if refused < len(fits):
        table.add_row("times as long as asked for, median", f"{median_stretch(fits):.2f}")
    output.print(table)
