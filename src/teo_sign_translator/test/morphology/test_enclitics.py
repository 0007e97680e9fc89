# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_translator.morphology.spanish import attach_pronouns, detach_pronouns

WRITTEN = [
    ("di", "me lo", "dímelo"),
    ("levanta", "te", "levántate"),
    ("vamos", "nos", "vámonos"),
    ("demos", "se lo", "démoselo"),
    ("dando", "se lo", "dándoselo"),
    ("ayudar", "me", "ayudarme"),
    ("dar", "se lo", "dárselo"),
    ("sentad", "os", "sentaos"),
    ("vestid", "os", "vestíos"),
    ("id", "os", "idos"),
    ("oír", "lo", "oírlo"),
    ("reír", "se", "reírse"),
    ("dé", "me", "deme"),
    ("haz", "lo", "hazlo"),
    ("sigue", "me", "sígueme"),
    ("trae", "lo", "tráelo"),
    ("guía", "me", "guíame"),
    ("cuida", "te", "cuídate"),
    ("estudia", "lo", "estúdialo"),
]


@pytest.mark.parametrize(("form", "pronouns", "whole"), WRITTEN)
def test_pronouns_hang_on_a_verb_as_they_are_written(form: str, pronouns: str, whole: str) -> None:
    assert attach_pronouns(form, tuple(pronouns.split())) == whole


@pytest.mark.parametrize(("form", "pronouns", "whole"), WRITTEN)
def test_what_was_attached_can_be_taken_off(form: str, pronouns: str, whole: str) -> None:
    plain = str.maketrans("áéíóú", "aeiou")
    assert (form.translate(plain), tuple(pronouns.split())) in set(detach_pronouns(whole.translate(plain)))
