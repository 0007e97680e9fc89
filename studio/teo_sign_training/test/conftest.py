# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.generator import Generator
from teo_sign_translator.data_files import data_file
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pipeline.translator import Translator


@pytest.fixture(scope="session")
def translator() -> Translator:
    """The published model with the shipped data; it keeps nothing between texts."""
    return Translator.load("lstm256")


@pytest.fixture(scope="session")
def morphology() -> Morphology:
    return Morphology.load()


@pytest.fixture(scope="session")
def generator(morphology: Morphology) -> Generator:
    return Generator.load(data_file("grammar"), morphology)


@pytest.fixture(scope="session")
def pairs(generator: Generator) -> list[Pair]:
    """A small corpus of the shipped grammar, all its splits."""
    return list(generator.pairs(5000, seed=7))
