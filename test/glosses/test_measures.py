# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Figures of translations, against ones reckoned by hand."""

from __future__ import annotations

import pytest

from glosses.measures import fewest_edits, overlap


def _glosses(*lines: str) -> list[tuple[str, ...]]:
    return [tuple(line.split()) for line in lines]


def test_signs_in_common_are_counted_as_bags_and_pairs_of_them_in_order() -> None:
    signed = _glosses("LOBO CASA SOPLAR", "CERDO CERDO CORRER")
    said = _glosses("SOPLAR LOBO CASA FUERTE", "CERDO CORRER")
    result = overlap(signed, said)
    assert result.precision == 5 / 6  # FUERTE is nobody's
    assert result.recall == 5 / 6  # one CERDO is missing
    assert result.pairs == 3  # CERDO is signed twice: it has no one place
    assert result.in_order == 1 / 3  # LOBO CASA


def test_nothing_in_common_is_nothing_and_no_error() -> None:
    assert overlap([], []).in_order == 0.0
    result = overlap(_glosses("A", ""), _glosses("", "B"))
    assert (result.precision, result.recall, result.pairs) == (0.0, 0.0, 0)


@pytest.mark.parametrize(
    ("accepted", "got", "edits"),
    [
        (["A B C"], "A B C", (0, 3)),
        (["A B C"], "A X C D", (2, 3)),
        (["A B C"], "", (3, 3)),
        (["A B C", "C A"], "C A B", (1, 2)),
    ],
)
def test_edits_are_counted_to_the_nearest_accepted_translation(
    accepted: list[str], got: str, edits: tuple[int, int]
) -> None:
    assert fewest_edits(_glosses(*accepted), tuple(got.split())) == edits
