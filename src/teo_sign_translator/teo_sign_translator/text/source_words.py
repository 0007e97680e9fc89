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
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice, pairwise

from teo_common.text_folding import strip_marks
from teo_sign_translator.morphology import MAX_READINGS, Morphology, Reading
from teo_sign_translator.text.cleaning import clean, is_drawn_out, shortened
from teo_sign_translator.text.numerals import roman_value
from teo_sign_translator.text.reading import Clause, Word, WordKind, read
from teo_sign_translator.text.rules import SpecialWords, TextRules

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


_FINITE = ("V:ind", "V:sub", "V:cond", "V:imp")
_MASCULINE = re.compile("[NA]:[mc][sn]|V:part:ms")
# Forms of a verb that tell its person, as not every language's do.
_PERSONAL = re.compile(f"(?:{'|'.join(_FINITE)}).*:[123][sp]")
# Pronouns that are subjects alone; question words, and articles that are pronouns too or stand before them:
# not el and un, which stand before feminine nouns too.
_SUBJECTS = ("PRON:1s", "PRON:2s")
_ARTICLE = re.compile("(?:DET:(?:in)?def:(?!ms)|WH:)([fm])([sp])")

#: From so many words on, a capital on each of them is a habit of the writer's, not a row of names.
_TITLE_CASE_WORDS = 5

# How many words stand together inside a name ("de la").
_MOST_INSIDE_NAMES = 2


@dataclass(frozen=True, slots=True)
class SourceWord:
    """A word or mark of a sentence.

    Attributes:
        text: As typed. Words that one short form stands for have the same text (`EE. UU.`, `xfa`).
        form: What it says, in lower case with the accents that were typed: a short form or symbol in full
            (`sr.` is `señor`), a number in digits, also one of several words (`31`, `3,5`, `15:30`) or a
            Roman one (`21`), a word typed as it is drawn out or sounds as it is written (`holaaaa` is `hola`,
            `kasa` is `casa`). A mark is one of `,` (any mark that is a short pause), `.`, `?`, `!`; opening
            marks are left out.
        capital: Whether it was typed with a capital that neither the beginning of a sentence, a mark before
            it nor capitals all over explain.
        readings: What it may be, most likely first; one to four. A mark's only one has the tag MARK.
    """

    text: str
    form: str
    capital: bool
    readings: tuple[Reading, ...]

    @property
    def is_mark(self) -> bool:
        """Whether it is punctuation."""
        return self.readings[0].tag == "MARK"


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
    words = _with_degrees(words, special, morphology)
    words = _with_phrases(words, morphology) if morphology.phrases else words
    return tuple(
        _told_by_neighbours(_in_their_clause(_with_whole_names(words, special), morphology), morphology)
    )


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
        if "AUX" in tags and not _before_participle(words[place + 1 :], morphology):
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
    return before >= 0 and words[before].readings[0].tag.startswith(_BEFORE_RELATIVES)


def _before_participle(words: Sequence[SourceWord], morphology: Morphology) -> bool:
    """Whether a participle comes before anything that cannot stand between it and its auxiliary."""
    for word in words:
        verbs = (reading.lemma for reading in word.readings if reading.tag.startswith("V:") and reading.exact)
        if any(morphology.is_form(word.form, lemma, "V:part") for lemma in verbs):
            return True
        if not word.readings[0].tag.startswith(_INSIDE_PERFECT):
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
    return word.text.lower() if word.readings[0].tag == "NUM" else word.form


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
        and not any(word.readings[0].tag.startswith(_NOMINAL) for word in following)
    )


