# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What every model of the zoo does, learned from a small language."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
import torch
from small_language import fit_small, glosses_of, read, sentence_pairs, small_config, small_model
from threadpoolctl import threadpool_info

from teo_sign_training.fitting.batches import WordNumbers, batches
from teo_sign_training.fitting.examples import ExampleReader
from teo_sign_training.fitting.fitting import ZOO, make_vocabulary
from teo_sign_training.fitting.network import Network, on_device
from teo_sign_translator.pointer import Hypothesis
from teo_sign_translator.pointer.array_model import ArrayModel
from teo_sign_translator.pointer.config import POINTER
from teo_sign_translator.pointer.decoding import SentenceModel, one_core


@pytest.fixture(scope="module")
def pointer() -> SentenceModel:
    """A pointer that has learned the small language."""
    return small_model(POINTER, fit_small(POINTER, sentence_pairs(600), epochs=6, rare_word=5.0))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rnn_equal", "gru", "lstm_stacked", "gru_attention", POINTER])
def test_each_mechanism_learns_a_few_sentences_by_heart(name: str) -> None:
    pairs = sentence_pairs(4)
    # Repeated, because rarer words would be unknown ones.
    # Stacked LSTMs are slow to begin; simple RNNs forget with steps as large as theirs and need more of them.
    rate, epochs = {"rnn": (0.005, 60), "gru": (0.01, 45), "lstm": (0.02, 45)}[ZOO[name].cell]
    trained = fit_small(name, pairs * 20, epochs=epochs, learning_rate=rate)
    got = small_model(name, trained).translate_all([read(pair.text) for pair in pairs])
    assert [glosses_of(best) for best, *_ in got] == [pair.glosses for pair in pairs]


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


def test_words_never_seen_are_carried_over(pointer: SentenceModel) -> None:
    (best, *_) = pointer.translate(read("Zoraida no lee los zuecos ."), beam=3)
    assert glosses_of(best)[0] == "ZORAIDA"
    assert set(glosses_of(best)) >= {"ZUECOS", "LEER", "NO"}
    copied = next(gloss for gloss in best.glosses if gloss.gloss == "ZUECOS")
    assert copied.copied
    assert copied.sources == (4,)
    assert 0 < copied.probability <= 1


def test_glosses_name_the_words_that_they_stand_for(pointer: SentenceModel) -> None:
    pairs = sentence_pairs(40, seed=2)
    right = 0
    for pair in pairs:
        (best,) = pointer.translate(read(pair.text))
        right += tuple(gloss.sources for gloss in best.glosses) == pair.alignment
    assert right >= 38


def test_a_generated_gloss_is_not_called_copied(pointer: SentenceModel) -> None:
    (best,) = pointer.translate(read("como el pan ."))
    assert [(gloss.gloss, gloss.copied) for gloss in best.glosses][:2] == [("YO", False), ("PAN", True)]


def test_a_beam_never_ends_below_the_likeliest_gloss_each_time(pointer: SentenceModel) -> None:
    sentences = [read(pair.text) for pair in sentence_pairs(60, seed=3)] + [
        read("zzz Qu el no no los xx ?? aa")
    ]
    for greedy, wide in zip(
        pointer.translate_all(sentences), pointer.translate_all(sentences, beam=4), strict=True
    ):
        assert wide[0].log_probability >= greedy[0].log_probability - 1e-4
        probabilities = [each.log_probability for each in wide]
        assert probabilities == sorted(probabilities, reverse=True)
        assert len({glosses_of(each) for each in wide}) == len(wide)


def test_the_probability_of_a_translation_is_that_of_its_glosses_and_its_end(pointer: SentenceModel) -> None:
    (best,) = pointer.translate(read("Ana come el pan ."))
    glosses = math.prod(gloss.probability for gloss in best.glosses)
    assert glosses >= math.exp(best.log_probability) * 0.999
    assert glosses * 0.5 < math.exp(best.log_probability)


@pytest.mark.parametrize("beam", [1, 3])
def test_many_sentences_together_are_translated_as_one_by_one(pointer: SentenceModel, beam: int) -> None:
    sentences = [read(pair.text) for pair in sentence_pairs(30, seed=4)] + [()]
    together = pointer.translate_all(sentences, beam=beam)
    for words, hypotheses in zip(sentences, together, strict=True):
        alone = pointer.translate(words, beam=beam)
        assert glosses_of(alone[0]) == glosses_of(hypotheses[0])
        assert alone[0].log_probability == pytest.approx(hypotheses[0].log_probability, abs=1e-3)


def test_a_sentence_keeps_to_one_core_and_gives_the_others_back(pointer: SentenceModel) -> None:
    def threads() -> list[int]:
        return [pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"]

    before = threads()
    with one_core():
        assert threads() == [1] * len(before)
    pointer.translate(read("Ana come el pan ."))
    assert threads() == before


@pytest.mark.parametrize("name", ["rnn_equal", "gru", POINTER])
@pytest.mark.parametrize("sentence", ["", ".", "@ # ñandú 漢字", "el " * 500, "Zzz " * 30, "no " * 7 + "."])
def test_odd_sentences_give_a_translation(name: str, sentence: str, pointer: SentenceModel) -> None:
    model = pointer if name == POINTER else small_model(name, fit_small(name, sentence_pairs(20), epochs=1))
    for beam in (1, 3):
        hypotheses = model.translate(read(sentence), beam=beam)
        assert 1 <= len(hypotheses) <= beam
        for hypothesis in hypotheses:
            assert math.isfinite(hypothesis.log_probability)
            for gloss in hypothesis.glosses:
                assert gloss.gloss
                assert all(0 <= place < len(read(sentence)) for place in gloss.sources)
    assert model.translate(read(""))[0] == Hypothesis((), 0.0)
