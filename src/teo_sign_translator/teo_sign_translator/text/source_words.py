# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sentence as the words that a sentence model reads: the same way in training and in use.

A capital alone does not make a name. It says something only inside a sentence: at its beginning, behind a
colon, an opening quote, a dash or `¿`, and in a text that is all in capitals, the rules of writing explain
it. There a word that Spanish has besides (`Segura`, `Tranquilos`, `Rosa`) is that word, unless what stands
beside it makes it a name.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice

from teo_common.text_folding import strip_marks
from teo_sign_translator.morphology import MAX_READINGS, Morphology, Reading
from teo_sign_translator.text.cleaning import clean, is_drawn_out, shortened
from teo_sign_translator.text.neighbours import told_by_neighbours
from teo_sign_translator.text.numerals import roman_value
from teo_sign_translator.text.reading import Clause, Word, WordKind, read
from teo_sign_translator.text.rules import SpecialWords, TextRules
from teo_sign_translator.text.source_word import SourceWord

#: Tags of people's names; names of places have signs, or are spelled like any other word.
PEOPLE = ("NAME", "NAME:m", "NAME:f")

_GIVEN = ("NAME:m", "NAME:f")


def is_persons_name(reading: Reading) -> bool:
    """Whether a reading is that of a person's name."""
    return reading.tag in PEOPLE


def _name_readings(
    readings: Sequence[Reading], written: str, *, capital: bool, introduced: bool
) -> tuple[Reading, ...]:
    """Readings of a word inside a sentence: a name if it is introduced as one, or not known otherwise.

    Args:
        readings: Of the word in lower case.
        written: The word as typed.
        capital: Whether it has a capital that nothing else explains.
        introduced: See `_introduces`.
    """
    names = tuple(filter(is_persons_name, readings))
    others = tuple(reading for reading in readings if not is_persons_name(reading))
    known = any(reading.exact for reading in others)
    if not capital:
        return tuple(readings) if introduced or not known else others
    if any(reading.tag.startswith("NAME") for reading in readings):
        return tuple(readings)
    guessed = Reading(written, "NAME", exact=False)
    if not known:
        return (guessed, *others)[:MAX_READINGS]
    # "Ana Cuesta": a word that everybody knows is a surname behind a name alone.
    return (*others[: MAX_READINGS - 1], guessed) if introduced else (*others, *names)


def _introduces(readings: Sequence[Reading], words: SpecialWords) -> bool:
    """Whether a name may follow a word with these readings though it is a common word too."""
    return is_persons_name(readings[0]) or any(reading.lemma in words.introducing for reading in readings)


def _opening_name(
    readings: Sequence[Reading], following: Sequence[SourceWord], words: SpecialWords
) -> tuple[Reading, ...]:
    """Readings of a capitalised word that begins a sentence: a given name first, if it is a subject.

    A common noun that is a subject has an article (`La rosa huele`); a name has none (`Rosa viene mañana`,
    `Rosa y Pablo`).

    Args:
        readings: Of the word.
        following: The words behind it.
        words: Of the language.
    """
    given = tuple(reading for reading in readings if reading.tag in _GIVEN)
    behind = [word.readings[0] for word in following[:2]]
    says = (
        bool(behind) and behind[0].tag.startswith("V:") and behind[0].tag.endswith(words.subject_tags)
    ) or (len(behind) > 1 and behind[0].tag == "CONJ" and is_persons_name(behind[1]))
    others = tuple(reading for reading in readings if not is_persons_name(reading))
    if given and says:
        return (*given, *others)
    return others or tuple(readings)


#: From so many words on, a capital on each of them is a habit of the writer's, not a row of names.
_TITLE_CASE_WORDS = 5

# How many words stand together inside a name ("de la").
_MOST_INSIDE_NAMES = 2


def source_words(sentence: str, morphology: Morphology) -> tuple[SourceWord, ...]:
    """The words and marks of one sentence, in its order.

    Args:
        sentence: As typed; what ends a sentence inside it is a mark like the others.
        morphology: Gives the readings.

    Raises:
        TranslationError: See `cleaning.clean`.
    """
    rules = TextRules.load(morphology.folder)
    return words_of_clauses(read(clean(sentence).text, rules).clauses, morphology)


