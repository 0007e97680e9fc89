# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Text to sign tokens."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence, Set
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, load_language
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_files import read_card
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.output.output_words import (
    OutputWord,
    Spelling,
    divide,
    number_tokens,
    without_carried,
)
from teo_sign_translator.output.senses import SENSES, Sense, read_senses, with_senses
from teo_sign_translator.output.sign_choice import (
    INCORPORATED_NUMBERS,
    Incorporated,
    SignChooser,
    SubstituteLists,
    Substitutes,
    read_incorporated,
    with_numbers_incorporated,
)
from teo_sign_translator.output.translation import Sentence, Translation
from teo_sign_translator.pipeline.agreement import Agreement
from teo_sign_translator.pipeline.back_end import BackEnd, TranslatedSentence, load_other_back_end
from teo_sign_translator.pipeline.completeness import Completeness
from teo_sign_translator.pipeline.pointer_back_end import (
    DEFAULT_BEAM_WIDTH,
    PointerBackEnd,
    read_given_sentences,
)
from teo_sign_translator.pointer import load_sentence_model
from teo_sign_translator.pointer.config import POINTER
from teo_sign_translator.pointer.decoding import SCHEMA
from teo_sign_translator.text.cleaning import clean
from teo_sign_translator.text.other_languages import OtherLanguages
from teo_sign_translator.text.reading import Clause, WordKind, is_negated, read, sentence_type
from teo_sign_translator.text.rules import TextRules

#: Of the models that ship: translates sentences that it has not seen.
DEFAULT_MODEL = POINTER

#: Probability of a token below which its sentence is called uncertain: of 900 held-out sentences, half of the
#: wrong translations are, and 2 % of the right ones.
DEFAULT_MIN_CONFIDENCE = 0.7

#: Tokens that a `teo_sign_msgs/SignSentence` can hold; a longer sentence is divided.
MAX_SENTENCE_TOKENS = 1024

# A title in quotes begins with a capital; behind a colon it is what somebody says.
_TITLE = re.compile(r"(?<!: )[«“\"]([^\W\d_a-zà-ÿ][^»”\"]+)[»”\"]")

# Characters that an error names, so that a page in another script gives a readable message.
_NAMED_CHARACTERS = 5


class _Read(NamedTuple):
    """A text that has been read.

    Attributes:
        text: As given.
        cleaned: What the clauses' places count in.
        clauses: At least one.
        ignored: Characters that nothing is signed for.
    """

    text: str
    cleaned: str
    clauses: tuple[Clause, ...]
    ignored: tuple[str, ...]


