# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where a network is trained."""

from __future__ import annotations

import pytest
import torch

from teo_sign_training.fitting.network import named_device, one_thread
from teo_sign_translator.errors import TranslationError


def test_a_device_is_taken_by_its_name_and_the_best_one_without() -> None:
    assert named_device("cpu") == torch.device("cpu")
    assert named_device(None) == torch.device("cuda" if torch.cuda.is_available() else "cpu")


@pytest.mark.parametrize("name", ["gpu", "", "cuda:99", "meta:x"])
def test_a_device_that_is_not_there_is_refused_with_its_name(name: str) -> None:
    with pytest.raises(TranslationError, match=f"got '{name}'") as caught:
        named_device(name)
    assert caught.value.code == "invalid_config"


def test_threads_are_given_back_after_a_training_that_fails() -> None:
    before = torch.get_num_threads()
    with pytest.raises(ValueError, match="on purpose"), one_thread():
        assert torch.get_num_threads() == 1
        raise ValueError("on purpose")
    assert torch.get_num_threads() == before
