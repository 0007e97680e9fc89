# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Annotations of real LSE sentences."""

from __future__ import annotations

from pathlib import Path

import pytest

from glosses.annotated_signs import read_annotated, word_signs

NARRATIVES = Path(__file__).parents[1] / "data" / "radis" / "narratives.tsv"


@pytest.mark.parametrize(
    ("annotation", "signs"),
    [
        ("INDX.PRO:1sg EXPLICAR", "YO EXPLICAR"),
        ("INDX.PRO:2sg INDX:primero INDX ENCANTAR JUGAR(CT)", "TÚ ENCANTAR JUGAR"),
        ("LOBO cl.c(1):PATAS-andar G(B):vale G LISTO(1M)", "LOBO LISTO"),
        ("SECCI- PERA2 hhh (CNM) B.L(3) ALEJARSE(2Msu)", "PERA ALEJARSE"),
        ("CAER[AC] GRACIAS OTRA-VEZ", "GRACIAS OTRA-VEZ"),
        ("cl.m(5d>5):coger+guardar-fruta", ""),
    ],
)
def test_signs_that_are_words_are_told_from_pointing_depicting_and_gestures(
    annotation: str, signs: str
) -> None:
    assert " ".join(word_signs(annotation)) == signs


def test_the_narratives_are_read_whole_and_without_the_annotators_brackets() -> None:
    sentences = read_annotated(NARRATIVES)
    assert len(sentences) == 330
    assert sentences[0].spanish == '"Los tres cerdos y el lobo".'
    assert sentences[0].signs == ("TÍTULO", "TRES", "CERDO", "OTRO", "UNO", "LOBO")
    assert sentences[2].spanish == "Hay tres cerdos,"
    assert not [sentence for sentence in sentences if set("()") & set(sentence.spanish)]
