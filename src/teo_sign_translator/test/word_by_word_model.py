# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sentence model that needs no training: each word by its likeliest reading, in Spanish order."""

from __future__ import annotations

from collections.abc import Sequence

from loaded import TEXT, morphology

from teo_sign_translator.output.sign_choice import SignChooser, SubstituteLists
from teo_sign_translator.pipeline.agreement import Agreement
from teo_sign_translator.pipeline.completeness import Completeness, FunctionWords
from teo_sign_translator.pipeline.pointer_back_end import PointerBackEnd, read_given_sentences
from teo_sign_translator.pipeline.translator import Translator
from teo_sign_translator.pointer import Hypothesis, OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_word import SourceWord


class WordByWordModel:
    """Copies words; leaves out those it is told to lose."""

    name = "word by word"

    def __init__(self, *, loses: Sequence[str] = (), reverse: bool = False, probability: float = 0.9) -> None:
        self._loses = set(loses)
        self._reverse = reverse
        self._probability = probability
        self._function_words = FunctionWords.load(morphology().folder / "function_words.tsv")

    def translate(self, words: Sequence[SourceWord], *, beam: int = 1) -> tuple[Hypothesis, ...]:
        kept = [
            OutputGloss(copied_gloss(word.readings[0]), (place,), self._probability, True)
            for place, word in enumerate(words)
            if word.form not in self._loses and not self._function_words.may_be_left_out(word)
        ]
        return (Hypothesis(tuple(reversed(kept) if self._reverse else kept), -1.0),)[:beam]

    def translate_all(
        self, sentences: Sequence[Sequence[SourceWord]], *, beam: int = 1, unsaid: object = None
    ) -> tuple[tuple[Hypothesis, ...], ...]:
        del unsaid
        return tuple(self.translate(words, beam=beam) for words in sentences)


def translator_with(model: object) -> Translator:
    """A translator with the package's data around a model."""
    given = read_given_sentences(morphology().folder)
    back_end = PointerBackEnd(model, morphology(), Completeness.load(TEXT), given, Agreement.load(TEXT))
    return Translator(back_end, SignChooser(SubstituteLists.load(), morphology()))
