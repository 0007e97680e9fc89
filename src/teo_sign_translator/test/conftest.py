from __future__ import annotations

import pytest

from teo_sign_translator.translator import Translator


@pytest.fixture(scope="session")
def translator() -> Translator:
    """The published model with the shipped data; it keeps nothing between texts."""
    return Translator.load("lstm256")
