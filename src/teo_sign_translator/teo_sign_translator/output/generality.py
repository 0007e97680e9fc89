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
from teo_sign_translator.text.reading import Clause
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.sentence_type import SentenceType, is_negated


def may_be_generalised(clauses: Sequence[Clause], kind: SentenceType, rules: TextRules | None = None) -> bool:
    """Whether any word of a sentence may give way to a more general one, and it stays true.

    Args:
        clauses: Of the sentence.
        kind: Its type.
        rules: Of its language; by default the default language's.
    """
    if kind is not SentenceType.STATEMENT or is_negated(clauses, rules):
        return False
    listed = (rules or TextRules.load()).generality
    words = [fold(word.lower) for clause in clauses for word in clause.words]
    return not any(word in listed.strict or word.startswith(listed.of_kinds) for word in words)
