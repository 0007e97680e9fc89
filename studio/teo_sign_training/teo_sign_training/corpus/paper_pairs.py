# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences whose translation is given: the paper's, the project's, and those that people would say.

They are read as published, with their words aligned, and as training pairs. The paper's and the project's
every model has to know by heart; from the others it learns what no grammar makes.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from teo_common.text_folding import fold, without_accents
from teo_sign_training.corpus.pairs import Pair
from teo_sign_translator.data_files import data_file, invalid_line, read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology, gloss_name
from teo_sign_translator.pointer.decoding import SentenceModel
from teo_sign_translator.text.source_word import SourceWord
from teo_sign_translator.text.source_words import source_words

#: Reads a sentence as words: `source_words` with a morphology.
Reader = Callable[[str], Sequence[SourceWord]]

#: Stand in sentences and glosses for any name and any number.
NAME = "{nombre}"
NUMBER = "{número}"
SLOTS = (NAME, NUMBER)

_ALIGNED = re.compile(r"(?P<gloss>[^()]+)\((?P<words>[^()]*)\)")


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


def read_aligned_pairs(path: Path) -> list[AlignedPair]:
    """Read a file of sentences and aligned glosses; `text/paper_alignment.tsv` explains the notation.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return [
        _aligned(path, number, sentence, glosses)
        for number, (sentence, glosses) in read_rows(path, columns=2)
    ]


def training_pairs(folder: Path | None = None) -> list[AlignedPair]:
    """What the shipped model of a language must know by heart: the paper's sentences, then the project's.

    Args:
        folder: The language's text folder, by default that of the default language; one without either
            file has no such sentences.
    """
    return [pair for path in _training_files(folder) for pair in read_aligned_pairs(path)]


def _training_files(folder: Path | None = None) -> list[Path]:
    paths = (
        (folder or data_file("")) / "paper_alignment.tsv",
        (folder or data_file("")) / "project_pairs.tsv",
    )
    return [path for path in paths if path.is_file()]


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
            raise invalid_line(path, number, f"'Gloss(words)' or a slot of {SLOTS}", f"'{written}'")
    present = sentence.lower()
    lost = [word for words in sources for word in words if word not in present]
    if lost:
        raise invalid_line(path, number, "words of the sentence", ", ".join(lost))
    return AlignedPair(sentence, tuple(names), tuple(sources))


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


def _published_pairs(path: Path) -> list[PublishedPair]:
    return [
        PublishedPair(sentence, tuple(gloss.strip() for gloss in glosses.split("/")))
        for _, (sentence, glosses) in read_rows(path, columns=2)
    ]


def paper_pairs() -> list[PublishedPair]:
    """The paper's 39 pairs, in its order."""
    return _published_pairs(data_file("paper_pairs.tsv"))


def paper_predictions() -> list[PublishedPair]:
    """What the paper's model predicts at learning rate 0.0001 for the first ten sentences."""
    return _published_pairs(data_file("paper_predictions.tsv"))


def training_data_hash() -> str:
    """SHA-256 of the files behind `training_pairs`, hexadecimal."""
    digest = hashlib.sha256()
    for path in _training_files():
        digest.update(path.read_bytes())
    return digest.hexdigest()


def own_pairs(morphology: Morphology) -> Iterator[Pair]:
    """Yield the pairs that the translator must know exactly, slots filled with names and numbers."""
    read = partial(source_words, morphology=morphology)
    for pair in training_pairs(morphology.folder):
        fillings = list(zip(_NAMES, _NUMBERS, strict=True)) if {*SLOTS} & {*pair.glosses} else [("", "")]
        for name, number in fillings:
            yield _filled(pair, name, number, read)


def _filled(pair: AlignedPair, name: str, number: str, read: Reader) -> Pair:
    """A pair whose slots hold a name and a number; `read` makes words of its sentence."""
    sentence = pair.sentence.replace(NAME, name).replace(NUMBER, number)
    words = read(sentence)
    glosses: list[str] = []
    places: list[tuple[int, ...]] = []
    for gloss, sources in zip(pair.glosses, pair.sources, strict=True):
        if gloss in SLOTS:
            place = _slot_place(words, name if gloss == NAME else number, sentence)
            glosses.append(name.upper() if gloss == NAME else words[place].form)
            places.append((place,))
        else:
            glosses.append(gloss)
            places.append(tuple(sorted({_place(words, source, sentence) for source in sources})))
    return Pair(sentence, tuple(glosses), tuple(places), "paper", "train")