def words_of_clauses(clauses: Sequence[Clause], morphology: Morphology) -> tuple[SourceWord, ...]:
    """The words and marks of a sentence that has been read."""
    special = TextRules.load(morphology.folder).words
    shouted = _capitals_mean_nothing([word for clause in clauses for word in clause.words])
    words: list[SourceWord] = []
    openings: list[int] = []
    begins = True
    for clause in clauses:
        begins = begins or bool(clause.opening)
        for word in _asking_why(clause, special):
            begins = begins or word.after_mark
            written = word.capitalised and not word.stands_for
            if begins and written:
                openings.append(len(words))
            capital = written and not begins and not shouted
            introduced = bool(words) and _introduces(words[-1].readings, special)
            words.append(_source_word(word, capital, morphology, shouted=shouted, introduced=introduced))
            begins = False
        if clause.end:
            words.append(SourceWord(clause.end, clause.end, False, _MARKS[clause.end]))
        begins = clause.closes
    for place in openings:
        readings = _opening_name(_all_readings(words[place], morphology), words[place + 1 :], special)
        words[place] = replace(words[place], readings=readings)
    words = _with_degrees(_as_prices_are_said(words), special, morphology)
    words = _with_phrases(words, morphology) if morphology.phrases else words
    return tuple(
        told_by_neighbours(_in_their_clause(_with_whole_names(words, special), morphology), morphology)
    )


def _as_prices_are_said(words: Sequence[SourceWord]) -> list[SourceWord]:
    """The words, the symbol of a currency behind its number: $35 is said "thirty-five dollars"."""
    result: list[SourceWord] = []
    for word in words:
        result.append(word)
        before, symbol = ([None, None, *result])[-3:-1]
        alone = before is None or before.tag != "NUM"
        if symbol is not None and _is_currency(symbol) and alone and word.tag == "NUM":
            result[-2:] = [word, symbol]
    return result


def _is_currency(word: SourceWord) -> bool:
    return len(word.text) == 1 and unicodedata.category(word.text) == "Sc"


def _with_degrees(
    words: Sequence[SourceWord], special: SpecialWords, morphology: Morphology
) -> list[SourceWord]:
    """The words, a superlative as two of them: "carísimo" is very dear."""
    result: list[SourceWord] = []
    for word in words:
        likeliest = word.readings[0]
        if likeliest.tag.startswith("A:") and special.superlative.fullmatch(strip_marks(word.form)):
            result.append(replace(word, form=special.degree, readings=morphology.readings(special.degree)))
            base = morphology.inflect(likeliest.lemma, likeliest.tag)
            word = replace(word, form=base, capital=False, readings=morphology.readings(base))
        result.append(word)
    return result


#: What a relative clause stands behind, and what may stand between an auxiliary and its participle.
_BEFORE_RELATIVES = ("N:", "NAME", "PRON:ind", "NUM")
_INSIDE_PERFECT = ("ADV", "PRON", "NAME", "N:", "A", "DET:poss", "DET:def", "DET:dem", "POSS")


def _in_their_clause(words: Sequence[SourceWord], morphology: Morphology) -> list[SourceWord]:
    """The words, without readings that their clause rules out.

    A question word that may be a relative is one behind a noun alone, and an auxiliary has a participle.
    """
    result = list(words)
    for place, word in enumerate(words):
        tags = {reading.tag for reading in word.readings if reading.exact}
        out = set()
        if "WH" in tags and not _may_relate(words, place):
            out.add("PRON:rel")
        asks = not place or words[place - 1].tag == "WH"
        inside = (*_INSIDE_PERFECT, "DET:indef") if asks else _INSIDE_PERFECT  # not "she has a broken arm"
        if "AUX" in tags and not _before_participle(words[place + 1 :], inside, morphology):
            out.add("AUX")
        if out & tags:
            kept = tuple(each for each in word.readings if each.tag not in out or not each.exact)
            result[place] = replace(word, readings=kept)
    return result


def _may_relate(words: Sequence[SourceWord], place: int) -> bool:
    """Whether a noun is before a word, or before the comma before it, if the clause has its other comma."""
    before = place - 1
    if before > 0 and words[before].form == "," and any(word.form == "," for word in words[place:]):
        before -= 1
    return before >= 0 and words[before].tag.startswith(_BEFORE_RELATIVES)


