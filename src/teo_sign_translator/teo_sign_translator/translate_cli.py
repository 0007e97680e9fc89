"""`translate`: glosses of a text, or of each line of a file, without ROS running."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator
from typing import Annotated, Any

import typer

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_store import DEFAULT_MODEL, available_models
from teo_sign_translator.translation import Translation
from teo_sign_translator.translator import Translator

app = typer.Typer(add_completion=False)


@app.command()
def translate(
    text: Annotated[
        str | None, typer.Argument(help="Spanish text; put a blank before one that begins with -.")
    ] = None,
    stdin: Annotated[
        bool, typer.Option("--stdin", help="Read texts from standard input, one a line.")
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Write everything, one JSON object a text.")
    ] = False,
    model: Annotated[
        str, typer.Option(help=f"Model to use, one of: {', '.join(available_models()) or 'none'}.")
    ] = DEFAULT_MODEL,
    list_models: Annotated[
        bool, typer.Option("--list-models", help="Write the models' names and stop.")
    ] = False,
) -> None:
    """Translate Spanish to glosses of Spanish Sign Language (LSE).

    Writes one line for each text: glosses separated by spaces, a spelled word as A-N-A, a number as 12. A
    line that cannot be translated gives an empty line, or a JSON object with "error", and a reason on
    standard error; the others are translated all the same, and the exit status is 1. A blank line gives a
    blank line and is no error.
    """
    if list_models:
        print(*available_models(), sep="\n")
        return
    if stdin == (text is not None):
        raise typer.BadParameter("expected either a text or --stdin")
    try:
        translator = Translator.load(model)
    except TranslationError as error:
        _complain("", error)
        raise typer.Exit(1) from None
    failed = False
    for number, line in _lines() if stdin else _single(text or ""):
        failed |= not _answer(translator, line, place=f"line {number}: " if stdin else "", as_json=as_json)
    raise typer.Exit(int(failed))


def _answer(translator: Translator, text: str, *, place: str, as_json: bool) -> bool:
    """Write the translation of one text; return whether there is one, or nothing to translate."""
    result: Translation | None = None
    problem: TranslationError | None = None
    blank = bool(place) and not text.strip()
    if not blank:
        try:
            result = translator.translate(text)
        except TranslationError as error:
            problem = error
            _complain(place, error)
    if as_json:
        content: dict[str, Any] = {"text": text, "glosses": "", "sentences": []}
        if result is not None:
            content = result.as_dict()
        elif problem is not None:
            content["error"] = {"code": problem.code, "message": str(problem)}
        print(json.dumps(content, ensure_ascii=False), flush=True)
    elif result is not None or place:
        print(result or "", flush=True)
    return problem is None


def _single(text: str) -> Iterable[tuple[int, str]]:
    return [(1, text)]


def _lines() -> Iterator[tuple[int, str]]:
    """Lines of standard input; bytes that are no UTF-8 become lone surrogates, which are refused later."""
    for number, line in enumerate(sys.stdin.buffer, start=1):
        yield number, line.decode("utf-8", errors="surrogateescape").rstrip("\r\n")


def _complain(place: str, error: TranslationError) -> None:
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
