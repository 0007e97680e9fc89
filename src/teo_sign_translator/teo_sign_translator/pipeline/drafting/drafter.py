# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Makes drafts: every word with a meaning of its own and no other, save a subject that an ending names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from teo_sign_translator.data_files import data_file, invalid_line, read_rows, words_of
from teo_sign_translator.morphology import Reading
from teo_sign_translator.pipeline.coverage import FunctionWords
from teo_sign_translator.pipeline.drafting.item import FINITE, Item, item_of
from teo_sign_translator.pipeline.drafting.meaning import meant_readings
from teo_sign_translator.pipeline.drafting.order import (
    modals_behind,
    modifiers_behind,
    negation_behind,
    places_behind,
    questions_last,
    verbs_behind,
)
from teo_sign_translator.pipeline.drafting.persons import OBJECTS, is_implied, named_subjects
from teo_sign_translator.pipeline.drafting.times import AGE, HOUR, LENGTHS, is_length, tells_hour, times_first
from teo_sign_translator.pipeline.long_sentences import Piece, pieces
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.source_words import SourceWord

#: Of each gloss of a draft: its words are right, their order is a rule's. Below the translator's threshold,
#: so that a drafted sentence is called uncertain.
DRAFT_CONFIDENCE = 0.5

_AFTER_PREPOSITION = {"mí": "YO", "conmigo": "YO", "ti": "TÚ", "contigo": "TÚ"}
_SAYING = frozenset(words_of("decir gritar preguntar contestar responder exclamar pensar pedir ordenar"))
_COPULAS = frozenset(words_of("ser estar"))
_STATES = frozenset(words_of("sentir encontrar"))
_SILENT_PREPOSITIONS = frozenset(words_of("a de en con por para"))
_TODAY = "HOY"
#: File of the phrases; drafts are made for a language whose text folder has it.
SET_PHRASES = "set_phrases.tsv"

# "Una semana" is 1 SEMANA: how long is said, not which.
_COUNTED_LENGTHS = frozenset(LENGTHS) - {"día", "rato", "tiempo"}
PARTS_OF_DAY = ("mañana", "tarde", "noche")
# Tags of what one has or is: no verb is signed before it.
_HAD = ("N:", "A:", "DET", "NUM", "V:part", "X", "ADV:degree")


@dataclass(frozen=True, slots=True)
class Drafter:
    """Makes drafts.

    Attributes:
        function_words: What may be left out.
        joints: Conjunctions that may join clauses.
        phrases: Glosses of set phrases, by their words.
    """

    function_words: FunctionWords
    joints: frozenset[str]
    phrases: Mapping[tuple[str, ...], str] = field(default_factory=dict)

    @classmethod
    def load(cls) -> Drafter:
        """With the default language's `function_words.tsv`, `set_phrases.tsv` and `reading.yaml`.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        return cls(FunctionWords.load(), TextRules.load().sentences.joints, read_phrases())

    def draft(self, words: Sequence[SourceWord]) -> tuple[OutputGloss, ...]:
        """The glosses of a sentence, clause by clause; none only if it is marks alone.

        Args:
            words: Of the sentence.
        """
        asks = any(word.form == "?" for word in words)
        result: list[Item] = []
        for piece in _quotes_behind(words, pieces(words, self.joints)):
            if piece.joint is not None and not self.function_words.may_be_left_out(words[piece.joint]):
                result.append(item_of(piece.joint, words[piece.joint].readings[0]))
            result += self._clause(words, piece, asks=asks)
        if not result:  # "¿y de la?": nothing but function words says these
            result = [
                item_of(place, word.readings[0]) for place, word in enumerate(words) if not word.is_mark
            ]
        return tuple(OutputGloss(each.gloss, each.places, DRAFT_CONFIDENCE, copied=True) for each in result)

    def _clause(self, words: Sequence[SourceWord], piece: Piece, *, asks: bool) -> list[Item]:
        places = [place for place in range(piece.start, piece.stop) if not words[place].is_mark]
        meant = meant_readings(words, places, asks=asks)
        items = list(self._items(words, places, meant))
        subject = named_subjects(items, meant, places, asks=asks)
        items = without_helpers(items, asks=asks)
        times, items = times_first(items, words)
        items = modifiers_behind(items)
        items = places_behind(items, words)
        items = verbs_behind(items, words)
        items = modals_behind(items)
        items = negation_behind(items)
        items, questions = questions_last(items)
        items = [*times, *subject, *items, *questions]
        if all(item.is_a("CONJ", "ADV:neg") for item in items):  # "Soy.", "No lo hay": the verb after all
            verbs = [item_of(place, meant[place]) for place in places if meant[place].tag.startswith("V:")]
            items = [*verbs, *items]
        return items

    def _items(
        self, words: Sequence[SourceWord], places: Sequence[int], meant: Mapping[int, Reading]
    ) -> Iterator[Item]:
        """Each word or set phrase, in the order of the text; without articles and the like."""
        index = 0
        longest = max(map(len, self.phrases), default=0)
        while index < len(places):
            place = places[index]
            for length in range(min(longest, len(places) - index), 1, -1):
                own = tuple(places[index : index + length])
                forms = tuple(_phrase_form(words[each], meant[each]) for each in own)
                gloss = self.phrases.get(forms)
                if gloss is not None:
                    tag = "WH" if _asks(meant, own) else meant[place].tag
                    yield Item(gloss, own, Reading(gloss.lower(), tag))
                    break
            else:
                length = 1
                yield from self._of_word(place, meant, places)
            index += length

    def _of_word(self, place: int, meant: Mapping[int, Reading], places: Sequence[int]) -> Iterator[Item]:
        reading = meant[place]
        following = [meant[each] for each in places if each > place]
        if tells_hour(reading, following):
            yield Item(HOUR, (place,), Reading("hora", "N:fs"))
            return
        if reading.tag.startswith("DET:indef") and following and following[0].lemma in _COUNTED_LENGTHS:
            yield Item("1", (place,), Reading("1", "NUM"))
            return
        if reading.lemma == "este" and following and following[0].lemma in PARTS_OF_DAY:
            yield Item(_TODAY, (place,), Reading("hoy", "ADV:time"))
            return
        if reading.tag.startswith(("DET:def", "DET:indef", "PRON:rel", "PRON:refl")):
            return
        if reading.tag.startswith("PREP") and reading.lemma in _SILENT_PREPOSITIONS:
            return
        if reading.tag == "CONJ" and self.function_words.lists(reading):
            return
        if reading.tag.startswith("PRON:obj"):
            verb = next((each for each in following if each.tag.startswith("V:")), None)
            if reading.lemma in OBJECTS and verb is not None and not is_implied(reading.lemma, verb):
                yield Item(OBJECTS[reading.lemma][0], (place,), reading)
            return
        gloss = _AFTER_PREPOSITION.get(reading.lemma)
        yield Item(gloss, (place,), reading) if gloss else item_of(place, reading)
        for clitic in reading.clitics:
            if clitic in OBJECTS and not is_implied(clitic, reading):
                yield Item(OBJECTS[clitic][0], (place,), Reading(clitic, f"PRON:obj:{OBJECTS[clitic][1]}"))


def read_phrases(path: Path | None = None) -> dict[tuple[str, ...], str]:
    """Glosses of set phrases, by their words in lower case.

    Args:
        path: The file; by default the package's `text/set_phrases.tsv`, which explains its columns.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    path = path or data_file(SET_PHRASES)
    found: dict[tuple[str, ...], str] = {}
    for number, (phrase, gloss) in read_rows(path, columns=2):
        words = words_of(phrase)
        if len(words) < 2 or words in found or gloss != gloss.upper():
            expected = "two or more words, once, and a gloss in capitals"
            raise invalid_line(path, number, expected, f"'{phrase}', '{gloss}'")
        found[words] = gloss
    return found


