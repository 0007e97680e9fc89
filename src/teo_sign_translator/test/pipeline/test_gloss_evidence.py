# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a sentence does not say is not signed."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from word_by_word_model import MORPHOLOGY

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pipeline.gloss_evidence import GlossEvidence
from teo_sign_translator.pipeline.hypothesis_repair import HypothesisRepair
from teo_sign_translator.pointer import Hypothesis, OutputGloss
from teo_sign_translator.text.source_words import source_words

EVIDENCE = GlossEvidence.load()
REPAIR = HypothesisRepair.load()


def _glosses(*glosses: tuple[str, int]) -> tuple[OutputGloss, ...]:
    return tuple(OutputGloss(gloss, (place,), 0.9, True) for gloss, place in glosses)


@pytest.mark.parametrize(
    ("sentence", "glosses", "invented"),
    [
        ("Ayer comí pan.", [("AYER", 0), ("YO", 1), ("PAN", 2), ("COMER", 1)], []),
        ("Como pan.", [("PASADO", 0), ("YO", 0), ("PAN", 1), ("COMER", 0)], ["PASADO"]),
        ("Llego tarde.", [("PASADO", 0), ("YO", 0), ("LLEGAR", 0), ("TARDE", 1)], ["PASADO"]),
        ("mi madre llego tarde", [("PASADO", 2), ("MADRE", 1), ("MI", 0), ("LLEGAR", 2), ("TARDE", 3)], []),
        # Who types the accent of "café" types that of "llegó".
        ("Llego al café.", [("PASADO", 0), ("ÉL", 0), ("CAFÉ", 2), ("LLEGAR", 0)], ["PASADO", "ÉL"]),
        # "quedamos" is now unless a word of time says otherwise.
        ("He comido pan.", [("PASADO", 0), ("YO", 0), ("PAN", 2), ("COMER", 1)], []),
        ("Quedamos.", [("PASADO", 0), ("NOSOTROS", 0), ("QUEDAR", 0)], ["PASADO"]),
        ("Ahora bajo.", [("AHORA", 0), ("YO", 1), ("BAJAR", 1)], []),
        ("Busco compañía.", [("YO", 0), ("COMPAÑÍA", 1), ("COMPAÑÍA", 1), ("BUSCAR", 0)], ["COMPAÑÍA"]),
        ("Busco libros.", [("YO", 0), ("LIBRO", 1), ("LIBRO", 1), ("BUSCAR", 0)], ["LIBRO"]),
        (
            "La farmacia cierra los domingos.",
            [("DOMINGO", 4), ("DOMINGO", 4), ("FARMACIA", 1), ("DOMINGO", 4), ("CERRAR", 2)],
            ["DOMINGO", "DOMINGO"],
        ),
        ("¿Dónde para el 27?", [("HORA", 3), ("27", 3), ("PARAR", 1), ("DÓNDE", 0)], ["HORA"]),
        ("Quedamos a las 7.", [("HORA", 2), ("7", 3), ("NOSOTROS", 0), ("QUEDAR", 0)], []),
        ("¿Cuándo llegas?", [("USTEDES", 1), ("LLEGAR", 1), ("CUÁNDO", 0)], ["USTEDES"]),
        ("Dímelo.", [("TÚ", 0), ("ESO", 0), ("YO", 0), ("DECIR", 0)], []),
        ("Deja de llamarla.", [("ELLA", 2), ("LLAMAR", 2), ("DEJAR", 0)], ["ELLA"]),
        ("Bebe agua.", [("AGUA", 1), ("BEBER", 0), ("NO", 0)], ["NO"]),
    ],
)
def test_glosses_without_evidence_are_found(
    sentence: str, glosses: list[tuple[str, int]], invented: list[str]
) -> None:
    said = _glosses(*glosses)
    found = EVIDENCE.invented(source_words(sentence, MORPHOLOGY), said)
    assert [said[place].gloss for place in found] == invented


@pytest.mark.parametrize(
    ("sentence", "verb", "probability", "named"),
    [
        ("Vivía en Cádiz.", 0, 0.95, True),
        ("Vivía en Cádiz.", 0, 0.6, False),
        ("La abuela vivía en Cádiz.", 2, 0.95, False),
        ("Para que tu hijo estudie.", 4, 0.95, False),
        ("En la casa vivía solo.", 3, 0.95, True),
        ("Yo vivía en Cádiz.", 1, 0.95, True),
        ("Vivo en Cádiz.", 0, 0.4, True),
    ],
)
def test_a_form_of_two_persons_names_the_signer_only_where_nobody_else_is_named(
    sentence: str, verb: int, probability: float, named: bool
) -> None:
    subject = OutputGloss("YO", (verb,), probability, copied=False)
    assert (not EVIDENCE.invented(source_words(sentence, MORPHOLOGY), [subject])) is named


@pytest.mark.parametrize(
    ("sentence", "invented"), [("Voy cada dos días.", []), ("Voy los dos días.", ["DÍA"])]
)
def test_what_repeats_is_said_twice(sentence: str, invented: list[str]) -> None:
    words = source_words(sentence, MORPHOLOGY)
    said = [OutputGloss("DÍA", (3,), 1.0, copied=True), OutputGloss("DÍA", (1, 2), 1.0, copied=False)]
    assert [said[place].gloss for place in EVIDENCE.invented(words, said)] == invented


def test_the_best_translation_that_invents_nothing_is_taken() -> None:
    words = source_words("Llego tarde.", MORPHOLOGY)
    past = Hypothesis(_glosses(("PASADO", 0), ("YO", 0), ("LLEGAR", 0), ("TARDE", 1)), -1.0)
    now = Hypothesis(_glosses(("YO", 0), ("TARDE", 1), ("LLEGAR", 0)), -2.0)
    assert REPAIR.repair(words, [past, now]).glosses == now.glosses


def test_what_every_translation_invents_is_left_out() -> None:
    words = source_words("Llego tarde.", MORPHOLOGY)
    past = Hypothesis(_glosses(("PASADO", 0), ("YO", 0), ("LLEGAR", 0), ("TARDE", 1)), -1.0)
    result = REPAIR.repair(words, [past])
    assert [gloss.gloss for gloss in result.glosses] == ["YO", "LLEGAR", "TARDE"]


@given(st.text(max_size=40))
def test_a_gloss_that_needs_no_evidence_is_never_refused(text: str) -> None:
    words = source_words(text, MORPHOLOGY)
    assert EVIDENCE.invented(words, (OutputGloss("MOTIVO", (), 0.5, False),)) == []


@pytest.mark.parametrize("line", ["PASADO\tV:*", "pasado\tV:*\t-", "YO\t*:1s\t-\nYO\t*:1s\t-"])
def test_a_broken_list_is_named(tmp_path: Path, line: str) -> None:
    path = tmp_path / "gloss_evidence.tsv"
    path.write_text(f"{line}\n", encoding="utf-8")
    with pytest.raises(TranslationError, match=r"gloss_evidence\.tsv"):
        GlossEvidence.load(path)
