# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether a model's translation is to be trusted, or a draft of the sentence is better.

What a model invents misleads more than an order that is not quite a signer's. It is trusted by its
confidence, by whether it says all that the sentence says and nothing else, and, where it hesitates, by how
much of it the draft says too.

Measured with the shipped weights on 806 known sentences and 260 of two stories that a person signed
(LSE-RADIS), of the whole translator, without and with drafts: of the known 600 and 599 come out as accepted;
of the signs for the stories 27.5 and 27.9 % are the signer's, 47 % of whose signs are among them, with 82 %
of their pairs in order. The known ones flatter the model, which was mended by them. Stricter limits gain
nothing (27.7 % with 0.5, 0.9 and 0.8) and lose ten of the known. Drafts alone have 402 of the known.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from teo_sign_translator.pointer import OutputGloss

#: Least probability of a gloss, 0 to 1, with which a translation is trusted at all.
UNSURE = 0.3
#: Least probability of a gloss with which faults are mended instead, and nothing need be compared.
SURE = 0.7
#: Least part of their glosses, 0 to 1, that a hesitant translation and the draft have in common.
AGREEMENT = 0.5
#: Glosses that a translation may have for each word: pronoun and question or negation beside the word itself.
GLOSSES_A_WORD = 2


def is_trusted(
    glosses: Sequence[OutputGloss], draft: Sequence[OutputGloss], *, faults: int, words: int
) -> bool:
    """Whether a translation is better than the draft.

    Args:
        glosses: As the model says them.
        draft: Of the same sentence.
        faults: Words that the translation loses and glosses that it invents.
        words: Of the sentence, without marks.
    """
    if not glosses or len(glosses) > GLOSSES_A_WORD * words:
        return False
    least = min(gloss.probability for gloss in glosses)
    if least >= SURE:
        return True
    return least >= UNSURE and not faults and agreement(glosses, draft) >= AGREEMENT


def agreement(some: Sequence[OutputGloss], others: Sequence[OutputGloss]) -> float:
    """Glosses that two translations share, of all they have: 0 to 1; 1 if both are empty."""
    left, right = (Counter(gloss.gloss for gloss in each) for each in (some, others))
    total = left.total() + right.total()
    return 2 * (left & right).total() / total if total else 1.0
