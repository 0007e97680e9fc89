# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`translate`: glosses of a text, or of each line of a file, without ROS running."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator, Sequence, Set
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, BinaryIO

import typer
from rich.console import Console
from rich.progress import track

from teo_common.errors import CodedError
from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, load_language
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_files import available_models
from teo_sign_translator.output.sign_choice import Substitutes
from teo_sign_translator.output.sign_coverage import LEAST_STANDING, STANDINGS, read_signs
from teo_sign_translator.output.translation import Translation, explained
from teo_sign_translator.pipeline.pointer_back_end import DEFAULT_BEAM_WIDTH
from teo_sign_translator.pipeline.translator import DEFAULT_MODEL, Translator

#: Lines of a file that are translated together [lines]: more are no faster, and nothing is written until
#: they are done.
_TOGETHER = 256

app = typer.Typer(add_completion=False, rich_markup_mode=None)


@app.command()
def translate(
    text: Annotated[
        str | None,
        typer.Argument(help="Text in the spoken language; put a blank before one that begins with -."),
    ] = None,
    stdin: Annotated[
        bool,
        typer.Option("--stdin", help="Read texts from standard input, one a line, and answer each at once."),
    ] = False,
    file: Annotated[
        Path | None,
        typer.Option(
            "--file", help="Read texts from a file, one a line; many are translated together.", dir_okay=False
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Write everything, one JSON object a text.")
    ] = False,
    explain: Annotated[
        bool, typer.Option("--explain", help="Write why each token is there, and where each word went.")
    ] = False,
    language: Annotated[str, typer.Option(help="Sign language, by its ISO 639-3 code.")] = DEFAULT_LANGUAGE,
    model: Annotated[
        str, typer.Option(help="Model to use, one of those that --list-models lists.")
    ] = DEFAULT_MODEL,
    beam: Annotated[
        int, typer.Option(min=1, max=16, help="Translations that the model weighs against each other.")
    ] = DEFAULT_BEAM_WIDTH,
    signs: Annotated[
        Path | None,
        typer.Option(
            help="Which glosses have signs: a file with one a line, or the folder of a table's entries "
            "(*.json); what has none is shown by others, see --substitutes, or spelled."
        ),
    ] = None,
    least_standing: Annotated[
        str,
        typer.Option(
            help=f"With a table: the least founded signs that count, one of {', '.join(STANDINGS)}."
        ),
    ] = LEAST_STANDING,
    substitutes: Annotated[
        str,
        typer.Option(
            help="What may be signed for a word without a sign, one of "
            f"{', '.join(each.name.lower() for each in Substitutes)}; each allows those before it too."
        ),
    ] = Substitutes.PARAPHRASE.name.lower(),
    list_models: Annotated[
        bool, typer.Option("--list-models", help="Write the names of the language's models and stop.")
    ] = False,
) -> None:
    """Translate text to glosses of a sign language: Spanish to Spanish Sign Language, if none is named.

    Writes one line for each text: glosses separated by spaces, a spelled word as A-N-A, a number as 12. A
    line that cannot be translated gives an empty line, or a JSON object with "error", and a reason on
    standard error; the others are translated all the same, and the exit status is 1. A blank line gives a
    blank line and is no error.
    """
    if not list_models and (text is not None) + stdin + (file is not None) != 1:
        raise typer.BadParameter("expected either a text, --stdin or --file")
    if explain and (as_json or text is None):
        raise typer.BadParameter("expected --explain with one text and without --json, which has it all")
    try:
        if list_models:
            print(*available_models(load_language(language).models), sep="\n")
            return
        writer = _Writer(
            Translator.load(
                model, beam_width=beam, substitutes=Substitutes.named(substitutes), language=language
            ),
            read_signs(signs, least_standing) if signs else None,
            as_json=as_json,
            explain=explain,
        )
    except (TranslationError, LanguageError) as error:
        _complain("", error)
        raise typer.Exit(1) from None
    if text is not None:
        writer.write_text(text)
    elif file is None:
        for number, line in enumerate(_lines(sys.stdin.buffer), start=1):
            writer.write_lines(number, [line])
    else:
        try:
            with file.open("rb") as content:
                lines = list(_lines(content))
        except OSError as error:
            _complain("", TranslationError("invalid_data", f"expected a readable file: {error}"))
            raise typer.Exit(1) from None
        for number, some in _progress(lines):
            writer.write_lines(number, some)
    raise typer.Exit(int(writer.failed))


@dataclass
class _Writer:
    """Translates texts and writes the answers.

    Attributes:
        translator: Translates.
        signs: Glosses that have signs; None if that is not known.
        as_json: Whether everything is written.
        explain: Whether a translation's tokens are explained instead.
        failed: Whether a text could not be translated.
    """

    translator: Translator
    signs: Set[str] | None
    as_json: bool
    explain: bool
    failed: bool = False

    def write_text(self, text: str) -> None:
        """Write the translation of one text, or on standard error why there is none."""
        (answer,) = self.translator.translate_all([text], self.signs)
        if isinstance(answer, TranslationError):
            self._complain("", answer)
            if not self.as_json:
                return
        self._print(text, answer)

    def write_lines(self, number: int, lines: Sequence[str]) -> None:
        """Write a line for each line; the first has the given number, which a refusal names."""
        answers = iter(self.translator.translate_all([line for line in lines if line.strip()], self.signs))
        for place, line in enumerate(lines, start=number):
            answer = next(answers) if line.strip() else None
            if isinstance(answer, TranslationError):
                self._complain(f"line {place}: ", answer)
            self._print(line, answer)

    def _print(self, text: str, answer: Translation | TranslationError | None) -> None:
        if self.explain and isinstance(answer, Translation):
            print(*explained(answer), sep="\n")
            return
        if not self.as_json:
            print(answer if isinstance(answer, Translation) else "", flush=True)
            return
        content: dict[str, Any] = {"text": text, "glosses": "", "sentences": []}
        if isinstance(answer, Translation):
            content = answer.as_dict()
        elif answer is not None:
            content["error"] = {"code": answer.code, "message": str(answer)}
        print(json.dumps(content, ensure_ascii=False), flush=True)

    def _complain(self, place: str, error: TranslationError) -> None:
        self.failed = True
        _complain(place, error)


def _lines(file: BinaryIO) -> Iterator[str]:
    """Lines of a file; bytes that are no UTF-8 become lone surrogates, which are refused later."""
    for line in file:
        yield line.decode("utf-8", errors="surrogateescape").rstrip("\r\n")


def _progress(lines: Sequence[str]) -> Iterable[tuple[int, Sequence[str]]]:
    """Line numbers and lines, many at a time; with a bar if the translations do not go to the same screen."""
    numbered = [(start + 1, lines[start : start + _TOGETHER]) for start in range(0, len(lines), _TOGETHER)]
    console = Console(stderr=True)
    return track(
        numbered, "translating", console=console, disable=sys.stdout.isatty() or not console.is_terminal
    )


def _complain(place: str, error: CodedError) -> None:
    print(f"{place}{error.code}: {error}", file=sys.stderr, flush=True)


def main() -> None:
    """Run the command line."""
    # Whatever the locale says, Spanish goes out as UTF-8; what a text held of broken bytes is escaped.
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="backslashreplace")  # type: ignore[union-attr]
    try:
        app()
    except BrokenPipeError:  # the reader has seen enough, e.g. `head`
        sys.stderr.close()
        raise SystemExit(1) from None


if __name__ == "__main__":
    main()
