# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut review`: what signers said of the signs, entered into the table."""

from __future__ import annotations

import datetime
import json
from collections import defaultdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

from teo_description.humanoid import DEFAULT_ROBOT
from teo_lut_executor.cli.options import AsJson, LanguageCode, RobotName, TableDirectory, fail
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut, user_lut_directory
from teo_signs.reviews import LEAST_REVIEWERS, LEAST_RIGHT, Rule, SignRating, judge, read_ratings
from teo_signs.sign_file import save_sign

_output = Console(highlight=False)


def review(
    export: Annotated[Path, typer.Argument(help="Export of the console's reviews, JSON.")],
    lut: TableDirectory = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
    least_reviewers: Annotated[
        int, typer.Option(min=1, help="How many people must have rated the motion.")
    ] = LEAST_REVIEWERS,
    least_right: Annotated[
        float, typer.Option(min=0.5, max=1.0, help="What share of them must find it right.")
    ] = LEAST_RIGHT,
    as_json: AsJson = False,
) -> None:
    """Raise to `reviewed` the signs that enough signers found right, and lower those that too few did.

    Only ratings of the motion that an entry has now count. An entry of the package's table is written into
    your own table, which is looked into first.

    Exit status: 0, 1 if the export or an entry cannot be used (code and reason on standard error).
    """
    try:
        ratings: dict[str, list[SignRating]] = defaultdict(list)
        for rating in read_ratings(export):
            ratings[rating.gloss].append(rating)
        signs, rule = Lut.open(lut, language=language, robot=robot), Rule(least_reviewers, least_right)
        table = Table("sign", "standing", "why", box=None)
        entered: list[dict[str, Any]] = []
        changed = 0
        for gloss in sorted(ratings):
            if gloss not in signs:
                table.add_row(gloss, "-", f"{signs.place} has no such sign")
                entered.append({"gloss": gloss, "standing": None, "reviewers": 0, "right": 0})
                continue
            verdict = judge(signs[gloss], ratings[gloss], day=datetime.date.today(), rule=rule)
            if verdict.changed:
                save_sign(lut or user_lut_directory(language, robot), verdict.sign, replace=True)
                changed += 1
            standing = verdict.sign.provenance.standing
            table.add_row(gloss, standing, verdict.reason)
            entered.append(
                {"gloss": gloss, "standing": standing, "reviewers": verdict.reviewers, "right": verdict.right}
            )
    except LutError as error:
        fail(error)
    except OSError as error:
        fail(LutError("not_written", f"expected a table to write to, got: {error}"))
    if as_json:
        print(json.dumps({"signs": entered, "changed": changed}, ensure_ascii=False))
        return
    _output.print(table)
    _output.print(f"{len(ratings)} signs rated, {changed} entries written", soft_wrap=True)
