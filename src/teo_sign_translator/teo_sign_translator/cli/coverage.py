# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut coverage`: which words of a text a table has signs for, and which it should get next."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from teo_common.parameters import ROBOT
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.output.sign_coverage import (
    LEAST_STANDING,
    STANDINGS,
    Coverage,
    Showing,
    most_wanted,
    read_signs,
    shown_words,
)
from teo_sign_translator.output.translation import Sentence

#: Lines of a file that are translated together [lines]: the bar moves, and more are no faster.
_TOGETHER = 64
#: Missing signs that are listed: a screen of them, which is a teacher's afternoon before the camera.
_DEFAULT_WANTED = 30

_STYLES = {
    Showing.SIGN: "green",
    Showing.NUMBER: "green",
    Showing.SUBSTITUTE: "cyan",
    Showing.NAME: "none",
    Showing.GUESS: "yellow",
    Showing.LETTERS: "red",
}
_MEANINGS = {
    Showing.SIGN: "a sign of its own",
    Showing.NUMBER: "number signs",
    Showing.SUBSTITUTE: "another sign that says it: a synonym, a paraphrase, a wider word",
    Showing.NAME: "a name, in letters",
    Showing.GUESS: "in letters: its sign has no source",
    Showing.LETTERS: "in letters: it has no sign",
}

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)


def coverage(
    context: typer.Context,
    file: Annotated[Path | None, typer.Argument(help="A text; each line is translated for itself.")] = None,
    text: Annotated[str | None, typer.Option(help="A text instead of a file.")] = None,
    lut: Annotated[
        Path | None,
        typer.Option(
            "--lut", help="Directory of the table; your own and, beneath it, the language's without it."
        ),
    ] = None,
    robot: Annotated[str, typer.Option(help="Name of the robot that makes the signs.")] = str(ROBOT.default),
    language: Annotated[str, typer.Option(help="Sign language, by its ISO 639-3 code.")] = DEFAULT_LANGUAGE,
    least_standing: Annotated[
        str,
        typer.Option(help=f"Signs that are less well founded do not count, one of {', '.join(STANDINGS)}."),
    ] = LEAST_STANDING,
    wanted: Annotated[
        int, typer.Option(min=0, help="How many of the missing signs to list, the most frequent first.")
    ] = _DEFAULT_WANTED,
    as_json: Annotated[bool, typer.Option("--json", help="Everything as one JSON object.")] = False,
) -> None:
    """Which words of a text are signed, said by another sign, or spelled; and which signs to record next.

    Exit status: 0, 1 if a line could not be translated or a file not be read, 2 wrong options.
    """
    from teo_sign_translator.pipeline.translator import Translator  # slow to load: not for every `lut`

    if (file is None) == (text is None):
        raise typer.BadParameter("expected either a file or --text")
    try:
        # `lut` tells where a robot's signs are; by itself the command knows no table.
        told = context.obj(language, robot) if context.obj is not None else ()
        tables = (lut,) if lut is not None else tuple(told)
        if not tables:
            raise TranslationError(
                "invalid_data", "expected a table of signs, found none: name one with --lut"
            )
        signs: frozenset[str] = frozenset()
        guesses: frozenset[str] = frozenset()
        for table in reversed(tables):  # the first, which is sought first, has the last word
            held, good = read_signs(table, STANDINGS[-1]), read_signs(table, least_standing)
            signs, guesses = (signs - held) | good, (guesses - good) | (held - good)
        lines = [text] if text is not None else _lines(file)
        translator = Translator.load(language=language)
    except TranslationError as error:
        _fail(error)
    counted, sentences, refused = Coverage(), list[Sentence](), 0
    lines = [line for line in lines if line.strip()]
    batches = [lines[start : start + _TOGETHER] for start in range(0, len(lines), _TOGETHER)]
    for batch in track(batches, "translating", console=_errors, disable=not _errors.is_terminal):
        for line, answer in zip(batch, translator.translate_all(batch, signs), strict=True):
            if isinstance(answer, TranslationError):
                refused += 1
                _errors.print(f"{answer.code}: {answer}: {line[:60]}", markup=False, soft_wrap=True)
                continue
            counted.add(answer, guesses)
            sentences += answer.sentences
    if as_json:
        print(json.dumps(_as_dict(counted, refused), ensure_ascii=False))
    else:
        if text is not None:
            for sentence in sentences:
                _print_sentence(sentence, guesses)
        _print_counts(counted, wanted)
    raise typer.Exit(int(refused > 0))


def _lines(file: Path | None) -> list[str]:
    assert file is not None
    try:
        return file.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise TranslationError("invalid_data", f"expected a readable UTF-8 text, got: {error}") from None


def _print_sentence(sentence: Sentence, guesses: frozenset[str]) -> None:
    table = Table("word", "shown by", "how", box=None, title=sentence.text, title_justify="left")
    for word in shown_words(sentence, guesses):
        signs = ("-" if word.showing in (Showing.LETTERS, Showing.GUESS, Showing.NAME) else " ").join(
            word.signs
        )
        style = _STYLES[word.showing]
        table.add_row(word.gloss, f"[{style}]{signs}[/{style}]", _MEANINGS[word.showing])
    _output.print(table)
    if sentence.dropped:
        _output.print(f"not signed: {' '.join(sentence.dropped)}", markup=False)


def _print_counts(counted: Coverage, wanted: int) -> None:
    table = Table("shown by", "words", "share", box=None)
    for showing in Showing:
        share = counted.showings[showing] / max(counted.words, 1)
        table.add_row(_MEANINGS[showing], str(counted.showings[showing]), f"{100 * share:.0f} %")
    _output.print(table)
    _output.print(
        f"{counted.signed} of {counted.words} words signed; {counted.whole} of {counted.sentences} sentences "
        "without a spelled word but names",
        soft_wrap=True,
    )
    missing = list(most_wanted(counted, wanted))
    if missing:
        table = Table("wanted next", "times", "of all words", "first in", box=None)
        for gloss, times in missing:
            name = f"{gloss} (a guess so far)" if gloss in counted.guessed else gloss
            of_all = f"{100 * times / counted.words:.1f} %"
            table.add_row(name, str(times), of_all, counted.examples[gloss][:60])
        _output.print(table)


def _as_dict(counted: Coverage, refused: int) -> dict[str, object]:
    return {
        "words": counted.words,
        "signed": counted.signed,
        "showings": {str(showing): counted.showings[showing] for showing in Showing},
        "sentences": counted.sentences,
        "whole": counted.whole,
        "refused_lines": refused,
        "missing": dict(counted.missing.most_common()),
        "guessed": dict(counted.guessed.most_common()),
        "dropped": dict(counted.dropped.most_common()),
    }


def _fail(error: TranslationError) -> NoReturn:
    _errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)
    raise typer.Exit(1) from error
