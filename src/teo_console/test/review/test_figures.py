# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The figures are those that their authors publish."""

from __future__ import annotations

import pytest

from teo_console.review.report import krippendorff_alpha, wilson

# K. Krippendorff, "Computing Krippendorff's alpha-reliability" (2011), example C: four observers, twelve
# units, a dot where one has not looked.
EXAMPLE_C = (
    "1 2 3 3 2 1 4 1 2 . . .",
    "1 2 3 3 2 2 4 1 2 5 . 3",
    ". 3 3 3 2 3 4 2 2 5 1 .",
    "1 2 3 3 2 4 4 1 2 5 1 .",
)


def units(*observers: str) -> list[list[str]]:
    columns = zip(*(line.split() for line in observers), strict=True)
    return [[value for value in column if value != "."] for column in columns]


def test_alpha_of_the_published_examples() -> None:
    assert krippendorff_alpha(units(*EXAMPLE_C)) == pytest.approx(0.743, abs=0.0005)
    # Example B: two observers, five values.
    both = units("a a b b d c c c e d d a", "b a b b b c c c e d d d")
    assert krippendorff_alpha(both) == pytest.approx(0.692, abs=0.0005)
    # Example A: two observers, binary.
    both = units("0 1 0 0 0 0 0 0 1 0", "1 1 1 0 0 1 0 0 0 0")
    assert krippendorff_alpha(both) == pytest.approx(0.095, abs=0.0005)


def test_figures_are_none_where_nothing_tells() -> None:
    assert wilson(0, 0) is None
    assert krippendorff_alpha([["right", "right"], ["wrong", "wrong"]]) == 1.0
    assert krippendorff_alpha([]) is None
    assert krippendorff_alpha([["right"], ["wrong"]]) is None
    assert krippendorff_alpha([["right", "right"], ["right", "right"]]) is None


@pytest.mark.parametrize(
    # R. G. Newcombe, Statistics in Medicine 17 (1998) 857, table I, method 3.
    ("successes", "total", "low", "high"),
    [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)],
)
def test_wilson_of_the_published_examples(successes: int, total: int, low: float, high: float) -> None:
    interval = wilson(successes, total)
    assert interval is not None
    assert interval.share == successes / total
    assert (interval.low, interval.high) == (pytest.approx(low, abs=5e-5), pytest.approx(high, abs=5e-5))
