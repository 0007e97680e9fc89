# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who does what the signer wishes: somebody else.

"Quiero que sea feliz" never wishes the signer happy: a subjunctive that "que" joins to a verb has another
subject than that verb; with the same one it would be an infinitive (disjoint reference; Nueva gramática de la
lengua española, 2009, chapter 25). The form alone does not say so: "sea" is "yo" and "él".
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from teo_sign_translator.pipeline.completeness import PipelineWords
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.source_word import SourceWord

_MAIN = ("V:ind", "V:cond")


def with_other_subjects(
    words: Sequence[SourceWord], glosses: Iterable[OutputGloss], said: PipelineWords
) -> tuple[OutputGloss, ...]:
    """The same glosses, the signer's exchanged for a third person's where the signer cannot be meant.

    Args:
        words: Of the sentence.
        glosses: A translation of it.
        said: How the language joins clauses and points at persons.
    """
    return tuple(
        replace(gloss, gloss=said.obviation.other)
        if gloss.gloss == said.obviation.signer
        and gloss.sources
        and _is_wished(words, gloss.sources[0], said)
        else gloss
        for gloss in glosses
    )


def _is_wished(words: Sequence[SourceWord], verb: int, said: PipelineWords) -> bool:
    """Whether a word is a subjunctive, alone behind a joiner, that a verb of the signer's governs."""
    if not any(_is(reading.tag, ("V:sub",), ":3s") for reading in words[verb].readings):
        return False
    joiner = next(
        (place for place in range(verb - 1, 0, -1) if words[place].form == said.obviation.joiner), 0
    )
    between = words[joiner + 1 : verb]
    if not joiner or any(
        word.is_mark or word.form == said.obviation.object or word.readings[0].tag.startswith(_MAIN)
        for word in between
    ):
        return False
    main = joiner - 2 if words[joiner - 1].form == said.obviation.link else joiner - 1
    if main < 0:
        return False
    reading = words[main].readings[0]
    feels = main > 0 and words[main - 1].form == said.obviation.object
    return _is(reading.tag, _MAIN, ":1s") or (
        feels and _is(reading.tag, _MAIN, ":3s") and reading.lemma in said.persons.experiencer_verbs
    )


def _is(tag: str, begins: tuple[str, ...], ends: str) -> bool:
    return tag.startswith(begins) and tag.endswith(ends)
