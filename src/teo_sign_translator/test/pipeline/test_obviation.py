# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who does what is wished, as a speaker of Spanish reads the sentence."""

from __future__ import annotations

import pytest
from loaded import TEXT, read, translator

from teo_sign_translator.pipeline.completeness import PipelineWords
from teo_sign_translator.pipeline.obviation import with_other_subjects
from teo_sign_translator.pointer import OutputGloss

WORDS = PipelineWords.load(TEXT)


@pytest.mark.parametrize(
    ("clause", "verb", "subject"),
    [
        ("Quiero que", "sea feliz", "ÉL"),
        ("No quiero que", "fume aquí", "ÉL"),
        ("Espero que no", "tenga fiebre", "ÉL"),
        ("Me alegro de que", "esté mejor", "ÉL"),
        ("Me gustaría que", "viniera mañana", "ÉL"),
        ("Hoy prefiero que ya no", "salga tarde", "ÉL"),
        ("Mi padre quiere que", "sea médico", "YO"),
        ("Me pidió que", "viniera mañana", "YO"),
        ("Espero que me", "llame mañana", "YO"),  # whom it happens to is the signer
        ("Ojalá", "sea feliz", "YO"),
        ("Cuando", "sea mayor", "YO"),
        ("Que", "sea feliz", "YO"),
        ("Quiero dormir antes de que", "salga tarde", "YO"),
        ("Quiero un trabajo que", "tenga cerca", "YO"),
        ("Quiero, que", "sea feliz", "YO"),
        ("Creo que", "estoy mejor", "YO"),
    ],
)
def test_what_the_signer_wishes_somebody_else_does(clause: str, verb: str, subject: str) -> None:
    words = read(f"{clause} {verb}.")
    place = next(place for place, word in enumerate(words) if word.form == verb.split()[0])
    (gloss,) = with_other_subjects(words, [OutputGloss("YO", (place,), 0.6, copied=False)], WORDS)
    assert gloss.gloss == subject


@pytest.mark.parametrize("sentence", ["Quiero que sea feliz.", "Espero que apruebe el examen."])
def test_a_wish_for_somebody_else_points_at_the_signer_once(sentence: str) -> None:
    glosses = str(translator().translate(sentence)).split()
    assert glosses.count("YO") == 1 and "ÉL" in glosses