def _quotes_behind(words: Sequence[SourceWord], own: Sequence[Piece]) -> list[Piece]:
    """The pieces of a sentence; "..., dijo el mono" before what he said: signers name first who speaks."""
    last = own[-1] if len(own) > 1 else None
    if last is None or last.joint is not None:
        return list(own)
    said = next(word for word in words[last.start : last.stop] if not word.is_mark).readings[0]
    quotes = said.lemma in _SAYING and said.tag.startswith("V:ind") and said.tag.endswith((":3s", ":3p"))
    return [last, *own[:-1]] if quotes else list(own)


def _phrase_form(word: SourceWord, reading: Reading) -> str:
    """A word as set phrases have it: a verb's infinitive, a question word with its accent."""
    return reading.lemma if reading.tag.startswith((*FINITE, "WH")) else word.form


def _asks(meant: Mapping[int, Reading], places: Sequence[int]) -> bool:
    return any(meant[place].tag.startswith("WH") for place in places)


def without_helpers(items: Sequence[Item], *, asks: bool) -> list[Item]:
    """Without copulas, auxiliaries, and verbs that only say that a state or a thing is there."""
    result: list[Item] = []
    for index, item in enumerate(items):
        following = items[index + 1] if index + 1 < len(items) else None
        lemma = item.reading.lemma if item.is_a("V:") and item.reading else ""
        nominal = following is not None and following.is_a(*_HAD)
        others = len(items) > 1
        if lemma in _COPULAS and others:
            continue
        if lemma in ("hacer", "llevar") and is_length(items[index + 1 : index + 3]):
            continue
        if lemma == "haber" and following is not None:
            continue
        if lemma in _STATES and following is not None and following.is_a("A:", "ADV", "V:part"):
            continue
        if lemma == "ir" and following is not None and following.is_a("V:inf"):
            continue
        if lemma == "tener" and following is not None and nominal:
            if any(each.gloss == "AÑO" for each in items[index + 1 : index + 3]) and following.is_a("NUM"):
                result.append(Item(AGE, items[index + 2].places, Reading("edad", "N:fs")))
                result.append(following)
                items = [*items[: index + 1], *items[index + 3 :]]
                return [*result, *without_helpers(items[index + 1 :], asks=asks)]
            continue
        if lemma == "tener" and following is not None and following.is_a("V:inf"):
            result.append(Item("DEBER", item.places, Reading("deber", "V:inf")))
            continue
        result.append(item)
    return result
