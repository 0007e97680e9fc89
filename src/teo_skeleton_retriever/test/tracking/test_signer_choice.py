# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.tracking.person_tracker import SignerChoice

FAR_AHEAD = np.array([0.0, 0.0, 2.5])
NEAR_ASIDE = np.array([0.8, 0.0, 1.5])


def test_the_nearest_or_the_most_central_is_chosen() -> None:
    people = {4: FAR_AHEAD, 7: NEAR_ASIDE}
    assert SignerChoice("nearest", 3.0).step(0.0, people) == 7
    assert SignerChoice("central", 3.0).step(0.0, people) == 4


def test_a_signer_stays_when_somebody_comes_nearer() -> None:
    choice = SignerChoice("nearest", 3.0)
    assert choice.step(0.0, {1: FAR_AHEAD}) == 1
    assert choice.step(0.1, {1: FAR_AHEAD, 2: NEAR_ASIDE}) == 1


def test_a_signer_who_is_hidden_is_waited_for_then_given_up() -> None:
    choice = SignerChoice("nearest", 2.0)
    choice.step(0.0, {1: FAR_AHEAD})
    assert choice.step(1.9, {2: NEAR_ASIDE}) is None
    assert choice.signer == 1
    assert choice.step(2.1, {2: NEAR_ASIDE}) == 2
    assert choice.step(2.2, {1: FAR_AHEAD, 2: NEAR_ASIDE}) == 2


def test_a_locked_signer_is_waited_for_without_end() -> None:
    choice = SignerChoice("nearest", 0.1)
    choice.lock(9)
    assert choice.step(0.0, {1: FAR_AHEAD}) is None
    assert choice.step(1e6, {1: FAR_AHEAD}) is None
    assert choice.step(1e6 + 1, {1: FAR_AHEAD, 9: NEAR_ASIDE}) == 9


def test_after_unlocking_the_signer_stays_until_they_leave() -> None:
    choice = SignerChoice("nearest", 0.5)
    choice.lock(1)
    choice.step(0.0, {1: FAR_AHEAD, 2: NEAR_ASIDE})
    choice.unlock()
    assert choice.step(0.1, {1: FAR_AHEAD, 2: NEAR_ASIDE}) == 1
    assert choice.step(1.0, {2: NEAR_ASIDE}) == 2
