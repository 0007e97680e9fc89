# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A draft of a sentence: its words' lemmas in an order that rules give, where the model is not to be trusted.

The rules are few, and each of them is counted on signers (UD_Spanish_Sign_Language-LSE, the LSE-RADIS
treebank of GRADES, Universidade de Vigo) or published in grammars of LSE. A draft says every word that has a
meaning of its own, and no other, save the subject that only a verb's ending names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from teo_sign_translator.data_files import data_file, invalid_line, read_rows, words_of
from teo_sign_translator.morphology import Reading
from teo_sign_translator.morphology.lexicon import nouns
from teo_sign_translator.pipeline.coverage import FunctionWords
from teo_sign_translator.pipeline.long_sentences import Piece, pieces
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_words import SourceWord

#: Of each gloss of a draft: its words are right, their order is a rule's. Below the translator's threshold,
#: so that a drafted sentence is called uncertain.
DRAFT_CONFIDENCE = 0.5

_SUBJECTS = {"1s": "YO", "2s": "TÚ", "1p": "NOSOTROS", "2p": "VOSOTROS"}
_OBJECTS = {"me": ("YO", "1s"), "te": ("TÚ", "2s"), "nos": ("NOSOTROS", "1p"), "os": ("VOSOTROS", "2p")}
_AFTER_PREPOSITION = {"mí": "YO", "conmigo": "YO", "ti": "TÚ", "contigo": "TÚ"}
# Whom these befall is signed as their subject: "me duele la cabeza" is YO CABEZA DOLER.
_BEFALLING = frozenset(
    words_of("gustar doler encantar parecer apetecer faltar interesar importar molestar preocupar sobrar")
)
# The direction of these says who gets something: "me" is no sign of its own.
_DIRECTED = frozenset(
    words_of("dar ayudar decir preguntar enseñar avisar pedir explicar mandar enviar contar llamar prestar")
)
_COPULAS = frozenset(words_of("ser estar"))
_STATES = frozenset(words_of("sentir encontrar"))
_SILENT_PREPOSITIONS = frozenset(words_of("a de en con por para"))
_AGE = "EDAD"
_NO = "NO"
_FINITE = ("V:ind", "V:cond", "V:sub", "V:imp")
# Tags of words behind which a verb comes, if the word can be one.
_BEFORE_VERBS = ("PRON:obj", "PRON:refl", "PRON:1", "PRON:2", "ADV:neg")
# Tags of what one has or is: no verb is signed before it.
_HAD = ("N:", "A:", "DET", "NUM", "V:part", "X", "ADV:degree")
# Glosses that go with a word of time before them, and those that may stand before it.
_OF_TIMES = ("PASADO", "PRÓXIMO", "SIGUIENTE", "PASAR")
_BEFORE_TIMES = ("PRÓXIMO", "ÚLTIMO")
_TIMES = frozenset(noun.lemma for noun in nouns() if noun.classes[0] == "time")


@dataclass(slots=True)
class _Item:
    """One gloss of a draft with the words that it says.

    Attributes:
        gloss: As `OutputGloss` has it.
        places: Of the words, ascending.
        reading: Of the word that it is of; None for a set phrase.
    """

    gloss: str
    places: tuple[int, ...]
    reading: Reading | None = None

    def is_a(self, *tags: str) -> bool:
        """Whether the word has a tag that begins so."""
        return self.reading is not None and self.reading.tag.startswith(tags)