def _before_participle(words: Sequence[SourceWord], inside: tuple[str, ...], morphology: Morphology) -> bool:
    """Whether a participle comes before any word that is not of the kinds that stand inside a perfect."""
    for word in words:
        verbs = (reading.lemma for reading in word.readings if reading.tag.startswith("V:") and reading.exact)
        if any(morphology.is_form(word.form, lemma, "V:part") for lemma in verbs):
            return True
        if not word.tag.startswith(inside):
            return False
    return False


#: Words of a phrase, and words between a verb and what belongs to it ("turn the big light off").
_MOST_PARTS, _MOST_BETWEEN = 4, 3
_OBJECTS = ("PRON:obj", "PRON:2s", "PRON:3s", "PRON:ind", "DET", "A", "N:", "NAME", "POSS")
_NOMINAL = ("DET", "N:", "A", "NAME", "NUM", "PRON:poss")


def _with_phrases(words: Sequence[SourceWord], morphology: Morphology) -> list[SourceWord]:
    """The words, those that the lexicon lists together as one: "woke up", also "woke my son up"."""
    result: list[SourceWord] = []
    place = 0
    while place < len(words):
        sizes = range(min(_MOST_PARTS, len(words) - place), 1, -1)
        size = next((size for size in sizes if _phrase(words[place : place + size], morphology)), 1)
        result.append(_as_one(words[place : place + size], morphology) if size > 1 else words[place])
        place += size
    for place, word in enumerate(result):
        for last in range(place + 2, min(place + 2 + _MOST_BETWEEN, len(result))):
            if _divided(result[place : last + 1], result[last + 1 : last + 2], morphology):
                result[place] = _as_one([word, result.pop(last)], morphology)
                break
    return result


def _phrase(words: Sequence[SourceWord], morphology: Morphology) -> bool:
    return strip_marks(" ".join(map(_said_as, words))) in morphology.phrases


def _said_as(word: SourceWord) -> str:
    return word.text.lower() if word.tag == "NUM" else word.form


def _as_one(words: Sequence[SourceWord], morphology: Morphology) -> SourceWord:
    form = " ".join(map(_said_as, words))
    readings = morphology.readings(form.capitalize() if words[0].capital else form)
    return SourceWord(" ".join(word.text for word in words), form, words[0].capital, readings)


def _divided(words: Sequence[SourceWord], following: Sequence[SourceWord], morphology: Morphology) -> bool:
    """Whether the first and the last of some words are a verb with its object between them.

    What governs a noun behind it belongs to that one: "put the book on the table".
    """
    verb, *between, particle = words
    return (
        _phrase((verb, particle), morphology)
        and any(reading.tag.startswith("V:") for reading in _as_one((verb, particle), morphology).readings)
        and all(any(r.tag.startswith(_OBJECTS) for r in word.readings) for word in between)
        and not any(word.tag.startswith(_NOMINAL) for word in following)
    )


def _with_whole_names(words: Sequence[SourceWord], special: SpecialWords) -> list[SourceWord]:
    """The words, those inside a person's name read as names: "de la" of "María de la Torre"."""
    result = list(words)
    for place, word in enumerate(result):
        if not is_persons_name(word.readings[0]):
            continue
        last = place + 1
        while last < len(result) and result[last].form in special.inside_names:
            last += 1
        surname = last < len(result) and place + 1 < last <= place + 1 + _MOST_INSIDE_NAMES
        if surname and result[last].capital and _may_be_surname(result[last]):
            for inside in range(place + 1, last + 1):
                named = Reading(result[inside].text, "NAME", exact=False)
                result[inside] = replace(result[inside], readings=(named,))
    return result


def _may_be_surname(word: SourceWord) -> bool:
    """Whether a capital makes a word a name: not a place's, and not that of a word that always has one."""
    others = [reading for reading in word.readings if not is_persons_name(reading)]
    own_capital = any(reading.lemma[:1].isupper() for reading in others)
    return not (own_capital or word.tag.startswith("PRON"))


def _all_readings(word: SourceWord, morphology: Morphology) -> tuple[Reading, ...]:
    """The readings of a word, that of a given name among them though it is a common word too."""
    if word.tag in ("NUM", "X") or " " in word.form:
        return word.readings
    return morphology.readings(word.form)


