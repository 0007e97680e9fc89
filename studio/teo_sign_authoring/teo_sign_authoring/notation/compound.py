# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs that are made of others: a compound, or one sign under a second name."""

from __future__ import annotations

from collections.abc import Sequence

from teo_sign_authoring.notation.score_schema import Compound, HandScore, HeadScore, Score, Step, flattened

# [s] From one part to the next. In the dictionary's compounds (BUENOS_DÍAS and the like) 0.2 s to 0.4 s.
_BETWEEN = 0.3

# A left hand that is not needed yet: before the hip, where no other hand comes by.
_WAITING = HandScore(
    shape="relaxed", place="belly 16 front 28 out", part="palm", palm="in down", fingers="front"
)


def performed(compound: Compound, parts: Sequence[Score]) -> Score:
    """The score of a compound: its parts one after the other.

    Where a part is made with the right hand alone, the left one waits low at its side until it is needed, and
    afterwards stays where it was.

    Args:
        compound: What it is called, and what it rests on.
        parts: The scores of its signs, in order.
    """
    together = {part.hands for part in parts}
    hands = together.pop() if len(together) == 1 else "both"
    steps: list[Step] = []
    for part in parts:
        own = _steps(part, hands=hands)
        # Said in full: a part knows nothing of how the one before it ended.
        own[0] = own[0].model_copy(
            update={
                "time": _BETWEEN,
                "right": _in_full(own[0].right),
                "left": _in_full(own[0].left),
                "head": own[0].head or HeadScore(turn=0.0, bow=0.0),
            }
        )
        steps += own
    if hands == "both" and steps[0].left is None:
        steps[0] = steps[0].model_copy(update={"left": _WAITING})
    return Score(
        gloss=compound.gloss,
        kind=compound.kind,
        standing=compound.standing,
        source=compound.source,
        hands=hands,
        face=compound.face or ", then ".join(dict.fromkeys(part.face for part in parts if part.face)),
        forms=None,
        notes=" ".join(filter(None, (compound.notes, *(part.notes for part in parts)))),
        steps=list(steps),
    )


def _steps(part: Score, *, hands: str) -> list[Step]:
    """The steps of a part; the left hand written out where it mirrors the right one and others do not."""
    steps = flattened(part.steps)
    if part.hands == "mirrored" and hands == "both":
        return [step.model_copy(update={"left": step.right}) for step in steps]
    return steps


def _in_full(hand: HandScore | None) -> HandScore | None:
    return hand if hand is None or hand.part else hand.model_copy(update={"part": "palm"})