@dataclass(frozen=True, slots=True)
class Drafter:
    """Makes drafts.

    Attributes:
        function_words: What may be left out.
        phrases: Glosses of set phrases, by their words.
    """

    function_words: FunctionWords
    phrases: Mapping[tuple[str, ...], str] = field(default_factory=dict)

    @classmethod
    def load(cls) -> Drafter:
        """With the package's `data/function_words.tsv` and `data/set_phrases.tsv`.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        return cls(FunctionWords.load(), read_phrases())

    def draft(self, words: Sequence[SourceWord]) -> tuple[OutputGloss, ...]:
        """The glosses of a sentence, clause by clause; none only if it is marks alone.

        Args:
            words: Of the sentence.
        """
        asks = any(word.form == "?" for word in words)
        result: list[_Item] = []
        for piece in pieces(words):
            if piece.joint is not None and not self.function_words.may_be_left_out(words[piece.joint]):
                result.append(_item(piece.joint, words[piece.joint].readings[0]))
            result += self._clause(words, piece, asks=asks)
        if not result:  # "¿y de la?": nothing but function words says these
            result = [_item(place, word.readings[0]) for place, word in enumerate(words) if not word.is_mark]
        return tuple(OutputGloss(each.gloss, each.places, DRAFT_CONFIDENCE, copied=True) for each in result)

    def _clause(self, words: Sequence[SourceWord], piece: Piece, *, asks: bool) -> list[_Item]:
        places = [place for place in range(piece.start, piece.stop) if not words[place].is_mark]
        meant = _meant(words, places, asks=asks)
        items = list(self._items(words, places, meant))
        subject = _subject(items, meant, places, asks=asks)
        items = _without_helpers(items, asks=asks)
        times, items = _times(items)
        items = _modifiers_behind(items)
        items = _modals_behind(items)
        items = _negation_behind(items)
        items, questions = _questions(items)
        items = [*times, *subject, *items, *questions]
        if all(item.is_a("CONJ", "ADV:neg") for item in items):  # "Soy.", "No lo hay": the verb after all
            verbs = [_item(place, meant[place]) for place in places if meant[place].tag.startswith("V:")]
            items = [*verbs, *items]
        return items

    def _items(
        self, words: Sequence[SourceWord], places: Sequence[int], meant: Mapping[int, Reading]
    ) -> Iterator[_Item]:
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
                    yield _Item(gloss, own, Reading(gloss.lower(), tag))
                    break
            else:
                length = 1
                yield from self._of_word(place, meant, places)
            index += length

    def _of_word(self, place: int, meant: Mapping[int, Reading], places: Sequence[int]) -> Iterator[_Item]:
        reading = meant[place]
        following = [meant[each] for each in places if each > place]
        if reading.tag.startswith(("DET:def", "DET:indef", "PRON:rel", "PRON:refl")):
            return
        if reading.tag.startswith("PREP") and reading.lemma in _SILENT_PREPOSITIONS:
            return
        if reading.tag == "CONJ" and self.function_words.lists(reading):
            return
        if reading.tag.startswith("PRON:obj"):
            verb = next((each for each in following if each.tag.startswith("V:")), None)
            if reading.lemma in _OBJECTS and verb is not None and not _implied(reading.lemma, verb):
                yield _Item(_OBJECTS[reading.lemma][0], (place,), reading)
            return
        gloss = _AFTER_PREPOSITION.get(reading.lemma)
        yield _Item(gloss, (place,), reading) if gloss else _item(place, reading)
        for clitic in reading.clitics:
            if clitic in _OBJECTS and not _implied(clitic, reading):
                yield _Item(_OBJECTS[clitic][0], (place,), Reading(clitic, f"PRON:obj:{_OBJECTS[clitic][1]}"))


def read_phrases(path: Path | None = None) -> dict[tuple[str, ...], str]:
    """Glosses of set phrases, by their words in lower case.

    Args:
        path: The file; by default the package's `data/set_phrases.tsv`, which explains its columns.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    path = path or data_file("set_phrases.tsv")
    found: dict[tuple[str, ...], str] = {}
    for number, (phrase, gloss) in read_rows(path, columns=2):
        words = words_of(phrase)
        if len(words) < 2 or words in found or gloss != gloss.upper():
            expected = "two or more words, once, and a gloss in capitals"
            raise invalid_line(path, number, expected, f"'{phrase}', '{gloss}'")
        found[words] = gloss
    return found


def _item(place: int, reading: Reading) -> _Item:
    return _Item(copied_gloss(reading), (place,), reading)


def _phrase_form(word: SourceWord, reading: Reading) -> str:
    """A word as set phrases have it: a verb's infinitive, a question word with its accent."""
    return reading.lemma if reading.tag.startswith((*_FINITE, "WH")) else word.form


def _asks(meant: Mapping[int, Reading], places: Sequence[int]) -> bool:
    return any(meant[place].tag.startswith("WH") for place in places)


