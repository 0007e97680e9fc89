# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What every model of the zoo does, with any weights."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
import torch
from loaded import read as read_spanish
from made_models import VOCABULARY, made_weights
from made_models import small_config as made_config
from small_language import fit_small, glosses_of, read, sentence_pairs, small_config, small_model
from threadpoolctl import threadpool_info

from teo_sign_training.fitting.batches import WordNumbers, batches
from teo_sign_training.fitting.examples import ExampleReader
from teo_sign_training.fitting.fitting import ZOO, make_vocabulary
from teo_sign_training.fitting.network import Network, on_device
from teo_sign_translator.pointer import Hypothesis, load_sentence_model
from teo_sign_translator.pointer.array_model import ArrayModel
from teo_sign_translator.pointer.config import POINTER
from teo_sign_translator.pointer.decoding import SentenceModel, one_core


@pytest.fixture(scope="module")
def pointer() -> SentenceModel:
    return load_sentence_model(POINTER)


SENTENCES = [
    read_spanish(text)
    for text in (
        "Ana come el pan.", "No tengo dinero.", "¿Dónde vives?", "Zoraida no lee los zuecos.", "Hola.", "",
        "zzz Qu el no no los xx ?? aa", "Mañana por la tarde voy a casa de mi madre.", "¿Cuánto cuesta?",
    )
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rnn_equal", "gru", "lstm_stacked", "gru_attention", POINTER])
def test_each_mechanism_learns_a_few_sentences_by_heart_and_the_pointer_their_alignment(name: str) -> None:
    pairs = sentence_pairs(4)
    # Repeated, because rarer words would be unknown ones.
    # Stacked LSTMs are slow to begin; simple RNNs forget with steps as large as theirs and need more of them.
    rate, epochs = {"rnn": (0.005, 60), "gru": (0.01, 45), "lstm": (0.02, 45)}[ZOO[name].cell]
    trained = fit_small(name, pairs * 20, epochs=epochs, learning_rate=rate)
    got = small_model(name, trained).translate_all([read(pair.text) for pair in pairs])
    assert [glosses_of(best) for best, *_ in got] == [pair.glosses for pair in pairs]
    if name == POINTER:
        sources = [tuple(gloss.sources for gloss in best.glosses) for best, *_ in got]
        assert sources == [pair.alignment for pair in pairs]


@pytest.mark.parametrize("name", ZOO)
def test_plain_arrays_say_what_pytorch_says(name: str) -> None:
    pairs = sentence_pairs(12)
    reader = ExampleReader(read)
    examples = reader.examples(pairs)
    table = reader.table()
    config = dataclasses.replace(small_config(name), layers=2) if name == POINTER else small_config(name)
    vocabulary = make_vocabulary(examples, table, 0, copy=config.copy)
    torch.manual_seed(3)
    network = Network(config, vocabulary).eval()
    with torch.no_grad():
        for parameter in network.parameters():
            parameter += 0.3 * torch.randn_like(parameter)
        network.tag.weight[0] = 0
        network.lemma.weight[0] = 0
    arrays = ArrayModel(config, vocabulary, network.weights())
    numbers = WordNumbers.of(table, vocabulary, examples)
    size = len(vocabulary.glosses)
    for place in range(len(pairs)):
        one = examples.take(np.array([place]))
        (batch,) = batches(one, table, numbers, 1, spare=4 if config.layout == "equal_length" else 0)
        with torch.no_grad():
            said = network(on_device(batch, torch.device("cpu")))
        expected = np.exp(said.log_probability[0].numpy())
        words = read(pairs[place].text)
        if config.layout == "equal_length":
            np.testing.assert_allclose(arrays.positions(arrays.encode([words], 4))[0], expected, atol=1e-4)
            continue
        memory = arrays.encode([words])
        states = memory.first
        for time in range(batch.said.shape[1]):
            before = np.where(batch.said[:, time] < 0, size + batch.said_copy[:, time], batch.said[:, time])
            step = arrays.step(memory, before, states)
            states = step.states
            if config.copy:
                np.testing.assert_allclose(step.candidates[0], expected[time, size:], atol=1e-4)
                merged = expected[time].copy()
                merged[size:] = 0
                np.add.at(merged, memory.slots[0], expected[time, size:])
                np.testing.assert_allclose(step.probability[0], merged, atol=1e-4)
            else:
                np.testing.assert_allclose(step.probability[0], expected[time], atol=1e-4)
            if config.attention:
                np.testing.assert_allclose(step.attention[0], said.attention[0, time].numpy(), atol=1e-4)


def test_a_word_never_seen_is_carried_over_and_a_gloss_names_its_words(pointer: SentenceModel) -> None:
    (best, *_) = pointer.translate(read_spanish("Zoraida no lee los zuecos."), beam=3)
    said = {gloss.gloss: gloss for gloss in best.glosses}
    assert {"ZORAIDA", "ZUECO", "LEER", "NO"} <= said.keys()
    assert [said[gloss].sources for gloss in ("ZORAIDA", "NO", "LEER", "ZUECO")] == [(0,), (1,), (2,), (4,)]
    assert (said["ZUECO"].copied, said["NO"].copied) == (True, False)
    assert all(0 < gloss.probability <= 1 for gloss in best.glosses)


def test_a_beam_never_ends_below_the_likeliest_gloss_each_time(pointer: SentenceModel) -> None:
    greedy, wide = (pointer.translate_all(SENTENCES, beam=beam) for beam in (1, 4))
    for (only,), several in zip(greedy, wide, strict=True):
        assert several[0].log_probability >= only.log_probability - 1e-4
        probabilities = [each.log_probability for each in several]
        assert probabilities == sorted(probabilities, reverse=True)
        assert len({glosses_of(each) for each in several}) == len(several)


def test_the_probability_of_a_translation_is_that_of_its_glosses_and_its_end(pointer: SentenceModel) -> None:
    (best,) = pointer.translate(SENTENCES[0])
    glosses = math.prod(gloss.probability for gloss in best.glosses)
    assert glosses >= math.exp(best.log_probability) * 0.999
    assert glosses * 0.5 < math.exp(best.log_probability)


@pytest.mark.parametrize("beam", [1, 3])
def test_many_sentences_together_are_translated_as_one_by_one(pointer: SentenceModel, beam: int) -> None:
    together = pointer.translate_all(SENTENCES[:1] * 70 + SENTENCES, beam=beam)  # more than are read at once
    alone = [pointer.translate(words, beam=beam) for words in SENTENCES]
    alone = alone[:1] * 70 + alone
    for one, other in zip(alone, together, strict=True):
        assert glosses_of(one[0]) == glosses_of(other[0])
        assert one[0].log_probability == pytest.approx(other[0].log_probability, abs=1e-3)


def test_a_sentence_keeps_to_one_core_and_gives_the_others_back(pointer: SentenceModel) -> None:
    def threads() -> list[int]:
        return [pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"]

    before = threads()
    with one_core():
        assert threads() == [1] * len(before)
    pointer.translate(SENTENCES[0])
    assert threads() == before


@pytest.mark.parametrize("name", ["rnn_equal", "gru", POINTER])
@pytest.mark.parametrize("sentence", ["", ".", "@ # ñandú 漢字", "el " * 500, "Zzz " * 30, "no " * 7 + "."])
def test_odd_sentences_give_a_translation(name: str, sentence: str, pointer: SentenceModel) -> None:
    config = made_config(name)
    made = SentenceModel(name, ArrayModel(config, VOCABULARY, made_weights(config)))
    model = pointer if name == POINTER else made
    for beam in (1, 3):
        hypotheses = model.translate(read(sentence), beam=beam)
        assert 1 <= len(hypotheses) <= beam
        for hypothesis in hypotheses:
            assert math.isfinite(hypothesis.log_probability)
            for gloss in hypothesis.glosses:
                assert gloss.gloss
                assert all(0 <= place < len(read(sentence)) for place in gloss.sources)
    assert model.translate(read(""))[0] == Hypothesis((), 0.0)