def _told_by_neighbours(words: list[SourceWord], morphology: Morphology) -> list[SourceWord]:
    """The words, without readings that the one before rules out; typed right where the one behind tells."""
    told = TextRules.load(morphology.folder).neighbours
    for place, (word, following) in enumerate(pairwise(words)):
        written = told.perfect.get(word.form)
        if written and not _is_participle(following, behind=words[place - 1] if place else None):
            written = None
        if following.readings[0].tag.startswith("V:inf"):
            written = told.infinitive.get(word.form, written)
        if written:
            word = words[place] = replace(word, form=written, readings=morphology.readings(written))
        if following.form not in told.amounts:
            word = words[place] = replace(word, readings=_does(word, following, told.copulas))
        if following.form in told.amounts.get(word.form, "").split():
            words[place] = replace(word, readings=_without_verbs(word.readings, prepositions=False))
    for place in range(len(words) - 3):
        words[place] = _counting(words[place : place + 4], morphology)
    if len(words) > 1 and words[1].is_mark:
        words[0] = replace(words[0], readings=_as_order(words[0].readings))
    behind_copula = False
    before = ""
    for place, word in enumerate(words):
        if place:
            word = words[place] = replace(word, readings=_behind(words, place, morphology))
        nominal = tuple(filter(_is_nominal, word.readings))
        masculine = any(_MASCULINE.match(reading.tag) for reading in nominal)
        if before in told.before_nouns and not nominal:
            words[place] = replace(word, readings=(Reading(word.form, "X", exact=False),))
        elif behind_copula or before in told.before_nouns or (before in told.before_masculine and masculine):
            readings = _without_verbs(word.readings, prepositions=behind_copula)
            words[place] = replace(word, readings=readings if behind_copula else _no_participles(readings))
        elif place and words[place - 1].readings[0].tag.startswith(("PRON:obj", "PRON:refl")):
            words[place] = replace(word, readings=_no_orders(word.readings))
        before = word.form
        behind_copula = word.readings[0].lemma in told.copulas or (
            behind_copula and word.form in told.degrees
        )
    return words


def _behind(words: Sequence[SourceWord], place: int, morphology: Morphology) -> tuple[Reading, ...]:
    """The readings of a word that may stand behind the one before it.

    No noun stands behind a pronoun ("yo cuento", "que me firmes"); no finite verb behind another or behind
    a preposition ("no llevo suelto", "sin falta"), but an order may follow an order ("espera llama a Ana").
    Behind an article that may be a pronoun a noun agrees with it ("las riego"), and what does so is hardly a
    subjunctive ("la calle"), and none behind a verb or a preposition ("pitó la falta").
    """
    word, before = words[place], words[place - 1]
    verbs = tuple(each for each in word.readings if _PERSONAL.fullmatch(each.tag))
    others = tuple(each for each in word.readings if each not in verbs)
    if not verbs or not any(each.exact for each in others):
        return word.readings
    if any(each.exact for each in verbs) and all(each.tag in _SUBJECTS for each in before.readings):
        return tuple(each for each in word.readings if not each.tag.startswith("N:"))
    if all(each.tag.startswith(("PRON:obj", "PRON:refl")) for each in before.readings):
        return verbs if any(each.exact for each in verbs) else word.readings
    tags = [each.tag for each in before.readings if each.exact]
    if _governs(before):
        opens = place == 1 or words[place - 2].is_mark
        orders = opens and _may_order(before, morphology) and _may_order(word, morphology)
        return word.readings if orders else others
    article = next(filter(None, map(_ARTICLE.fullmatch, tags)), None)
    if article is None:
        return word.readings
    agreeing = tuple(each for each in others if _agrees(each, *article.groups()))
    denied = place > 1 and words[place - 2].readings[0].tag == "ADV:neg"
    unlikely = not denied and all(each.tag.startswith("V:sub") for each in verbs if each.exact)
    if agreeing and (unlikely or (place > 1 and _governs(words[place - 2]))):
        return agreeing
    return tuple(each for each in word.readings if each in agreeing or not each.tag.startswith(("N:", "A:")))


def _governs(word: SourceWord) -> bool:
    """Whether a word is a finite verb or a preposition, and nothing else."""
    tags = [each.tag for each in word.readings if each.exact]
    return bool(tags) and all(tag.startswith("PREP") or _PERSONAL.fullmatch(tag) for tag in tags)


def _may_order(word: SourceWord, morphology: Morphology) -> bool:
    """Whether a word may be an order to somebody who is called *tú*."""
    verbs = {reading.lemma for reading in word.readings if reading.tag.startswith(_FINITE)}
    return any(morphology.is_form(word.form, verb, "V:imp:2s") for verb in verbs)


