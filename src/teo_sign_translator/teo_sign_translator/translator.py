"""Spanish text to sign tokens."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from teo_sign_translator.drafts import PAUSE, Draft, divide, hand_over, number_tokens
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.glosses import GlossList
from teo_sign_translator.known_sentences import KnownSentences
from teo_sign_translator.model_store import DEFAULT_MODEL, load_model
from teo_sign_translator.normalisation import clean
from teo_sign_translator.pairs import training_pairs
from teo_sign_translator.phrasebook import Match, Phrasebook
from teo_sign_translator.reading import Clause, Word, WordKind, read
from teo_sign_translator.sentence_type import SentenceType, is_negated, sentence_type
from teo_sign_translator.seq2seq import SequenceModel
from teo_sign_translator.spelling import unsignable
from teo_sign_translator.translation import Sentence, Translation
from teo_sign_translator.word_by_word import SPELLED_CONFIDENCE, word_by_word

#: Probability below which a token of the model is not believed, and the sentence is signed word by word
#: instead.
DEFAULT_MIN_CONFIDENCE = 0.5

#: Tokens that a `teo_sign_msgs/SignSentence` can hold; a longer sentence is divided.
MAX_SENTENCE_TOKENS = 1024

# Clauses that are tried as one sentence of the training data; "Venga, levántate, que tienes que ir al
# colegio" has three.
_MOST_CLAUSES = 4
# Characters that an error names, so that a page in another script gives a readable message.
_NAMED_CHARACTERS = 5


@dataclass(frozen=True, slots=True)
class _Unit:
    """Clauses that are translated together, and what that gave.

    Attributes:
        clauses: One, or several that are one sentence of the training data.
        drafts: Their output words.
        known: Type of the sentence of the training data that ends the unit; None if it is none.
    """

    clauses: Sequence[Clause]
    drafts: list[Draft]
    known: SentenceType | None


class Translator:
    """Translates text with a model, and word by word where the model cannot be believed.

    A sentence of the training data is left to the model. Another sentence is shown to the model if it knows
    its words; its answer is taken if every gloss stands for a word of the sentence, every word is covered,
    and it is sure. Whatever is left is signed word by word: listed words by their gloss, numbers by digits,
    all others spelled.
    """

    def __init__(
        self,
        model: SequenceModel,
        phrasebook: Phrasebook,
        glosses: GlossList,
        *,
        name: str,
        min_confidence: float = DEFAULT_MIN_CONFIDENCE,
    ) -> None:
        """Put the parts together; `load` does it for a model that ships with the package.

        Args:
            model: Reads and writes the tokens of the phrasebook's sentences.
            phrasebook: The sentences that the model was trained on.
            glosses: Words with a sign of their own.
            name: Of the model, for the record.
            min_confidence: Probability below which a token of the model is not believed, 0 to 1.
        """
        self._sentences = KnownSentences(model, phrasebook, glosses, min_confidence=min_confidence)
        self._phrasebook = phrasebook
        self._glosses = glosses
        self.name = name

    @classmethod
    def load(
        cls,
        name: str = DEFAULT_MODEL,
        directory: Path | None = None,
        *,
        min_confidence: float = DEFAULT_MIN_CONFIDENCE,
    ) -> Translator:
        """Load a model and the package's data.

        Args:
            name: One of `model_store.available_models`.
            directory: Folder of the models; by default the package's.
            min_confidence: Probability below which a token of the model is not believed, 0 to 1.

        Raises:
            TranslationError: "unknown_model", "invalid_model", "invalid_data".
        """
        glosses = GlossList.load()
        phrasebook = Phrasebook(training_pairs(), glosses)
        return cls(load_model(name, directory), phrasebook, glosses, name=name, min_confidence=min_confidence)

    def translate(self, text: str) -> Translation:
        """Translate a text of one or more sentences.

        Every word of the text is a source word of some token. A text is translated as a whole or refused as a
        whole: half of what someone says may be the opposite of it.

        Raises:
            TranslationError: "empty_text", "nothing_to_sign" (no words), "text_too_long", "broken_encoding",
                "unsignable_text" (letters that the LSE alphabet cannot spell).
        """
        cleaned = clean(text)
        reading = read(cleaned.text)
        ignored = cleaned.ignored + reading.ignored
        if not reading.clauses:
            if not cleaned.text.strip():
                raise TranslationError("empty_text", "expected Spanish text, got nothing but blanks")
            raise TranslationError(
                "nothing_to_sign",
                f"expected words, got only marks or symbols: {_shortened(cleaned.text.strip())}",
            )
        _refuse_other_scripts(reading.clauses)
        sentences = [
            sentence
            for units in self._by_sentence(reading.clauses)
            for sentence in _finish(units, cleaned.text)
        ]
        return Translation(text=text, sentences=tuple(sentences), ignored=ignored, model=self.name)

    def _by_sentence(self, clauses: Sequence[Clause]) -> list[list[_Unit]]:
        """Translate the clauses of a text, grouped by sentence."""
        sentences: list[list[_Unit]] = [[]]
        index = 0
        while index < len(clauses):
            unit = self._known_run(clauses, index) or self._unit(clauses[index])
            sentences[-1].append(unit)
            index += len(unit.clauses)
            if unit.clauses[-1].closes:
                sentences.append([])
        return [units for units in sentences if units]

    def _known_run(self, clauses: Sequence[Clause], start: int) -> _Unit | None:
        """The longest run of clauses from a place on that is one sentence of the training data."""
        for size in range(min(_MOST_CLAUSES, len(clauses) - start), 1, -1):
            run = clauses[start : start + size]
            words = [word for clause in run for word in clause.words]
            if len(words) > self._phrasebook.longest:
                continue
            stops = any(clause.closes for clause in run[:-1])
            match = self._phrasebook.match(words, crosses_stop=stops, crosses_pause=True)
            drafts = self._sentences.translate(match, run) if match else None
            if match and drafts:
                return _Unit(run, drafts, match.pattern.type)
        return None

    def _unit(self, clause: Clause) -> _Unit:
        """Translate one clause."""
        known: SentenceType | None = None
        pieces = self._pieces(clause.words)
        drafts: list[Draft] = []
        for index, piece in enumerate(pieces):
            part = replace(clause, end=clause.end if index == len(pieces) - 1 else "")
            if isinstance(piece, Match):
                translated = self._sentences.translate(piece, [part])
                words = tuple(word for group in piece.words for word in group)
                known = piece.pattern.type
            else:
                translated, words, known = None, tuple(piece), None
            translated = translated or self._sentences.translate_similar(words, part.end)
            drafts += translated or word_by_word(words, self._glosses)
        return _Unit([clause], drafts, known)

    def _pieces(self, words: Sequence[Word]) -> list[Match | Sequence[Word]]:
        """Find sentences of the training data in a clause: all of it, behind a greeting, joined by "y"."""
        whole = self._known_pieces(words)
        if whole:
            return whole
        joined: list[tuple[list[Word], list[Match | Sequence[Word]]]] = []
        rest: list[Word] = []
        for word in [*words, None]:
            if word is None or word.fold in ("y", "e"):
                conjunction = rest[:1] if rest and rest[0].fold in ("y", "e") else []
                joined.append((conjunction, self._known_pieces(rest[len(conjunction) :])))
                joined[-1] = (rest, joined[-1][1])
                rest = []
            if word is not None:
                rest.append(word)
        if not any(known for _, known in joined):
            return [words]
        result: list[Match | Sequence[Word]] = []
        unknown: list[Word] = []
        for piece, known in joined:
            if not known:
                unknown += piece
                continue
            if piece[0].fold in ("y", "e"):
                unknown.append(piece[0])
            if unknown:
                result.append(unknown)
                unknown = []
            result += known
        return [*result, unknown] if unknown else result

    def _known_pieces(self, words: Sequence[Word]) -> list[Match | Sequence[Word]]:
        """A sentence of the training data, alone or behind a greeting without a comma; empty if neither."""
        before: list[Match | Sequence[Word]] = []
        while words:
            match = self._phrasebook.match(words)
            if match:
                return [*before, match]
            found = self._glosses.find_longest([word.lower for word in words[: self._glosses.longest]])
            if not found or not found[0].interjection:
                return []
            before.append(words[: found[1]])
            words = words[found[1] :]
        return []


def _finish(units: Sequence[_Unit], text: str) -> list[Sentence]:
    """One sentence as messages hold it; several if it has more tokens than they can hold."""
    clauses = [clause for unit in units for clause in unit.clauses]
    drafts: list[Draft] = []
    for unit in units:
        drafts += [*([PAUSE] if drafts else []), *unit.drafts]
    kind = sentence_type(clauses)
    unmarked = not clauses[-1].end and not any(clause.opening for clause in clauses)
    if unmarked and units[-1].known is not None:
        kind = units[-1].known
    return [
        Sentence(
            text=text[clauses[0].start : clauses[-1].stop].strip(),
            type=kind,
            negated=is_negated(clauses),
            tokens=number_tokens(part),
        )
        for part in divide(hand_over(drafts, SPELLED_CONFIDENCE), MAX_SENTENCE_TOKENS)
    ]


def _refuse_other_scripts(clauses: Sequence[Clause]) -> None:
    """Refuse letters that the LSE alphabet cannot spell, by name."""
    words = (word for clause in clauses for word in clause.words if word.kind is WordKind.LETTERS)
    found = list(
        dict.fromkeys(
            c for word in words for part in (word.stands_for or word.text).split() for c in unsignable(part)
        )
    )
    if found:
        named = ", ".join(
            f"'{c}' ({unicodedata.name(c, f'U+{ord(c):04X}')})" for c in found[:_NAMED_CHARACTERS]
        )
        more = f" and {len(found) - _NAMED_CHARACTERS} more" if len(found) > _NAMED_CHARACTERS else ""
        raise TranslationError(
            "unsignable_text",
            f"expected words in Latin letters, got {named}{more}, which LSE cannot spell: transcribe them",
        )


def _shortened(text: str, length: int = 20) -> str:
    return text if len(text) <= length else text[:length] + "…"