class Translator:
    """Translates texts with a back end, each token with a confidence."""

    def __init__(
        self,
        back_end: BackEnd,
        chooser: SignChooser,
        rules: TextRules | None = None,
        spelling: Spelling | None = None,
        incorporated: Incorporated | None = None,
        senses: Sequence[Sense] = (),
        others: OtherLanguages | None = None,
        *,
        min_confidence: float = DEFAULT_MIN_CONFIDENCE,
        language: str = DEFAULT_LANGUAGE,
    ) -> None:
        """Put the parts together; `load` does it for a model that ships with the package.

        Args:
            back_end: Translates sentences.
            chooser: Finds signs for glosses.
            rules: How its texts are read; by default the default language's.
            spelling: Its alphabet; by default the default language's.
            incorporated: Glosses that take up a number; None for none.
            senses: What is signed where a gloss's sign says another sense.
            others: Recognises texts of other languages; None takes all for its own.
            min_confidence: A sentence that holds a token less sure than this is called uncertain, 0 to 1.
            language: Code of the sign language that it translates into.
        """
        self.language = language
        self._back_end = back_end
        self._chooser = chooser
        self._rules = rules or TextRules.load()
        self._spelling = spelling or Spelling.load()
        self._incorporated = incorporated or {}
        self._senses = senses
        self._others = others
        self.min_confidence = min_confidence

    @classmethod
    def load(
        cls,
        name: str = DEFAULT_MODEL,
        directory: Path | None = None,
        *,
        beam_width: int = DEFAULT_BEAM_WIDTH,
        min_confidence: float = DEFAULT_MIN_CONFIDENCE,
        substitutes: Substitutes = Substitutes.PARAPHRASE,
        language: str = DEFAULT_LANGUAGE,
    ) -> Translator:
        """Load a model and its language's data.

        Args:
            name: One of `model_files.available_models`.
            directory: Folder of the models; by default the language's.
            beam_width: Translations that the model weighs against each other; `lstm256` has but one.
            min_confidence: A sentence that holds a token less sure than this is called uncertain, 0 to 1.
            substitutes: What may be signed in place of a gloss without a sign.
            language: Code of the sign language.

        Raises:
            TranslationError: "unknown_language", "invalid_language", "unknown_model", "invalid_model",
                "model_not_installed", "invalid_data".
        """
        try:
            data = load_language(language)
        except LanguageError as error:
            raise TranslationError(error.code, str(error)) from error
        directory = directory or data.models
        rules = TextRules.load(data.text)
        spelling = Spelling(data)
        lists = SubstituteLists.load(data.text)
        schema = read_card(name, directory).get("schema")
        others = None
        if schema == SCHEMA:
            morphology = Morphology.load(data.text)
            model = load_sentence_model(name, directory)
            back_end: BackEnd = PointerBackEnd(
                model,
                morphology,
                Completeness.load(data.text),
                read_given_sentences(data.text),
                Agreement.load(data.text),
                beam_width=beam_width,
            )
            chooser = SignChooser(lists, morphology, substitutes, spelling)
            others = OtherLanguages.load(data.text, data.spoken.name, morphology)
        else:
            back_end = load_other_back_end(name, schema, directory, data.text)
            chooser = SignChooser(lists, None, substitutes, spelling)
        incorporated = read_incorporated(data.text / INCORPORATED_NUMBERS)
        return cls(
            back_end,
            chooser,
            rules,
            spelling,
            incorporated,
            read_senses(data.text / SENSES),
            others,
            min_confidence=min_confidence,
            language=data.code,
        )

    @property
    def substitutes(self) -> Substitutes:
        """What may be signed in place of a gloss without a sign."""
        return self._chooser.substitutes

    @substitutes.setter
    def substitutes(self, allowed: Substitutes) -> None:
        self._chooser.substitutes = allowed

    @property
    def name(self) -> str:
        """Of the model."""
        return self._back_end.name

    def translate(self, text: str, signs: Set[str] | None = None) -> Translation:
        """Translate a text of one or more sentences.

        Args:
            text: As people type it.
            signs: Glosses that have a sign; see `SignChooser.choose`.

        Raises:
            TranslationError: "empty_text", "nothing_to_sign", "unsignable_text", "other_language",
                "text_too_long", "broken_encoding".
        """
        (answer,) = self.translate_all([text], signs)
        if isinstance(answer, TranslationError):
            raise answer
        return answer

    def translate_all(
        self, texts: Sequence[str], signs: Set[str] | None = None
    ) -> list[Translation | TranslationError]:
        """Translate many texts, faster than one by one.

        Args:
            texts: Each of one or more sentences.
            signs: Glosses that have a sign; see `SignChooser.choose`.

        Returns:
            For each text its translation, or why there is none.
        """
        read = [self._read(text) for text in texts]
        translated = iter(
            self._back_end.translate([each.clauses for each in read if isinstance(each, _Read)])
        )
        answers: list[Translation | TranslationError] = []
        for each in read:
            if isinstance(each, TranslationError):
                answers.append(each)
                continue
            sentences = [
                sentence
                for translated_sentence in next(translated)
                for sentence in self._finish(translated_sentence, each.cleaned, signs)
            ]
            answers.append(
                Translation(
                    text=each.text,
                    sentences=tuple(sentences),
                    ignored=each.ignored,
                    model=self.name,
                    language=self.language,
                )
            )
        return answers

    def _finish(
        self, translated_sentence: TranslatedSentence, text: str, signs: Set[str] | None
    ) -> list[Sentence]:
        """One sentence; several if it has more tokens than a message can hold."""
        clauses = translated_sentence.clauses
        kind = sentence_type(clauses, self._rules)
        unmarked = not clauses[-1].end and not any(clause.opening for clause in clauses)
        if unmarked and translated_sentence.recognised is not None:
            kind = translated_sentence.recognised
        signed, dropped = without_carried(translated_sentence.output_words, self._spelling)
        if signs is not None:
            signed = _titles_as_names(signed, text[clauses[0].start : clauses[-1].stop])
        meant = with_senses(signed, clauses, self._senses, signs, self._spelling)
        chosen = self._chooser.choose(meant, signs)
        typed = [word.text for clause in clauses for word in clause.words]
        output_words = with_numbers_incorporated(chosen, typed, signs, self._incorporated)
        likely = translated_sentence.reliability
        parts = [number_tokens(part) for part in divide(output_words, MAX_SENTENCE_TOKENS)]
        return [
            Sentence(
                text=text[clauses[0].start : clauses[-1].stop].strip(),
                type=kind,
                negated=is_negated(clauses, self._rules),
                tokens=tokens,
                uncertain=any(token.confidence < self.min_confidence for token in tokens),
                confidence=min(token.confidence for token in tokens) if likely is None else likely,
                dropped=() if place else dropped,
            )
            for place, tokens in enumerate(parts)
        ]

    def _read(self, text: str) -> _Read | TranslationError:
        """Clean and read a text; give the reason if it cannot be signed."""
        try:
            cleaned = clean(text)
            reading = read(cleaned.text, self._rules)
            if not reading.clauses:
                if not cleaned.text.strip():
                    raise TranslationError("empty_text", "expected text, got nothing but blanks")
                raise TranslationError(
                    "nothing_to_sign",
                    f"expected words, got only marks or symbols: {_shortened(cleaned.text.strip())}",
                )
            self._refuse_other_scripts(reading.clauses)
            self._refuse_other_languages(reading.clauses)
        except TranslationError as error:
            return error
        return _Read(text, cleaned.text, reading.clauses, cleaned.ignored + reading.ignored)

    def _refuse_other_scripts(self, clauses: Sequence[Clause]) -> None:
        """Refuse letters that the alphabet cannot spell, by name."""
        words = (word for clause in clauses for word in clause.words if word.kind is WordKind.LETTERS)
        found = list(
            dict.fromkeys(
                c
                for word in words
                for part in (word.stands_for or word.text).split()
                for c in self._spelling.unsignable(part)
            )
        )
        if found:
            named = ", ".join(
                f"'{c}' ({unicodedata.name(c, f'U+{ord(c):04X}')})" for c in found[:_NAMED_CHARACTERS]
            )
            more = f" and {len(found) - _NAMED_CHARACTERS} more" if len(found) > _NAMED_CHARACTERS else ""
            raise TranslationError(
                "unsignable_text",
                f"expected words in Latin letters, got {named}{more}, which {self._spelling.name} cannot "
                "spell: transcribe them",
            )

    def _refuse_other_languages(self, clauses: Sequence[Clause]) -> None:
        """Refuse what is not of the language that is translated, with how sure that is."""
        found = self._others.find(clauses) if self._others else None
        if self._others and found:
            spoken = self._others.spoken
            named = ", ".join(f"'{word}'" for word in found.unknown[:_NAMED_CHARACTERS])
            raise TranslationError(
                "other_language",
                f"expected {spoken}, got what looks like {found.name}: {len(found.unknown)} of "
                f"{found.words} words are not {spoken} ({named}); write it in {spoken}",
            )


def _titles_as_names(output_words: Sequence[OutputWord], sentence: str) -> list[OutputWord]:
    """Output words, those of a work's title in quotes as names: nothing is signed in place of them."""
    titled = {word for title in _TITLE.findall(sentence) for word in re.findall(r"\w+", title)}
    return [
        replace(word, is_name=True) if not titled.isdisjoint(word.words) else word for word in output_words
    ]


def _shortened(text: str, length: int = 20) -> str:
    return text if len(text) <= length else text[:length] + "…"
