# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""No word of a sentence is lost in its translation."""

from __future__ import annotations

import pytest
from word_by_word_model import MORPHOLOGY

from teo_sign_translator.pipeline.hypothesis_repair import REPAIRED_CONFIDENCE, HypothesisRepair, Repaired
from teo_sign_translator.pointer import Hypothesis, OutputGloss
from teo_sign_translator.text.source_words import source_words

REPAIR = HypothesisRepair.load()
WORDS = source_words("La niña bebe leche fría.", MORPHOLOGY)


def _hypothesis(*glosses: tuple[str, int]) -> Hypothesis:
    return Hypothesis(tuple(OutputGloss(gloss, (place,), 0.9, True) for gloss, place in glosses), -1.0)


def _checked(*hypotheses: Hypothesis) -> Repaired:
    return REPAIR.repair(WORDS, hypotheses)


def _glosses(result: Repaired) -> str:
    return " ".join(gloss.gloss for gloss in result.glosses)


WHOLE = _hypothesis(("NIÑA", 1), ("LECHE", 3), ("FRÍO", 4), ("BEBER", 2))


def test_a_translation_without_loss_is_left_as_it_is() -> None:
    result = _checked(WHOLE)
    assert result.glosses == WHOLE.glosses
    assert not any(result.repaired)


def test_the_best_translation_that_loses_nothing_is_taken() -> None:
    assert _checked(_hypothesis(("NIÑA", 1)), _hypothesis(), WHOLE).glosses == WHOLE.glosses


@pytest.mark.parametrize(
    ("kept", "repaired"),
    [
        ([("NIÑA", 1), ("LECHE", 3), ("BEBER", 2)], "NIÑA LECHE FRÍO BEBER"),
        ([("LECHE", 3), ("FRÍO", 4), ("BEBER", 2)], "LECHE FRÍO NIÑA BEBER"),
        ([("NIÑA", 1), ("BEBER", 2)], "NIÑA BEBER LECHE FRÍO"),
        ([], "NIÑA BEBER LECHE FRÍO"),
    ],
)
def test_lost_words_are_put_back_beside_their_neighbours(kept: list[tuple[str, int]], repaired: str) -> None:
    result = _checked(_hypothesis(*kept))
    assert _glosses(result) == repaired
    back = [gloss for gloss, put in zip(result.glosses, result.repaired, strict=True) if put]
    assert len(back) == 4 - len(kept)
    assert all(gloss.probability == REPAIRED_CONFIDENCE for gloss in back)


def test_a_sentence_of_function_words_alone_has_them_all() -> None:
    words = source_words("de la", MORPHOLOGY)
    result = REPAIR.repair(words, [Hypothesis((), 0.0)])
    assert [gloss.sources for gloss in result.glosses] == [(0,), (1,)]


def test_a_verb_that_only_says_the_future_may_be_left_out() -> None:
    words = source_words("Mañana voy a comer", MORPHOLOGY)
    said = _hypothesis(("MAÑANA", 0), ("COMER", 3))
    assert REPAIR.repair(words, [said]).glosses == said.glosses
    words = source_words("Mañana voy a Roma", MORPHOLOGY)
    said = _hypothesis(("MAÑANA", 0), ("ROMA", 3))
    assert "IR" in _glosses(REPAIR.repair(words, [said]))


def test_a_gloss_that_is_one_words_lemma_says_that_word_alone() -> None:
    said = Hypothesis((OutputGloss("LECHE", (1, 3, 4), 0.9, True), OutputGloss("BEBER", (2,), 0.9, True)), -1)
    assert _glosses(_checked(said)) == "LECHE FRÍO NIÑA BEBER"


def test_a_gloss_says_nothing_but_its_own_words_and_those_that_are_listed() -> None:
    words = source_words("Ana come 3 peras", MORPHOLOGY)
    said = Hypothesis(
        (OutputGloss("ALGUIEN", (0, 2, 3), 0.9, False), OutputGloss("COMER", (1,), 0.9, True)), -1
    )
    assert _glosses(REPAIR.repair(words, [said])) == "ALGUIEN ANA COMER 3 PERA"


def test_a_question_word_is_put_back_at_the_end() -> None:
    words = source_words("¿Cuándo come Ana?", MORPHOLOGY)
    said = _hypothesis(("ANA", 2), ("COMER", 1))
    assert _glosses(REPAIR.repair(words, [said])) == "ANA COMER CUÁNDO"
