# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The judge of the table's entries must not take the rounding of a plan for motion beyond the limits."""

from __future__ import annotations

from lexicon import bad_of_batch


def test_an_entry_whose_pieces_meet_to_within_rounding_keeps_its_limits() -> None:
    # Where pieces of these plans join, positions differ by 1e-9 to 7e-9 rad.
    assert bad_of_batch(["PATIO", "EMPODERAMIENTO"]) == []
