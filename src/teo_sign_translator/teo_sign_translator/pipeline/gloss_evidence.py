# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which glosses of a translation have no evidence in the sentence: a model has invented them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import lru_cache
from pathlib import Path

from teo_common.text_folding import fold
from teo_sign_translator.data_files import data_file, invalid_line, read_rows
from teo_sign_translator.morphology import MAX_READINGS, Reading
from teo_sign_translator.pipeline.language_words import EvidenceWords, PipelineWords
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_words import SourceWord

_NONE = "-"
# Tags of what may stand between a subject's determiner and its verb.
_BETWEEN = ("N:", "A:", "ADV:neg", "PRON:obj", "PRON:refl")
# Forms that the first and the third person share, which morphology names the third.
_SHARED_FORMS = ("V:ind:impf", "V:cond", "V:sub")
# Least probability with which a shared form is taken for the first person: of the known sentences where the
# model said YO for one, those that meant it had 0.95 and more.
_SURE_OF_SUBJECT = 0.9
# Tags of words behind which a noun comes, and of what then cannot stand there.
_NOMINAL = ("PREP", "DET:def", "DET:poss")
_VERBAL = ("V:ind", "V:cond", "V:sub", "V:imp", "PRON:obj", "PRON:refl")
_PAST_TAGS = ("V:ind:pret:", "V:ind:impf:")


@dataclass(frozen=True, slots=True)
class Evidence:
    """What in a sentence is evidence for a gloss.

    Attributes:
        tags: Patterns of tags.
        lemmas: Dictionary forms.
    """

    tags: tuple[str, ...]
    lemmas: frozenset[str]

    def given_by(self, reading: Reading, clitics: Mapping[str, str]) -> bool:
        """Whether this reading is evidence for the gloss; `clitics` gives the tags of a verb's pronouns."""
        return (
            reading.lemma in self.lemmas
            or _fits(reading.tag, self.tags)
            or any(_fits(clitics.get(clitic, ""), self.tags) for clitic in reading.clitics)
        )


