# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 run teo_lut_executor lut`: look into a table of signs.

Other packages bring more commands: what needs a camera's software is not on every robot.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Annotated, NamedTuple

import msgspec
import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from teo_description.humanoid import DEFAULT_ROBOT
from teo_lut_executor.cli.export import export
from teo_lut_executor.cli.listing import list_signs, nearest
from teo_lut_executor.cli.options import (
    LanguageCode,
    RobotName,
    TableDirectory,
    fail,
    open_table,
    signs_of_kind,
)
from teo_lut_executor.cli.review import review
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign, sign_warnings
from teo_signs.sign_file import format_sign
from teo_signs.sign_schema import sign_json_schema

# Entry points of this group are commands: name, and a function with typer's annotations. Its context's `obj`
# are the directories of the table that is used without --lut, in the order in which a gloss is sought there.
_GROUP = "teo_lut_executor.lut_commands"


class _Known(NamedTuple):
    """A command that belongs to `lut` for its users though another package has it."""

    does: str
    provider: str
    requirements: str


_CAPTURE = ("teo_sign_capture", "requirements/capture.txt")
_AUTHORING = ("teo_sign_authoring", "requirements/authoring.txt")
_KNOWN = {
    "capture": _Known("A sign from recordings of a person.", *_CAPTURE),
    "coverage": _Known("What of a text has signs.", "teo_sign_translator", "requirements/run.txt"),
    "ease": _Known("Postures of words that are quicker to reach.", *_AUTHORING),
    "import": _Known(
        "Signs from a clip in which a person's points were found, or from SignWriting.", *_CAPTURE
    ),
    "recognise": _Known("Which signs of the table a demonstration may be.", *_CAPTURE),
    "fit": _Known("How well signs fit a robot.", *_AUTHORING),
    "retarget": _Known("A language's table for another robot.", *_AUTHORING),
    "record": _Known("A sign from the person before the camera, now.", *_CAPTURE),
}


def _add_plugins(app: typer.Typer) -> None:
    """Add the commands of other packages; one that should be there and is not says what to install."""
    found = {point.name: point for point in entry_points(group=_GROUP)}
    for name, point in sorted(found.items()):
        try:
            app.command(name)(point.load())
        except ImportError as error:
            _add_placeholder(app, name, _reason_not_loaded(point, error))
    for name in _KNOWN.keys() - found.keys():
        known = _KNOWN[name]
        _add_placeholder(
            app,
            name,
            f"lut {name}: expected the package {known.provider}, which is not installed; "
            f"install {known.requirements} and build the package",
        )


def _reason_not_loaded(point: EntryPoint, error: ImportError) -> str:
    provider = point.module.partition(".")[0]
    install = f"; install {_KNOWN[point.name].requirements}" if point.name in _KNOWN else ""
    return f"lut {point.name}: expected what {provider} needs, got: {error}{install}"


def _add_placeholder(app: typer.Typer, name: str, reason: str) -> None:
    def missing() -> None:
        fail(LutError("not_installed", reason))

    does = _KNOWN[name].does if name in _KNOWN else "A command of another package."
    missing.__doc__ = f"{does} (not installed)"
    anything = {"allow_extra_args": True, "ignore_unknown_options": True}
    command: Callable[[], None] = missing
    app.command(name, context_settings=anything)(command)


