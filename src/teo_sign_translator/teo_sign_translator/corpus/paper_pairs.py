"""The paper's and the project's own pairs: as published, with their words aligned, and as corpus pairs."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_sign_translator.corpus.pairs_file import Pair
from teo_sign_translator.data_files import data_file, read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.text.source_words import SourceWord, source_words

#: Stand in sentences and glosses for any name and any number.
NAME = "{nombre}"
NUMBER = "{número}"
SLOTS = (NAME, NUMBER)

_ALIGNED = re.compile(r"(?P<gloss>[^()]+)\((?P<words>[^()]*)\)")

#: Fill the slots of the pairs; common names of different lengths, and ages.
_NAMES = (
    "Ana",
    "Juan",
    "Lucía",
    "Pedro",
    "María",
    "Carlos",
    "Sofía",
    "Miguel",
    "Elena",
    "Javier",
    "Carmen",
    "David",
)
_NUMBERS = ("7", "12", "23", "35", "41", "8", "64", "19", "nueve", "diez", "treinta", "dieciocho")


@dataclass(frozen=True, slots=True)
class PublishedPair:
    """A Spanish sentence and its glosses, as written."""

    sentence: str
    glosses: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class AlignedPair:
    """A Spanish sentence whose glosses name the words they stand for.

    Attributes:
        sentence: Spanish, with slots.
        glosses: Upper case with `_` for spaces, or a slot.
        sources: For each gloss the words (lower case) that it stands for; empty where nothing in the sentence
            says it.
    """

    sentence: str
    glosses: tuple[str, ...]
    sources: tuple[tuple[str, ...], ...]


def gloss_name(written: str) -> str:
    """A gloss as the look-up table names it: `"Por favor"` is `"POR_FAVOR"`."""
    return written.strip().upper().replace(" ", "_")


def read_pairs(path: Path) -> list[PublishedPair]:
    """Read a file of sentences and glosses.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return [
        PublishedPair(sentence, tuple(gloss.strip() for gloss in glosses.split("/")))
        for _, (sentence, glosses) in read_rows(path, columns=2)
    ]


def paper_pairs() -> list[PublishedPair]:
    """The paper's 39 pairs, in its order."""
    return read_pairs(data_file("paper_pairs.tsv"))


def paper_predictions() -> list[PublishedPair]:
    """What the paper's model predicts at learning rate 0.0001 for the first ten sentences."""
    return read_pairs(data_file("paper_predictions.tsv"))


def read_aligned_pairs(path: Path) -> list[AlignedPair]:
    """Read a file of sentences and aligned glosses; `data/paper_alignment.tsv` explains the notation.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return [
        _aligned(path, number, sentence, glosses)
        for number, (sentence, glosses) in read_rows(path, columns=2)
    ]


def training_pairs() -> list[AlignedPair]:
    """What the shipped model is trained on: the paper's sentences, then the project's."""
    return [pair for path in _training_files() for pair in read_aligned_pairs(path)]


def training_data_hash() -> str:
    """SHA-256 of the files behind `training_pairs`, hexadecimal."""
    digest = hashlib.sha256()
    for path in _training_files():
        digest.update(path.read_bytes())
    return digest.hexdigest()


def own_pairs(morphology: Morphology) -> Iterator[Pair]:
    """Yield the pairs that the translator must know exactly, slots filled with names and numbers."""
    for pair in training_pairs():
        slot = next((slot for slot in (NAME, NUMBER) if slot in pair.glosses), "")
        for value in {NAME: _NAMES, NUMBER: _NUMBERS}.get(slot, ("",)):
            yield _filled(pair, slot, value, morphology)


def _training_files() -> tuple[Path, Path]:
    return data_file("paper_alignment.tsv"), data_file("project_pairs.tsv")


def _aligned(path: Path, number: int, sentence: str, glosses: str) -> AlignedPair:
    names: list[str] = []
    sources: list[tuple[str, ...]] = []
    for written in glosses.split("/"):
        match = _ALIGNED.fullmatch(written)
        if written in SLOTS:
            names.append(written)
            sources.append((written,))
        elif match:
            names.append(gloss_name(match["gloss"]))
            sources.append(tuple(match["words"].lower().split()))
        else:
            raise TranslationError(
                "invalid_data",
                f"{path}, line {number}: expected 'Gloss(words)' or a slot of {SLOTS}, got '{written}'",
            )
    present = sentence.lower()
    lost = [word for words in sources for word in words if word not in present]
    if lost:
        raise TranslationError(
            "invalid_data", f"{path}, line {number}: words not in the sentence: {', '.join(lost)}"
        )
    return AlignedPair(sentence, tuple(names), tuple(sources))


def _filled(pair: AlignedPair, slot: str, value: str, morphology: Morphology) -> Pair:
    sentence = pair.sentence.replace(slot, value) if slot else pair.sentence
    words = source_words(sentence, morphology)
    forms = [word.text.lower() for word in words]
    glosses: list[str] = []
    places: list[tuple[int, ...]] = []
    for gloss, sources in zip(pair.glosses, pair.sources, strict=True):
        if gloss == slot:
            place = forms.index(value.lower()) if value.lower() in forms else _numeral(words)
            glosses.append(value.upper() if slot == NAME else words[place].form)
            places.append((place,))
        else:
            glosses.append(gloss)
            places.append(_places(forms, sources))
    return Pair(sentence, tuple(glosses), tuple(places), "paper", "train")


def _numeral(words: Sequence[SourceWord]) -> int:
    return next(place for place, word in enumerate(words) if word.form.isdigit())


def _places(forms: Sequence[str], sources: Sequence[str]) -> tuple[int, ...]:
    """Where the words are; the last place of a word that occurs twice, next to what it says."""
    return tuple(
        sorted(
            {
                max(place for place, form in enumerate(forms) if form == source)
                for source in sources
                if source in forms
            }
        )
    )