def _place(words: Sequence[SourceWord], source: str, sentence: str) -> int:
    """The last word with a form: "Ana, ¿quién es Ana?" asks about the second one."""
    places = [place for place, word in enumerate(words) if word.text.lower() == source]
    places = places or [place for place, word in enumerate(words) if fold(word.form) == fold(source)]
    # Words that are read as one, such as "por favor", stand in one place.
    places = places or [place for place, word in enumerate(words) if fold(source) in fold(word.form).split()]
    if not places:
        raise TranslationError(
            "invalid_data",
            f"expected '{source}' among the words of '{sentence}', got {[word.form for word in words]}",
        )
    return places[-1]


def _slot_place(words: Sequence[SourceWord], filler: str, sentence: str) -> int:
    for place, word in enumerate(words):
        if word.text == filler or word.form == filler.lower():
            return place
    raise TranslationError("invalid_data", f"expected '{filler}' to be one word of '{sentence}'")


#: What fills the slots. A few are enough: the corpus shows hundreds of names and numbers in other sentences.
_FEW_NAMES = ("Ana", "Pedro", "Lucía", "Juan", "María", "Carlos")
_FEW_NUMBERS = ("7", "siete", "12", "treinta y cinco", "40", "veintitrés")

_NOT_LETTERS = re.compile(r"[¿?¡!.,:;…]+")


def memorised_pairs(read: Reader, folder: Path | None = None) -> tuple[Pair, ...]:
    """All of `training_pairs`, their slots filled in several ways, with and without a full stop.

    Args:
        read: How sentences become words.
        folder: The language's text folder; by default that of the default language.

    Raises:
        TranslationError: "invalid_data" if a gloss stands for a word that is not read from its sentence.
    """
    return tuple(
        dict.fromkeys(
            _filled(replace(pair, sentence=pair.sentence + stop), name, number, read)
            for pair in training_pairs(folder)
            for name, number in zip(_FEW_NAMES, _FEW_NUMBERS, strict=True)
            for stop in ("", "" if pair.sentence[-1] in "?!…" else ".")
        )
    )


def written_pairs(read: Reader, folder: Path | None = None) -> tuple[Pair, ...]:
    """The pairs of `written_pairs.tsv`, which says who wrote them; none for a language without that file.

    Args:
        read: How sentences become words.
        folder: The language's text folder; by default that of the default language.

    Raises:
        TranslationError: "invalid_data" if a gloss stands for a word that is not read from its sentence.
    """
    path = (folder or data_file("")) / "written_pairs.tsv"
    aligned = read_aligned_pairs(path) if path.is_file() else []
    return tuple(replace(_filled(pair, "", "", read), rule="written") for pair in aligned)


def _ways_of_typing(sentence: str) -> tuple[str, ...]:
    """As given, without accents, without marks, and with nothing but lower case letters."""
    bare = " ".join(_NOT_LETTERS.sub(" ", sentence).split())
    return tuple(dict.fromkeys([sentence, without_accents(sentence), bare, without_accents(bare).lower()]))


def not_memorised(model: SentenceModel, read: Reader) -> tuple[str, ...]:
    """The paper's sentences, in all `_ways_of_typing`, that a model does not translate as published.

    Returns:
        `sentence -> glosses that came out`, none if all are right.
    """
    wrong: list[str] = []
    for pair in paper_pairs():
        expected = tuple("7" if gloss == "X" else gloss_name(gloss) for gloss in pair.glosses)
        for sentence in _ways_of_typing(pair.sentence.replace(" X ", " 7 ")):
            got = tuple(gloss.gloss for gloss in model.translate(read(sentence))[0].glosses)
            if got != expected:
                wrong.append(f"{sentence} -> {' '.join(got)}")
    return tuple(wrong)