app = typer.Typer(
    help="Look into a table of signs.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.command()(export)
app.command("list")(list_signs)
app.command()(nearest)
app.command()(review)
_add_plugins(app)

_output = Console(highlight=False)


@app.callback()
def _tell_tables(context: typer.Context) -> None:
    """Look into a table of signs."""
    context.obj = _tables


def _tables(language: str, robot: str) -> tuple[Path, ...]:
    """Directories in which a gloss of a language is sought, for commands that join `lut`; may be none."""
    try:
        return Lut.open(language=language, robot=robot).directories
    except LutError:  # other tables can be looked into all the same
        return ()


@app.command()
def show(
    gloss: str,
    lut: TableDirectory = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
    as_json: Annotated[bool, typer.Option("--json", help="The entry as its file holds it.")] = False,
) -> None:
    """Everything that an entry says."""
    try:
        signs = open_table(lut, robot, language)
        sign, path = signs[gloss], signs.path(gloss)
    except LutError as error:
        fail(error)
    if as_json:
        print(format_sign(sign), end="")
        return
    made_for = f"{sign.language} for {sign.robot}"
    _output.print(f"{sign.gloss}: {sign.kind} of {made_for}, {sign.handedness}, {sign.duration:.2f} s")
    _output.print(f"  file: {path}", markup=False, soft_wrap=True)
    for name, value in msgspec.to_builtins(sign.provenance).items():
        _output.print(f"  {name}: {value if value not in (None, '') else '-'}", markup=False)
    for name, figure in sign.quality.items():
        _output.print(f"  {name}: {figure:g}")
    table = Table("joint", *(f"{time:.2f} s" for time in sign.times), title="knots [deg]", box=None)
    for joint, column in zip(sign.joints, np.degrees(sign.knots).T, strict=True):
        table.add_row(joint, *(f"{value:.1f}" for value in column))
    # A long sign has more columns than a terminal: let the lines run on rather than drop any.
    Console(highlight=False, width=max(_output.width, 24 + 10 * len(sign.times))).print(table)
    for warning in sign_warnings(sign):
        _output.print(f"warning: {warning}", markup=False)


@app.command()
def validate(
    directory: Annotated[
        Path | None,
        typer.Argument(help="Directory of the table; your own and, beneath it, the package's without it."),
    ] = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
) -> None:
    """Read every entry; exit status 1 if one is not valid."""
    signs = open_table(directory, robot, language)
    wrong = odd = 0
    for gloss in signs.glosses():
        try:
            sign = signs[gloss]
        except LutError as error:
            wrong += 1
            _output.print(f"error {error.code}: {error}", markup=False, soft_wrap=True)
            continue
        for warning in sign_warnings(sign):
            odd += 1
            _output.print(f"warning: {warning}", markup=False, soft_wrap=True)
    _output.print(f"{len(signs)} entries in {signs.place}: {wrong} errors, {odd} warnings", soft_wrap=True)
    if wrong:
        raise typer.Exit(1)


@app.command()
def render(
    gloss: Annotated[str | None, typer.Argument(help="Which sign; not with --all.")] = None,
    out: Annotated[Path | None, typer.Option(help="A .png or .mp4 file; with --all a directory.")] = None,
    everything: Annotated[bool, typer.Option("--all", help="Sheets of letters, numbers and signs.")] = False,
    lut: TableDirectory = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
) -> None:
    """Draw a sign (PNG) or film it (MP4); with --all, one sheet for each kind of sign."""
    if out is None or everything == (gloss is not None):
        fail(LutError("bad_arguments", "expected GLOSS --out FILE.png|FILE.mp4, or --all --out DIRECTORY"))
    signs = open_table(lut, robot, language)
    try:
        if gloss is None:
            _render_sheets(out, signs)
        else:
            _render_one(out, signs[gloss])
    except LutError as error:
        fail(error)
    except OSError as error:
        fail(LutError("not_written", f"--out: expected a place to write to, got: {error}"))


@app.command()
def overview(
    out: Annotated[Path, typer.Option(help="A .png file.")],
    kind: Annotated[str, typer.Option(help="lexical, letter or number.")] = "lexical",
    lut: TableDirectory = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
) -> None:
    """Draw all signs of a kind on one small picture, each as it begins and farthest from there."""
    from teo_signs.pictures import save_overview

    signs = signs_of_kind(open_table(lut, robot, language), kind)
    if not signs:
        fail(LutError("unknown_sign", f"--kind: expected a kind that the table has, got {kind!r}"))
    try:
        save_overview(out, signs)
    except OSError as error:
        fail(LutError("not_written", f"--out: expected a place to write to, got: {error}"))
    _output.print(f"wrote {out}: {len(signs)} signs", soft_wrap=True)


@app.command()
def compare(
    pairs: Annotated[
        list[str], typer.Argument(metavar="GLOSS PICTURE...", help="Signs, each with a picture of it.")
    ],
    out: Annotated[Path, typer.Option(help="A .png file.")],
    lut: TableDirectory = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
) -> None:
    """Draw signs beside pictures of them: both ends in one picture, the way as an arrow, touches as rays."""
    from teo_signs.pictures import save_comparison

    if len(pairs) % 2:
        fail(LutError("bad_arguments", f"expected a picture after each gloss, got none after {pairs[-1]!r}"))
    signs = open_table(lut, robot, language)
    try:
        found = [(signs[gloss], Path(file)) for gloss, file in zip(pairs[::2], pairs[1::2], strict=True)]
        save_comparison(out, found)
    except LutError as error:
        fail(error)
    except OSError as error:
        fail(LutError("not_written", f"--out: expected a place to write to, got: {error}"))
    _output.print(f"wrote {out}: {len(found)} signs", soft_wrap=True)


@app.command()
def schema() -> None:
    """The JSON Schema of an entry."""
    print(json.dumps(sign_json_schema(), indent=2, ensure_ascii=False))


def main() -> None:
    """Run the command."""
    app()


def _render_one(out: Path, sign: Sign) -> None:
    from teo_signs.pictures import save_film, save_picture  # drawing takes a second to load

    if out.suffix not in (".png", ".mp4"):
        raise LutError("bad_arguments", f"--out: expected a .png or .mp4 file, got {out.name!r}")
    out.parent.mkdir(parents=True, exist_ok=True)
    if out.suffix == ".png":
        save_picture(out, sign)
    else:
        save_film(out, sign)
    _output.print(f"wrote {out}", soft_wrap=True)


def _render_sheets(out: Path, signs: Lut) -> None:
    from teo_signs.pictures import save_sheet

    out.mkdir(parents=True, exist_ok=True)
    for kind, name in (("letter", "letters.png"), ("number", "numbers.png"), ("lexical", "signs.png")):
        chosen = signs_of_kind(signs, kind)
        if chosen:
            save_sheet(out / name, chosen)
            _output.print(f"wrote {out / name}: {len(chosen)} signs", soft_wrap=True)