def _agrees(reading: Reading, gender: str, number: str) -> bool:
    """Whether a noun or adjective may stand behind an article; any other word may."""
    kind, _, form = reading.tag.rpartition(":")
    return kind not in ("N", "A") or (form[:1] in (gender, "c") and form[1:] in (number, "n"))


def _counting(words: Sequence[SourceWord], morphology: Morphology) -> SourceWord:
    """The first of four words, a number alone if a half is counted with it ("un litro y medio")."""
    numbers = TextRules.load(morphology.folder).numbers
    number = tuple(reading for reading in words[0].readings if reading.tag == "NUM")
    half = any(reading.lemma in numbers.fractions[:1] for reading in words[3].readings)
    counts = number and words[1].readings[0].tag.startswith("N:") and words[2].form == numbers.joiner
    return replace(words[0], readings=number) if counts and half else words[0]


def _does(word: SourceWord, following: SourceWord, copulas: Collection[str]) -> tuple[Reading, ...]:
    """The readings of a word that the one behind leaves it.

    A reflexive pronoun before a verb is no verb typed without its accent ("se lima las uñas"), and a form of
    two verbs is the copula's before an adjective ("sé amable", "fue feliz").
    """
    tags = [each.tag for each in following.readings if each.exact]
    exact = tuple(each for each in word.readings if each.exact)
    if exact and all(each.tag.startswith("PRON:refl") for each in exact):
        acts = any(_PERSONAL.fullmatch(tag) and tag[-2:-1] == "3" for tag in tags)
        return exact if acts else word.readings
    adjective = bool(tags) and all(tag.startswith("A:") for tag in tags)
    return tuple(each for each in exact if adjective and each.lemma in copulas) or word.readings


def _as_order(readings: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """Readings of a word that is a clause of its own: of two verbs the one that is an order ("Ven, ...")."""
    verbs = [reading for reading in readings if reading.tag.startswith(_FINITE)]
    orders = tuple(reading for reading in verbs if reading.tag.startswith("V:imp"))
    return orders if orders and len({reading.lemma for reading in verbs}) > 1 else readings


def _is_participle(word: SourceWord, *, behind: SourceWord | None) -> bool:
    """Whether a word is a verb's participle here; what may be a noun is one behind an object's pronoun."""
    tags = [reading.tag for reading in word.readings if reading.exact]
    object_before = behind is not None and any(
        reading.tag.startswith(("PRON:obj", "PRON:refl")) for reading in behind.readings
    )
    return any(tag == "V:part:ms" for tag in (tags if object_before else tags[:1]))


def _is_nominal(reading: Reading) -> bool:
    return not reading.tag.startswith((*_FINITE, "PREP"))


def _no_orders(readings: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """What a word behind a pronoun that is acted upon may be: no order, on which it would hang ("lo di")."""
    return tuple(each for each in readings if not each.tag.startswith("V:imp")) or readings


def _no_participles(readings: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """What a word behind an article may be: no participle, if it may be a noun ("un puesto")."""
    nouns = any(reading.tag.startswith("N:") for reading in readings)
    return tuple(each for each in readings if not nouns or not each.tag.startswith("V:part"))


def _without_verbs(readings: tuple[Reading, ...], *, prepositions: bool) -> tuple[Reading, ...]:
    """What a word may be that is no finite verb, and no preposition if it may be a noun; all if nothing."""
    nouns = any(reading.tag.startswith("N:") for reading in readings)
    kept = (
        reading
        for reading in readings
        if not reading.tag.startswith(_FINITE) and not (reading.tag == "PREP" and nouns and not prepositions)
    )
    return tuple(kept) or readings


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
    return not (own_capital or word.readings[0].tag.startswith("PRON"))


def _all_readings(word: SourceWord, morphology: Morphology) -> tuple[Reading, ...]:
    """The readings of a word, that of a given name among them though it is a common word too."""
    if word.readings[0].tag in ("NUM", "X") or " " in word.form:
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
