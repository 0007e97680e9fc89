# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether a sentence stays true when one of its words gives way to a more general one.

"I have a dog" entails "I have an animal"; "I have no dog" does not entail "I have no animal". A word may be
generalised where its place is upward monotone: not under negation, `sin`, `si` or a comparison, not among all
of a kind or the only ones (`todos`, `solo`), not of a kind as such ("los perros ladran", "me gustan las
rosas"), and not in what is asked or told to be done, which is neither true nor false. It is enough that one
such word stands in the sentence: what it governs is not looked for. This is what logic calls
upward monotonicity; the lists of words are our own.
"""

from __future__ import annotations

from collections.abc import Sequence

from teo_common.text_folding import fold
from teo_sign_translator.data_files import words_of
from teo_sign_translator.text.reading import Clause
from teo_sign_translator.text.sentence_type import SentenceType, is_negated

# Folded words, any of which makes a sentence one that may not stay true.
_STRICT = frozenset(
    words_of(
        "sin ni si excepto salvo menos mas que como apenas dudo duda "
        "todo toda todos todas cada cualquier cualquiera ambos ambas siempre "
        "solo solamente unico unica unicos unicas los las al cuando donde quien "
        "es son era eran sera seran fue fueron mejor peor mayor menor igual"
    )
)
# Beginnings of folded verbs whose object is a kind, or need not exist.
_OF_KINDS = (
    "gust",
    "encant",
    "prefer",
    "prefier",
    "odi",
    "detest",
    "interes",
    "quier",
    "quer",
    "quis",
    "busc",
    "neg",
    "nieg",
    "dud",
    "evit",
    "prohib",
    "falt",
)


def may_be_generalised(clauses: Sequence[Clause], kind: SentenceType) -> bool:
    """Whether any word of a sentence may give way to a more general one, and it stays true.

    Args:
        clauses: Of the sentence.
        kind: Its type.
    """
    if kind is not SentenceType.STATEMENT or is_negated(clauses):
        return False
    words = [fold(word.lower) for clause in clauses for word in clause.words]
    return not any(word in _STRICT or word.startswith(_OF_KINDS) for word in words)
