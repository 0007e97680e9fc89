from __future__ import annotations

import sys
from pathlib import Path

import pytest

from teo_sign_translator.pipeline.translator import Translator

# What several tests here need stands beside them.
sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="session")
def translator() -> Translator:
    """The published model with the shipped data; it keeps nothing between texts."""
    return Translator.load("lstm256")