class GlossEvidence:
    """Finds invented glosses."""

    def __init__(self, by_gloss: Mapping[str, Evidence], words: EvidenceWords) -> None:
        """Take the evidence that each gloss needs, others need none, and the words of the language."""
        self._by_gloss = dict(by_gloss)
        self._words = words

    @classmethod
    def load(cls, path: Path | None = None, folder: Path | None = None) -> GlossEvidence:
        """Read the list, and the language's words.

        Args:
            path: The file; by default the package's `text/gloss_evidence.tsv`, which explains its columns.
            folder: The language's text folder; by default that of the default language.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        path = path or data_file("gloss_evidence.tsv")
        found: dict[str, Evidence] = {}
        for number, (gloss, tags, lemmas) in read_rows(path, columns=3):
            if gloss in found or gloss != gloss.upper():
                raise invalid_line(path, number, "a gloss in capitals, once", f"'{gloss}'")
            found[gloss] = Evidence(tuple(_listed(tags)), frozenset(_listed(lemmas)))
        return cls(found, PipelineWords.load(folder).evidence)

    def invented(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> list[int]:
        """Places of the glosses that no word is evidence for.

        Besides those listed: of PASADO beside a verb that is now, of a word said twice that is there once,
        and of YO where its verb may as well be of the third person ("vivía") and the model is not sure, or a
        subject stands before it ("que la casa sea").

        Args:
            words: Of the sentence.
            glosses: Its translation.
        """
        meant = _meant(words)
        readings = [reading for each in meant for reading in each]
        return [
            place
            for place, gloss in enumerate(glosses)
            if (self._lacks_evidence(gloss.gloss, readings) and not _unsure(gloss, words))
            or (gloss.gloss == self._words.past and self._present(glosses[place:], meant))
            or (gloss.gloss not in self._by_gloss and self._said_again(place, glosses, words))
            or (gloss.gloss == self._words.signer and _doubtful_subject(gloss, words))
        ]

    def says_every(self, gloss: OutputGloss, words: Sequence[SourceWord]) -> bool:
        """Whether a gloss stands for "cada": again, it says every second one (cada dos días: DÍA DÍA)."""
        return any(words[place].form == self._words.every for place in gloss.sources)

    def _lacks_evidence(self, gloss: str, readings: Sequence[Reading]) -> bool:
        evidence = self._by_gloss.get(gloss)
        return evidence is not None and not any(
            evidence.given_by(reading, self._words.clitics) or copied_gloss(reading) == gloss
            for reading in readings
        )

    def _present(self, glosses: Sequence[OutputGloss], meant: Sequence[Sequence[Reading]]) -> bool:
        """Whether PASADO and the subject behind it stand for the same verb, which has that person only now.

        "llego" is first person of the present, third of the past where the accent is left out.
        """
        person = self._words.persons.get(glosses[1].gloss) if len(glosses) > 1 else None
        if person is None or glosses[0].sources != glosses[1].sources:
            return False
        verbs = [reading for place in glosses[0].sources for reading in meant[place]]
        tags = [verb.tag for verb in verbs if verb.lemma != self._words.auxiliary]
        return f"V:ind:pres:{person}" in tags and not any(f"{past}{person}" in tags for past in _PAST_TAGS)

    def _said_again(self, place: int, glosses: Sequence[OutputGloss], words: Sequence[SourceWord]) -> bool:
        """Whether a gloss was said before for the same word.

        What is denied may be said of the same subject again ("no somos médicos, somos profesores").
        """
        gloss = glosses[place]
        again = [at for at in range(place) if glosses[at].gloss == gloss.gloss]
        if not again:
            return False
        said = [word for word in words if any(copied_gloss(each) == gloss.gloss for each in word.readings)]
        if len(said) != 1:
            return False
        if again[-1] == place - 1:
            return not any(self.says_every(each, words) for each in (glosses[place - 1], gloss))
        denied = any(each.gloss == self._words.denial for each in glosses[again[-1] : place])
        return not denied and bool(set(glosses[again[-1]].sources) & set(gloss.sources))


def _unsure(gloss: OutputGloss, words: Sequence[SourceWord]) -> bool:
    """Whether a source of the gloss has as many readings as are kept, so that one may be missing: "bajo"."""
    return any(len(words[place].readings) >= MAX_READINGS for place in gloss.sources)


def _meant(words: Sequence[SourceWord]) -> list[list[Reading]]:
    """Readings of each word; if the sentence has accents, only those written as the word is typed.

    Behind a preposition or an article stands no finite verb, and behind a preposition no pronoun that a verb
    has before it: nobody is named by "la" and "baja" in "por la baja". Nor is a verb another one that lacks
    its accent: "vengo" is no "vengó".
    """
    accents = any(word.form != fold(word.form) for word in words)
    result: list[list[Reading]] = []
    for word in words:
        readings = [reading for reading in word.readings if reading.exact or not accents]
        if result and result[-1] and all(each.tag.startswith(_NOMINAL) for each in result[-1]):
            readings = [each for each in readings if not each.tag.startswith(_VERBAL)] or readings
        first = word.readings[0]
        if first.exact and first.tag.startswith("V:"):
            readings = [each for each in readings if each.exact or each.lemma == first.lemma]
        result.append(readings)
    return result


def _doubtful_subject(gloss: OutputGloss, words: Sequence[SourceWord]) -> bool:
    named = [place for place in gloss.sources if not words[place].readings[0].tag.startswith("N:")]
    tags = [reading.tag for place in named for reading in words[place].readings if reading.exact]
    if not any(map(_is_shared, tags)) or not all(tag.endswith(":3s") for tag in tags):
        return False
    return gloss.probability < _SURE_OF_SUBJECT or any(_has_subject(place, words) for place in named)


def _is_shared(tag: str) -> bool:
    return tag.startswith(_SHARED_FORMS)


def _has_subject(verb: int, words: Sequence[SourceWord]) -> bool:
    """Whether a noun with its determiner, and no preposition before it, stands before a verb."""
    tags = [word.readings[0].tag for word in words[:verb]]
    at = len(tags) - 1
    while at >= 0 and tags[at].startswith(_BETWEEN):
        at -= 1
    noun = any(tag.startswith("N:") for tag in tags[at + 1 :])
    return at >= 0 and noun and tags[at].startswith("DET") and not (at and tags[at - 1].startswith("PREP"))


def _listed(text: str) -> list[str]:
    return [] if text == _NONE else [each.strip() for each in text.split(",")]


@lru_cache(maxsize=4096)
def _fits(tag: str, patterns: tuple[str, ...]) -> bool:
    return any(fnmatchcase(tag, pattern) for pattern in patterns)
