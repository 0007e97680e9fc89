# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How people type: accents, capitals and marks left out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_sign_training.fitting.examples import Examples, Ints, WordTable

#: Of the pairs that are not shown as written, how many lose what. Not measured on people: half of each, so
#: that all eight ways of typing a sentence are about as frequent.
NO_ACCENTS = 0.6
NO_CAPITALS = 0.6
NO_FINAL_MARK = 0.3
NO_MARKS = 0.3


@dataclass(frozen=True, slots=True)
class Typing:
    """How each pair of a pass is typed.

    Attributes:
        variant: Column of `WordTable.variants`. Shape (n,).
        drop_final: Whether a mark at the end is left out. Shape (n,).
        drop_marks: Whether all marks are left out. Shape (n,).
    """

    variant: Ints
    drop_final: NDArray[np.bool_]
    drop_marks: NDArray[np.bool_]

    @classmethod
    def draw(cls, count: int, clean: float, random: np.random.Generator) -> Typing:
        """A way of typing for each pair; `clean` of them as written."""
        noisy = random.random(count) >= clean
        variant = (random.random(count) < NO_ACCENTS) + 2 * (random.random(count) < NO_CAPITALS)
        marks = random.random(count)
        return cls(
            np.where(noisy, variant, 0).astype(np.int64),
            noisy & (marks < NO_FINAL_MARK),
            noisy & (marks >= NO_FINAL_MARK) & (marks < NO_FINAL_MARK + NO_MARKS),
        )


def typed(examples: Examples, table: WordTable, typing: Typing) -> Examples:
    """The pairs as typed: words replaced by their variants, marks left out, the alignment kept.

    A mark that a gloss stands for stays.
    """
    lengths = np.diff(examples.word_start)
    words = table.variants[examples.words, np.repeat(typing.variant, lengths)]
    drop = np.repeat(typing.drop_marks, lengths)
    final = (examples.word_start[1:] - 1)[lengths > 0]
    drop[final] |= typing.drop_final[lengths > 0]
    drop &= table.marks[words]
    drop[examples.link_word] = False
    keep = ~drop
    place = np.concatenate([[0], np.cumsum(keep)])
    return Examples(
        words[keep],
        place[examples.word_start],
        examples.glosses,
        examples.gloss_start,
        examples.link_gloss,
        place[examples.link_word],
        examples.link_start,
    )


def copies(examples: Examples, table: WordTable) -> NDArray[np.bool_]:
    """For each link, which readings of its word would copy its gloss. Shape (n_links, READINGS)."""
    wanted = examples.glosses[examples.link_gloss]
    result: NDArray[np.bool_] = table.copies[examples.words[examples.link_word]] == wanted[:, None]
    return result


def unsayable(
    examples: Examples, table: WordTable, closed: NDArray[np.bool_], copy: bool
) -> NDArray[np.bool_]:
    """Which pairs hold a gloss that is neither in the closed list nor a copy. Shape (n,).

    Args:
        examples: The pairs.
        table: Their words.
        closed: For each gloss of the table whether it is in the closed list.
        copy: Whether the model can copy.
    """
    sayable = closed[examples.glosses]
    if copy:
        sayable[examples.link_gloss[copies(examples, table).any(axis=1)]] = True
    bad = np.concatenate([[0], np.cumsum(~sayable)])
    result: NDArray[np.bool_] = bad[examples.gloss_start[1:]] > bad[examples.gloss_start[:-1]]
    return result


def typed_sayably(
    examples: Examples, table: WordTable, typing: Typing, closed: NDArray[np.bool_], copy: bool
) -> Examples:
    """`typed`, but with accents and capitals where a gloss could not be said without them."""
    lost = unsayable(typed(examples, table, typing), table, closed, copy)
    kept = Typing(np.where(lost, 0, typing.variant), typing.drop_final, typing.drop_marks)
    return typed(examples, table, kept)
