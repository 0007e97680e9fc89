# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What takes long to load, once for all tests of a process."""

from __future__ import annotations

from functools import cache

from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pipeline.translator import DEFAULT_MODEL, Translator


@cache
def morphology() -> Morphology:
    return Morphology.load()


@cache
def translator(name: str = DEFAULT_MODEL) -> Translator:
    return Translator.load(name)