def _meant(words: Sequence[SourceWord], places: Sequence[int], *, asks: bool) -> dict[int, Reading]:
    """The likeliest reading of each word, by the word before it.

    Behind an article, a possessive or a preposition stands no finite verb; behind a clitic, a subject pronoun
    or "no" a verb does, if it can be one; a question word without its accent is one at the beginning of a
    question.
    """
    result: dict[int, Reading] = {}
    for index, place in enumerate(places):
        word = words[place]
        before = result[places[index - 1]] if index else None
        choices: Sequence[Reading] = word.readings
        if before is not None and before.tag.startswith(("DET", "PREP")):
            choices = [each for each in choices if not each.tag.startswith(_FINITE)] or choices
        elif before is not None and before.tag.startswith(
            ("PRON:obj", "PRON:refl", "PRON:1", "PRON:2", "ADV:neg")
        ):
            choices = [each for each in choices if each.tag.startswith("V:")] or choices
        if before is not None and before.lemma == "haber":
            choices = [each for each in choices if each.tag.startswith("V:part")] or choices
        if asks and (index == 0 or (index == 1 and before is not None and before.tag == "PREP")):
            choices = [each for each in choices if each.tag.startswith("WH")] or choices
        reading = choices[0]
        if reading.tag.startswith("DET:def") and index + 1 < len(places):  # "la veo": no article
            following = words[places[index + 1]].readings[0]
            clitic = next((each for each in word.readings if each.tag.startswith("PRON:obj")), None)
            if clitic is not None and following.tag.startswith(_FINITE):
                reading = clitic
        result[place] = reading
    return result


def _implied(clitic: str, verb: Reading) -> bool:
    """Whether the verb says a clitic: its subject is the same (me lavo), or its direction says it (dame)."""
    person = _OBJECTS[clitic][1]
    return (
        verb.tag.endswith(f":{person}")
        or (verb.lemma in _DIRECTED and person == "1s")
        or (verb.tag in ("V:inf", "V:ger") and person == "1s")
    )


def _subject(
    items: list[_Item], meant: Mapping[int, Reading], places: Sequence[int], *, asks: bool
) -> list[_Item]:
    """The subject that only a verb's ending names, for the front, and whom something befalls.

    That of a second verb, where it is another, goes before it into the items.
    """
    if any(reading.lemma in _BEFALLING for reading in meant.values()):
        for item in items:
            if item.is_a("PRON:obj"):
                items.remove(item)
                return [item]
    said = {item.reading.tag[5:7] for item in items if item.reading and item.is_a("PRON:1", "PRON:2")}
    before = ""
    front: list[_Item] = []
    for place in places:
        tag = meant[place].tag
        if not tag.startswith(_FINITE) or not meant[place].exact:  # a guess names nobody
            continue
        person = "" if tag.startswith("V:imp") else tag[-2:]
        requests = asks and meant[place].lemma == "poder"
        denied = tag.startswith("V:sub") and not before  # "no toques eso"
        gloss = _SUBJECTS.get(person)
        if gloss and person not in (before, *said) and not requests and not denied:
            subject = _Item(gloss, (place,), Reading(gloss.lower(), f"PRON:{person}"))
            if before:  # of a second verb: "no hace falta que vengas"
                index = next((at for at, item in enumerate(items) if place in item.places), len(items))
                items.insert(index, subject)
            else:
                front.append(subject)
        before = person or tag
    return front


def _without_helpers(items: Sequence[_Item], *, asks: bool) -> list[_Item]:
    """Without copulas, auxiliaries, and verbs that only say that a state or a thing is there."""
    result: list[_Item] = []
    for index, item in enumerate(items):
        following = items[index + 1] if index + 1 < len(items) else None
        lemma = item.reading.lemma if item.is_a("V:") and item.reading else ""
        nominal = following is not None and following.is_a(
            "N:", "A:", "DET", "NUM", "V:part", "X", "ADV:degree"
        )
        others = len(items) > 1
        if lemma in _COPULAS and others:
            continue
        if lemma == "haber" and following is not None:
            continue
        if lemma in _STATES and following is not None and following.is_a("A:", "ADV", "V:part"):
            continue
        if lemma == "ir" and following is not None and following.is_a("V:inf"):
            continue
        if lemma == "tener" and following is not None and nominal:
            if any(each.gloss == "AÑO" for each in items[index + 1 : index + 3]) and following.is_a("NUM"):
                result.append(_Item(_AGE, items[index + 2].places, Reading("edad", "N:fs")))
                result.append(following)
                items = [*items[: index + 1], *items[index + 3 :]]
                return [*result, *_without_helpers(items[index + 1 :], asks=asks)]
            continue
        if lemma == "tener" and following is not None and following.is_a("V:inf"):
            result.append(_Item("DEBER", item.places, Reading("deber", "V:inf")))
            continue
        result.append(item)
    return result