def _asking_why(clause: Clause, special: SpecialWords) -> Sequence[Word]:
    """The words of a clause; "porque" at the beginning of a question is "por qué" typed in haste."""
    first = clause.words[0]
    if first.lower != special.asked_reason or (clause.end != "?" and clause.opening != "¿"):
        return clause.words
    return (*(replace(first, stands_for=word) for word in special.reason), *clause.words[1:])


_MARKS = {mark: (Reading(mark, "MARK"),) for mark in (",", ".", "?", "!")}


def _capitals_mean_nothing(words: Sequence[Word]) -> bool:
    """Whether a sentence is all in capitals, or Each Of Its Words Begins With One.

    A single letter or a few names say nothing of the kind.
    """
    letters = [word for word in words if word.kind is WordKind.LETTERS]
    if len(letters) >= _TITLE_CASE_WORDS and all(word.capitalised for word in letters):
        return True
    text = "".join(part for word in letters for part in word.parts)
    return len(text) > 1 and text.isupper()


def _source_word(
    word: Word, capital: bool, morphology: Morphology, *, shouted: bool, introduced: bool
) -> SourceWord:
    text = word.text
    roman = 0 if shouted else roman_value(text)
    if roman:
        return SourceWord(text, str(roman), False, (Reading(str(roman), "NUM"),))
    if word.kind is WordKind.NUMBER and not word.stands_for:
        return SourceWord(text, word.value, capital, (Reading(word.value, "NUM"),))
    form = word.lower
    if word.kind is WordKind.ADDRESS:
        return SourceWord(text, form, True, (Reading(form, "NAME"),))
    if form == "x":  # a number that is not said: "Yo tengo X años"
        return SourceWord(text, form, capital, (Reading("X", "NUM"),))
    if not word.stands_for and is_drawn_out(form):
        form = _written(form, morphology)
    elif not word.stands_for and not capital:
        form = _written_for_sound(form, morphology)
    if " " in form:  # two words that a short form makes one ("por ciento"); no lexicon lists them
        return SourceWord(text, form, capital, (Reading(form, "X"),))
    readings = _name_readings(morphology.readings(form), text, capital=capital, introduced=introduced)
    return SourceWord(text, form, capital, readings)


#: Sounds of one word that may be spelled otherwise ("kisiera", "vien"), and spellings that are tried: half a
#: millisecond for a word that is none.
_MOST_SOUNDS, _MOST_SPELLINGS = 2, 300
#: Shorter words are like too many others [letters].
_SHORTEST_BY_SOUND = 3


def _written_for_sound(form: str, morphology: Morphology) -> str:
    """A word of no lexicon as the known word is written that sounds so, if there is one: `kasa` is `casa`.

    Whoever types accents does not write by ear.
    """
    if len(form) < _SHORTEST_BY_SOUND or not form.isascii() or not form.isalpha():
        return form
    if any(reading.tag != "X" and reading.exact for reading in morphology.readings(form)):
        return form
    if morphology.knows(form):
        return form
    sounds = TextRules.load(morphology.folder).words.spellings
    found = (each for each in islice(_spellings(form, sounds), _MOST_SPELLINGS) if morphology.knows(each))
    return next(found, form)


def _spellings(form: str, sounds: Sequence[tuple[re.Pattern[str], tuple[str, ...]]]) -> Iterator[str]:
    """A word with one of its sounds spelled otherwise, then with two."""
    seen = {form}
    before = [form]
    for _ in range(_MOST_SOUNDS):
        others = []
        for written in before:
            for sound, spellings in sounds:
                for match in sound.finditer(written):
                    for spelling in spellings:
                        other = written[: match.start()] + spelling + written[match.end() :]
                        if other not in seen:
                            seen.add(other)
                            others.append(other)
                            yield other
        before = others


def _written(form: str, morphology: Morphology) -> str:
    """A drawn-out word as it is written: each letter once, or twice if that is a word ("leeer")."""
    single, double = shortened(form), shortened(form, times=2)
    known_twice = any(reading.exact for reading in morphology.readings(double))
    return double if known_twice and not any(r.exact for r in morphology.readings(single)) else single
