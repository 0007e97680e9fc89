"""The paper's and the project's own pairs as corpus pairs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from teo_sign_translator.corpus.pairs_file import Pair
from teo_sign_translator.corpus.paper_pairs import NAME, NUMBER, AlignedPair, training_pairs
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.text.source_words import SourceWord, source_words

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


def own_pairs(morphology: Morphology) -> Iterator[Pair]:
    """Yield the pairs that the translator must know exactly, slots filled with names and numbers."""
    for pair in training_pairs():
        slot = next((slot for slot in (NAME, NUMBER) if slot in pair.glosses), "")
        for value in {NAME: _NAMES, NUMBER: _NUMBERS}.get(slot, ("",)):
            yield _filled(pair, slot, value, morphology)


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
