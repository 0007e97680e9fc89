# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Glosses of a sentence model as output words: signs, names, numbers and pauses, with the words they say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from teo_sign_translator.morphology import Reading
from teo_sign_translator.output.output_words import PAUSE, OutputWord, carried, lexical, number
from teo_sign_translator.output.translation import Origin
from teo_sign_translator.pipeline.agreement import Agreement
from teo_sign_translator.pipeline.completeness import CompleteTranslation
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.names import is_persons_name
from teo_sign_translator.text.rules import GlossNames
from teo_sign_translator.text.source_words import SourceWord

_CENT_DIGITS = 2


def gloss_output_words(
    words: Sequence[SourceWord],
    said: CompleteTranslation,
    agreement: Agreement,
    names: GlossNames,
) -> list[OutputWord]:
    """Glosses as output words, those that none says behind them; marks between them are pauses.

    Args:
        words: Of the sentence.
        said: Its translation; the glosses of a given one are no names whatever their words.
        agreement: Gives the form of signs that agree.
        names: Of glosses, in the language.
    """
    typed = [_texts(words, sorted(gloss.sources)) for gloss in said.glosses]
    pauses = _pauses(words, said.glosses)
    result: list[OutputWord] = []
    for place, (gloss, put_back, own) in enumerate(zip(said.glosses, said.put_back, typed, strict=True)):
        # "me llamo rosa" is MI NOMBRE R-O-S-A
        named = place > 0 and said.glosses[place - 1].gloss == names.name
        origin = Origin.REPAIRED if put_back else Origin.MODEL
        neighbours = {each.gloss for each in said.glosses[max(0, place - 1) : place + 2]}
        if neighbours & names.currencies:  # "12,50 €" is said "doce cincuenta"
            gloss = replace(gloss, gloss=_price(gloss.gloss))
        form = agreement.inflection(gloss.gloss, gloss.sources, words)
        own_words = [
            replace(each, inflection=form)
            for each in _output_words(words, gloss, origin, own, names, named=named)
        ]
        result += [replace(each, is_name=False) for each in own_words] if said.given else own_words
        if place in pauses:
            result.append(PAUSE)
    claimed = {place for gloss in said.glosses for place in gloss.sources}
    left = [place for place, word in enumerate(words) if place not in claimed and not word.is_mark]
    return [*result, *(carried(words[place].form, (words[place].text,)) for place in left)]


def _price(gloss: str) -> str:
    """A price as its two numbers, written as hours and minutes are: 12,50 euros are 12 and 50, 12,5 too."""
    whole, comma, cents = gloss.partition(",")
    if not comma or not whole.isdecimal() or not 0 < len(cents) <= _CENT_DIGITS:
        return gloss
    return f"{whole}:{cents.ljust(_CENT_DIGITS, '0').removeprefix('0') or '0'}" if int(cents) else whole


def _output_words(
    words: Sequence[SourceWord],
    gloss: OutputGloss,
    origin: Origin,
    typed: tuple[str, ...],
    names: GlossNames,
    *,
    named: bool,
) -> list[OutputWord]:
    """A gloss as a sign, a name or a number.

    Args:
        words: Of the sentence.
        gloss: What is said.
        origin: How it came about.
        typed: The words that it stands for.
        names: Of glosses, in the language.
        named: Whether it follows the sign for "name".
    """
    readings = [reading for source in gloss.sources for reading in words[source].readings]
    meant = [reading for reading in readings if copied_gloss(reading) == gloss.gloss]
    if gloss.gloss[0].isdigit():
        return number(gloss.gloss, typed, gloss.probability, names.decimal)
    if _is_name([words[source] for source in gloss.sources], meant, named=named):
        return [lexical(gloss.gloss, typed, gloss.probability, is_name=True)]
    return [lexical(gloss.gloss, typed, gloss.probability, origin)]


def _is_name(words: Sequence[SourceWord], meant: Sequence[Reading], *, named: bool) -> bool:
    """Whether a gloss is somebody's name.

    Args:
        words: That it stands for.
        meant: Their readings that have this gloss, the likeliest first.
        named: Whether it follows the sign for "name"; then any word that may be a name is one.
    """
    if named and any(is_persons_name(reading) or reading.tag == "X" for reading in meant):
        return True
    listed = any(is_persons_name(reading) and reading.exact for reading in meant)
    return bool(meant) and (is_persons_name(meant[0]) or (listed and any(word.capital for word in words)))


def _texts(words: Sequence[SourceWord], places: Sequence[int]) -> tuple[str, ...]:
    """What was typed at some places, a short form of several words once."""
    result: list[str] = []
    before: SourceWord | None = None
    for word in (words[place] for place in places if not words[place].is_mark):
        if before is None or word.text != before.text or word.form == before.form:
            result.append(word.text)
        before = word
    return tuple(result)


def _pauses(words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> set[int]:
    """Glosses behind which a mark of the sentence falls: all before it come from words before the mark."""
    result: set[int] = set()
    highest: list[int] = []
    lowest: list[int] = []
    for gloss in glosses:
        highest.append(max([*highest[-1:], *gloss.sources], default=-1))
    for gloss in reversed(glosses):
        lowest.insert(0, min([*lowest[:1], *gloss.sources], default=len(words)))
    for mark in (place for place, word in enumerate(words) if word.is_mark):
        for place in range(len(glosses) - 1):
            if highest[place] < mark < lowest[place + 1] and highest[place] >= 0:
                result.add(place)
                break
    return result
