# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Figures of translations, against ones reckoned by hand."""

from __future__ import annotations

from teo_sign_training.fitting.metrics import score


def _glosses(*lines: str) -> list[tuple[str, ...]]:
    return [tuple(line.split()) for line in lines]


def test_an_exact_translation_is_one_with_the_same_glosses_in_the_same_order() -> None:
    result = score(_glosses("YO PAN COMER", "ANA QUIÉN"), _glosses("YO PAN COMER", "QUIÉN ANA"))
    assert (result.count, result.exact) == (2, 0.5)
    assert score([], []).exact == 0.0
