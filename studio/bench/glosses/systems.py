# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What translates Spanish in the benches, and the sentences that it is given."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from glosses.accepted_translations import accepted, plain_gloss
from glosses.baselines import lemmas_in_spanish_order, spoken_to_signed
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pipeline.translator import Translator

Glosses = tuple[str, ...]
System = Callable[[str], Glosses]

SENTENCES = Path(__file__).parents[3] / "test" / "data"


def systems(ours: Translator | None = None) -> dict[str, System]:
    """By name: our model, the paper's, the trivial baseline and a peer; glosses by their `plain_gloss`.

    Args:
        ours: The shipped translator by default.
    """
    return {
        "ours": _translating(ours or Translator.load()),
        "paper's": _translating(Translator.load("lstm256")),
        "lemmas": lambda sentence: plain(lemmas_in_spanish_order(sentence)),
        "spoken-to-signed": lambda sentence: plain(spoken_to_signed(sentence)),
    }


def judged(name: str) -> list[tuple[str, frozenset[Glosses]]]:
    """The sentences of a file of test/data with the translations that are accepted for each."""
    pairs = zip(lines(f"{name}.txt"), lines(f"{name}.glosses"), strict=True)
    return [(sentence, accepted(pattern)) for sentence, pattern in pairs]


def lines(file: str) -> list[str]:
    """Lines of a file of test/data."""
    return (SENTENCES / file).read_text(encoding="utf-8").splitlines()


def plain(glosses: Glosses) -> Glosses:
    """Glosses as they are compared."""
    return tuple(map(plain_gloss, glosses))


def _translating(translator: Translator) -> System:
    def translate(sentence: str) -> Glosses:
        try:
            return plain(tuple(str(translator.translate(sentence)).split()))
        except TranslationError as error:
            return (f"[{error.code}]",)

    return translate
