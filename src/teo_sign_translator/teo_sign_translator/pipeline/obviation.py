# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who does what a subjunctive says, whose form alone is "yo" and "él".

"Quiero que sea feliz" never wishes the signer happy: a subjunctive that "que" joins to a verb has another
subject than that verb; with the same one it would be an infinitive (disjoint reference; Nueva gramática de la
lengua española, 2009, chapter 25). In "aunque esté cansada, voy a salir" nobody else is spoken of.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

from teo_sign_translator.pipeline.completeness import CompleteTranslation, PipelineWords
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.source_word import SourceWord

_MAIN = ("V:ind", "V:cond")


def with_other_subjects(
    words: Sequence[SourceWord], said: CompleteTranslation, language: PipelineWords
) -> CompleteTranslation:
    """The same translation, the signer and a third person exchanged where the other one is meant.

    Args:
        words: Of the sentence.
        said: A translation of it.
        language: How the language joins clauses and points at persons.
    """
    meant = [_meant(words, gloss, language) for gloss in said.glosses]
    put_back = [[back] * len(each) for each, back in zip(meant, said.put_back, strict=True)]
    return replace(said, glosses=tuple(chain(*meant)), put_back=tuple(chain(*put_back)))


def _meant(words: Sequence[SourceWord], gloss: OutputGloss, language: PipelineWords) -> list[OutputGloss]:
    """Whom a gloss should point at: one, or who acts and the signer, to whom it happens."""
    who = language.obviation
    verb = next((place for place in gloss.sources if _is_ambiguous(words[place])), -1)
    if verb < 0 or gloss.gloss not in (who.signer, who.other):
        return [gloss]
    if gloss.gloss == who.other:
        own = _is_conceded(words, verb, language) and gloss.sources == (verb,)
        return [replace(gloss, gloss=who.signer)] if own else [gloss]
    if not _is_wished(words, verb, language):
        return [gloss]
    if words[verb - 1].form != who.object:
        return [replace(gloss, gloss=who.other)]
    return [
        replace(gloss, gloss=who.other, sources=(verb,)),
        replace(gloss, sources=(verb - 1,)),
    ]


def _is_ambiguous(word: SourceWord) -> bool:
    return any(_is(reading.tag, ("V:sub",), ":3s") for reading in word.readings)


def _is_conceded(words: Sequence[SourceWord], verb: int, language: PipelineWords) -> bool:
    """Whether a verb's clause begins with a concessive, and the clause beside it says what the signer does."""
    begin = max((place + 1 for place, word in enumerate(words[:verb]) if word.is_mark), default=0)
    if words[begin].form not in language.obviation.concessives:
        return False
    return any(_is(word.readings[0].tag, _MAIN, ":1s") for word in words)


def _is_wished(words: Sequence[SourceWord], verb: int, language: PipelineWords) -> bool:
    """Whether a subjunctive stands alone behind a joiner, and a verb of the signer's governs it."""
    who = language.obviation
    joiner = next((place for place in range(verb - 1, 0, -1) if words[place].form == who.joiner), 0)
    between = words[joiner + 1 : verb]
    if not joiner or any(word.is_mark or word.readings[0].tag.startswith(_MAIN) for word in between):
        return False
    main = joiner - 2 if words[joiner - 1].form == who.link else joiner - 1
    if main < 0:
        return False
    reading = words[main].readings[0]
    feels = main > 0 and words[main - 1].form == who.object
    return _is(reading.tag, _MAIN, ":1s") or (
        feels and _is(reading.tag, _MAIN, ":3s") and reading.lemma in language.persons.experiencer_verbs
    )


def _is(tag: str, begins: tuple[str, ...], ends: str) -> bool:
    return tag.startswith(begins) and tag.endswith(ends)
