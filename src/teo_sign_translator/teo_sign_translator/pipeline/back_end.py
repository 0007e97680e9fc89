# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The interface of back ends: from the clauses of a text to the output words of its sentences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import entry_points
from pathlib import Path
from typing import Protocol

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.output.output_words import OutputWord
from teo_sign_translator.text.reading import Clause, SentenceType

#: Group of entry points under which other packages offer back ends: the schema of the models' cards, and a
#: function of name, folder of the models and text folder of the language.
_BACK_ENDS = "teo_sign_translator.back_ends"


@dataclass(frozen=True, slots=True)
class TranslatedSentence:
    """One sentence of a text, translated.

    Attributes:
        clauses: At least one.
        output_words: Its output words and pauses, in signing order.
        recognised: Its type as far as the translation tells; counts only if no mark was typed.
        reliability: How likely it is right as a whole, 0 to 1; None if that is not known.
    """

    clauses: Sequence[Clause]
    output_words: Sequence[OutputWord]
    recognised: SentenceType | None
    reliability: float | None = None


class BackEnd(Protocol):
    """Translates sentences with a model."""

    @property
    def name(self) -> str:
        """Of the model."""

    def translate(self, texts: Sequence[Sequence[Clause]]) -> list[list[TranslatedSentence]]:
        """Translate texts.

        Args:
            texts: The clauses of each.

        Returns:
            The sentences of each text, in its order; every word of the text is among the
            words of their output.
        """


def load_other_back_end(name: str, schema: object, directory: Path, text: Path) -> BackEnd:
    """Load a model of a kind that another package runs, as `teo_sign_training` runs the paper's.

    Args:
        name: Of the model.
        schema: Of its card.
        directory: Folder of the models.
        text: Text folder of the language.

    Raises:
        TranslationError: "invalid_model"; "model_not_installed" if no installed package runs such models.
    """
    for point in entry_points(group=_BACK_ENDS, name=str(schema)):
        back_end: BackEnd = point.load()(name, directory, text)
        return back_end
    raise TranslationError(
        "model_not_installed",
        f"expected a package that runs the model '{name}' (schema {schema}), found none; "
        "install the studio: `make setup` in the checkout builds it",
    )
