# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A model is trusted where it is sure, or hesitates but says what the sentence says."""

from __future__ import annotations

import pytest

from teo_sign_translator.pipeline.trust import agreement, is_trusted
from teo_sign_translator.pointer import OutputGloss


def _glosses(text: str, probability: float = 1.0) -> tuple[OutputGloss, ...]:
    return tuple(OutputGloss(gloss, (), probability, copied=True) for gloss in text.split())


DRAFT = _glosses("NIÑO LECHE BEBER")


@pytest.mark.parametrize(
    ("said", "probability", "faults", "trusted"),
    [
        ("NIÑO LECHE BEBER", 0.99, 0, True),
        ("NIÑO LECHE", 0.99, 1, True),  # sure: mended
        ("NIÑO LECHE BEBER", 0.6, 0, True),
        ("NIÑO LECHE", 0.6, 1, False),
        ("MOTIVO ÉL LECHE", 0.6, 0, False),  # hesitates, and the words are not these
        ("NIÑO LECHE BEBER", 0.2, 0, False),
        ("", 1.0, 0, False),
        ("NIÑO NIÑO NIÑO NIÑO NIÑO NIÑO NIÑO", 1.0, 0, False),  # three words never take seven
    ],
)
def test_trust(said: str, probability: float, faults: int, *, trusted: bool) -> None:
    assert is_trusted(_glosses(said, probability), DRAFT, faults=faults, words=3) is trusted


def test_agreement_counts_shared_glosses_of_all() -> None:
    assert agreement(DRAFT, DRAFT) == 1.0
    assert agreement(DRAFT, _glosses("NIÑO")) == pytest.approx(0.5)
    assert agreement(DRAFT, _glosses("NO")) == 0.0
    assert agreement((), ()) == 1.0