def _times(items: Sequence[_Item]) -> tuple[list[_Item], list[_Item]]:
    """Words that say when, and all others; a word of time with its determiners and numbers."""
    when: set[int] = set()
    for index, item in enumerate(items):
        if item.is_a("ADV:time") and not item.is_a("ADV:time:frequency"):
            when.add(index)
        elif item.gloss != _AGE and item.reading is not None and _names_time(item.reading):
            if (
                index
                and items[index - 1].is_a("A:")
                and not items[index - 1].gloss.startswith(("PRÓXIMO", "ÚLTIMO"))
            ):
                continue  # "buen día" is no time
            when.add(index)
            before = index - 1
            while before >= 0 and items[before].is_a("DET:dem", "DET:quant", "NUM", "A:"):
                when.add(before)
                before -= 1
            if index + 1 < len(items) and items[index + 1].gloss in (
                "PASADO",
                "PRÓXIMO",
                "SIGUIENTE",
                "PASAR",
            ):
                when.add(index + 1)
    first = [item for index, item in enumerate(items) if index in when]
    return first, [item for index, item in enumerate(items) if index not in when]


def _names_time(reading: Reading) -> bool:
    return reading.tag.startswith("N:") and reading.lemma in _TIMES


def _modifiers_behind(items: Sequence[_Item]) -> list[_Item]:
    """Possessives and adjectives behind their noun (16 of 25 counted)."""
    result = list(items)
    for index in range(len(result) - 2, -1, -1):
        modifies = result[index].is_a("DET:poss", "A:") or result[index].gloss in ("MUCHO", "POCO")
        if modifies and result[index + 1].is_a("N:") and result[index].is_a("DET", "A:"):
            result[index], result[index + 1] = result[index + 1], result[index]
    return result


def _modals_behind(items: Sequence[_Item]) -> list[_Item]:
    """PODER and DEBER at the end of their clause (of requests 6 of 6)."""
    modals = [item for item in items if item.is_a("V:") and item.gloss in ("PODER", "DEBER")]
    modals = [each for each in modals if any(other.is_a("V:inf") and other not in modals for other in items)]
    denied = [
        items[index]
        for index in range(len(items) - 1)
        if items[index].gloss == _NO and items[index + 1] in modals
    ]
    moved = [*modals, *denied]
    return [*(item for item in items if item not in moved), *moved]


def _negation_behind(items: Sequence[_Item]) -> list[_Item]:
    """NO behind the verb that it denies, or at the end where none is left; once beside NADA or NADIE."""
    result = list(items)
    if any(item.is_a("PRON:neg") or item.gloss in ("NUNCA", "NINGÚN", "TAMPOCO") for item in result):
        return [item for item in result if item.gloss != _NO]
    for index in range(len(result) - 1, -1, -1):
        if result[index].gloss != _NO:
            continue
        behind = next((at for at in range(index + 1, len(result)) if result[at].is_a("V:")), None)
        item = result.pop(index)
        if behind is not None:
            result.insert(behind, item)
        elif index and result[index - 1].gloss in ("PODER", "DEBER"):
            result.insert(index, item)
        else:
            result.append(item)
    return result


def _questions(items: Sequence[_Item]) -> tuple[list[_Item], list[_Item]]:
    """What is asked, and the question words, which are last: of "qué" and a noun it is CUÁL."""
    asking = [item for item in items if item.is_a("WH")]
    for item in asking:
        index = items.index(item)
        if item.gloss == "QUÉ" and index + 1 < len(items) and items[index + 1].is_a("N:"):
            item.gloss = "CUÁL"
        elif item.gloss == "CUÁNTO" and item.reading is not None and item.reading.tag.endswith("p"):
            item.gloss = "CUÁNTOS"
    return [item for item in items if item not in asking], asking
