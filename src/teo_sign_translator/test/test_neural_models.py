from __future__ import annotations

import dataclasses
import json
import math
import random
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from threadpoolctl import threadpool_info

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Reading
from teo_sign_translator.neural import Hypothesis, load_sentence_model
from teo_sign_translator.neural.array_model import ArrayModel
from teo_sign_translator.neural.batches import WordNumbers, batches
from teo_sign_translator.neural.by_heart import ByHeart
from teo_sign_translator.neural.config import NetworkConfig, TrainingConfig
from teo_sign_translator.neural.decoding import ZooModel
from teo_sign_translator.neural.examples import ExampleReader
from teo_sign_translator.neural.fit import Fit, fit, make_lexis
from teo_sign_translator.neural.network import Network, TensorBatch
from teo_sign_translator.neural.one_core import one_core
from teo_sign_translator.neural.store import save_sentence_model, sentence_models
from teo_sign_translator.neural.zoo import POINTER, ZOO
from teo_sign_translator.spanish_words import SourceWord

NOUNS = ("pan", "vaso", "libro", "coche", "gato", "perro")
VERBS = ("com", "beb", "le", "vend")
ENDINGS = {"o": ("1s", "YO"), "es": ("2s", "TÚ")}


def read(sentence: str) -> tuple[SourceWord, ...]:
    """A language small enough to be learned in a second: name or ending, article, noun, verb."""
    return tuple(_word(word, bool(place)) for place, word in enumerate(sentence.split()))


def _word(word: str, inside: bool) -> SourceWord:
    return SourceWord(word, word.lower(), inside and word[0].isupper(), _readings(word))


def _readings(word: str) -> tuple[Reading, ...]:
    if word in NOUNS:
        return (Reading(word, "N:ms"),)
    if word[:-1] in NOUNS and word.endswith("s"):
        return (Reading(word[:-1], "N:mp"),)
    for stem in VERBS:
        for ending, (person, _) in ENDINGS.items():
            if word == stem + ending:
                return (Reading(f"{stem}er", f"V:ind:pres:{person}"), Reading(word, "N:ms", (), False))
        if word == f"{stem}e":
            return (Reading(f"{stem}er", "V:ind:pres:3s"),)
    if word in ("el", "los", "no"):
        return (Reading(word, {"no": "ADV:neg"}.get(word, "DET:def")),)
    if word == ".":
        return (Reading(word, "MARK"),)
    return (Reading(word, "NAME" if word[0].isupper() else "X", (), False),)


def _pair(rng: random.Random) -> ByHeart:
    """Subject, object (repeated in the plural), verb, negation last."""
    words: list[str] = []
    verb, noun = rng.choice(VERBS), rng.choice(NOUNS)
    named, negated, plural = rng.random() < 0.5, rng.random() < 0.3, rng.random() < 0.3
    if named:
        words.append(rng.choice(("Ana", "Eva", "Leo", "Sol", "Gil")))
    words += ["no"] * negated
    ending = "e" if named else rng.choice(tuple(ENDINGS))
    words.append(verb + ending)
    at = len(words) - 1
    words += ["los" if plural else "el", noun + "s" * plural, "."]
    glosses = [(words[0].upper(), (0,))] if named else [(ENDINGS[ending][1], (at,))]
    glosses += [(noun.upper(), (at + 2,))] * (1 + plural)
    glosses += [(f"{verb}er".upper(), (at,)), *[("NO", (at - 1,))] * negated]
    return ByHeart(" ".join(words), tuple(g for g, _ in glosses), tuple(s for _, s in glosses))


def _pairs(count: int, seed: int = 1) -> list[ByHeart]:
    rng = random.Random(seed)
    return [_pair(rng) for _ in range(count)]


def _small(name: str) -> NetworkConfig:
    return dataclasses.replace(ZOO[name], hidden=32, embedding=24)


def _fit(name: str, pairs: Sequence[ByHeart], **training: Any) -> Fit:
    chosen = {
        "batch_size": 16,
        "learning_rate": 0.01,
        "dropout": 0.0,
        "rare_word": 0.0,
        "clean": 1.0,
    } | training
    device = torch.device("cpu")  # the same on every machine
    return fit(pairs, [], [], read, _small(name), TrainingConfig(**chosen), device=device)


def _model(name: str, trained: Fit) -> ZooModel:
    return ZooModel(name, ArrayModel(_small(name), trained.lexis, trained.weights))


def _glosses(hypothesis: Hypothesis) -> tuple[str, ...]:
    return tuple(each.gloss for each in hypothesis.glosses)


@pytest.fixture(scope="module")
def pointer() -> ZooModel:
    """A pointer that has learned the small language."""
    return _model(POINTER, _fit(POINTER, _pairs(600), epochs=6, rare_word=5.0))


@pytest.mark.parametrize("name", ZOO)
def test_each_model_learns_a_few_sentences_by_heart(name: str) -> None:
    pairs = _pairs(4)
    # Repeated, because rarer words would be unknown ones.
    # Stacked LSTMs are slow to begin; simple RNNs forget with steps as large as theirs.
    rate = {"rnn": 0.005, "gru": 0.01, "lstm": 0.02}[ZOO[name].cell]
    trained = _fit(name, pairs * 20, epochs=45, learning_rate=rate)
    got = _model(name, trained).translate_all([read(pair.spanish) for pair in pairs])
    assert [_glosses(best) for best, *_ in got] == [pair.glosses for pair in pairs]


@pytest.mark.parametrize("name", ZOO)
def test_plain_arrays_say_what_pytorch_says(name: str) -> None:
    pairs = _pairs(12)
    reader = ExampleReader(read)
    examples = reader.examples(pairs)
    table = reader.table()
    config = dataclasses.replace(_small(name), layers=2) if name == POINTER else _small(name)
    lexis = make_lexis(examples, table, 0, copy=config.copy)
    torch.manual_seed(3)
    network = Network(config, lexis).eval()
    with torch.no_grad():
        for parameter in network.parameters():
            parameter += 0.3 * torch.randn_like(parameter)
        network.tag.weight[0] = 0
        network.lemma.weight[0] = 0
    arrays = ArrayModel(config, lexis, network.weights())
    numbers = WordNumbers.of(table, lexis, examples)
    size = len(lexis.glosses)
    for place in range(len(pairs)):
        one = examples.take(np.array([place]))
        (batch,) = batches(one, table, numbers, 1, spare=4 if config.layout == "equal_length" else 0)
        with torch.no_grad():
            said = network(TensorBatch.of(batch, torch.device("cpu")))
        expected = np.exp(said.log_probability[0].numpy())
        words = read(pairs[place].spanish)
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


def test_words_never_seen_are_carried_over(pointer: ZooModel) -> None:
    (best, *_) = pointer.translate(read("Zoraida no lee los zuecos ."), beam=3)
    assert _glosses(best)[0] == "ZORAIDA"
    assert set(_glosses(best)) >= {"ZUECOS", "LEER", "NO"}
    copied = next(gloss for gloss in best.glosses if gloss.gloss == "ZUECOS")
    assert copied.copied
    assert copied.sources == (4,)
    assert 0 < copied.probability <= 1


def test_glosses_name_the_words_that_they_stand_for(pointer: ZooModel) -> None:
    pairs = _pairs(40, seed=2)
    right = 0
    for pair in pairs:
        (best,) = pointer.translate(read(pair.spanish))
        right += tuple(gloss.sources for gloss in best.glosses) == pair.alignment
    assert right >= 38


def test_a_generated_gloss_is_not_called_copied(pointer: ZooModel) -> None:
    (best,) = pointer.translate(read("como el pan ."))
    assert [(gloss.gloss, gloss.copied) for gloss in best.glosses][:2] == [("YO", False), ("PAN", True)]


def test_a_beam_never_ends_below_the_likeliest_gloss_each_time(pointer: ZooModel) -> None:
    sentences = [read(pair.spanish) for pair in _pairs(60, seed=3)] + [read("zzz Qu el no no los xx ?? aa")]
    for greedy, wide in zip(
        pointer.translate_all(sentences), pointer.translate_all(sentences, beam=4), strict=True
    ):
        assert wide[0].log_probability >= greedy[0].log_probability - 1e-4
        probabilities = [each.log_probability for each in wide]
        assert probabilities == sorted(probabilities, reverse=True)
        assert len({_glosses(each) for each in wide}) == len(wide)


def test_the_probability_of_a_translation_is_that_of_its_glosses_and_its_end(pointer: ZooModel) -> None:
    (best,) = pointer.translate(read("Ana come el pan ."))
    glosses = math.prod(gloss.probability for gloss in best.glosses)
    assert glosses >= math.exp(best.log_probability) * 0.999
    assert glosses * 0.5 < math.exp(best.log_probability)


@pytest.mark.parametrize("beam", [1, 3])
def test_many_sentences_together_are_translated_as_one_by_one(pointer: ZooModel, beam: int) -> None:
    sentences = [read(pair.spanish) for pair in _pairs(30, seed=4)] + [()]
    together = pointer.translate_all(sentences, beam=beam)
    for words, hypotheses in zip(sentences, together, strict=True):
        alone = pointer.translate(words, beam=beam)
        assert _glosses(alone[0]) == _glosses(hypotheses[0])
        assert alone[0].log_probability == pytest.approx(hypotheses[0].log_probability, abs=1e-3)


def test_a_sentence_keeps_to_one_core_and_gives_the_others_back(pointer: ZooModel) -> None:
    def threads() -> list[int]:
        return [pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"]

    before = threads()
    with one_core():
        assert threads() == [1] * len(before)
    pointer.translate(read("Ana come el pan ."))
    assert threads() == before


@pytest.mark.parametrize("name", ["rnn_equal", "gru", POINTER])
@pytest.mark.parametrize("sentence", ["", ".", "@ # ñandú 漢字", "el " * 500, "Zzz " * 30, "no " * 7 + "."])
def test_odd_sentences_give_a_translation(name: str, sentence: str, pointer: ZooModel) -> None:
    model = pointer if name == POINTER else _model(name, _fit(name, _pairs(20), epochs=1))
    for beam in (1, 3):
        hypotheses = model.translate(read(sentence), beam=beam)
        assert 1 <= len(hypotheses) <= beam
        for hypothesis in hypotheses:
            assert math.isfinite(hypothesis.log_probability)
            for gloss in hypothesis.glosses:
                assert gloss.gloss
                assert all(0 <= place < len(read(sentence)) for place in gloss.sources)
    assert model.translate(read(""))[0] == Hypothesis((), 0.0)


def test_the_same_seed_gives_the_same_weights_and_another_seed_others() -> None:
    pairs = _pairs(60)
    noisy = {"epochs": 2, "dropout": 0.2, "rare_word": 5.0, "clean": 0.3}
    first, second = _fit(POINTER, pairs, **noisy), _fit(POINTER, pairs, **noisy)
    other = _fit(POINTER, pairs, **noisy, seed=7)
    assert first.losses == second.losses != other.losses
    for name, weights in first.weights.items():
        np.testing.assert_array_equal(weights, second.weights[name])


def test_training_stops_when_the_development_pairs_get_no_better() -> None:
    pairs = _pairs(20)
    unlike = [
        dataclasses.replace(pair, glosses=pair.glosses[::-1], alignment=pair.alignment[::-1])
        for pair in pairs
    ]
    config = TrainingConfig(epochs=60, patience=2, batch_size=8, learning_rate=0.01, clean=1.0, rare_word=0.0)
    trained = fit(pairs, unlike, [], read, _small(POINTER), config)
    assert len(trained.dev_losses) == trained.best_epoch + 2 < 60
    assert trained.dev_losses[trained.best_epoch - 1] == min(trained.dev_losses)


def test_a_gloss_that_is_always_a_copy_has_no_place_in_the_closed_list() -> None:
    trained = _fit(POINTER, _pairs(50), epochs=1)
    assert set(trained.lexis.glosses) == {"<end>", "<start>", "YO", "TÚ"}
    assert set(NOUNS) <= {gloss.lower() for gloss in _fit("lstm", _pairs(80), epochs=1).lexis.glosses}


def test_pairs_that_cannot_be_said_are_counted_and_left_out() -> None:
    strange = ByHeart("como el pan .", ("YO", "BOCADILLO", "COMER"), ((0,), (2,), (0,)))
    trained = _fit(POINTER, [*_pairs(50), strange], epochs=1)
    assert (trained.pairs, trained.left_out) == (50, 1)


def test_an_alignment_outside_the_sentence_is_refused() -> None:
    with pytest.raises(TranslationError) as error:
        _fit(POINTER, [ByHeart("como .", ("YO",), ((5,),))], epochs=1)
    assert error.value.code == "invalid_data"


def test_training_without_pairs_is_refused() -> None:
    with pytest.raises(TranslationError) as error:
        _fit(POINTER, [], epochs=1)
    assert error.value.code == "invalid_config"


@pytest.mark.parametrize(
    "change",
    [
        {"cell": "transformer"},
        {"layout": "one_to_many"},
        {"hidden": 0},
        {"layout": "equal_length", "attention": True},
        {"copy": True},
    ],
)
def test_a_network_that_cannot_be_built_is_refused(change: dict[str, Any]) -> None:
    with pytest.raises(TranslationError) as error:
        NetworkConfig(**change)
    assert error.value.code == "invalid_config"


@pytest.mark.parametrize(
    "change", [{"epochs": 0}, {"learning_rate": float("nan")}, {"dropout": 1.0}, {"clean": -0.1}]
)
def test_a_training_that_cannot_be_done_is_refused(change: dict[str, Any]) -> None:
    with pytest.raises(TranslationError) as error:
        TrainingConfig(**change)
    assert error.value.code == "invalid_config"


def _save(directory: Path, **weights: np.ndarray[Any, np.dtype[np.float32]]) -> Fit:
    trained = _fit(POINTER, _pairs(50), epochs=2)
    save_sentence_model(
        "small",
        directory,
        config=_small(POINTER),
        lexis=trained.lexis,
        weights=trained.weights | weights,
        card={},
    )
    return trained


def test_a_saved_model_says_the_same_after_loading(tmp_path: Path) -> None:
    model = _model(POINTER, _save(tmp_path))
    assert sentence_models(tmp_path) == ("small",)
    loaded = load_sentence_model("small", tmp_path)
    for pair in _pairs(10):
        (expected,), (got,) = model.translate(read(pair.spanish)), loaded.translate(read(pair.spanish))
        assert _glosses(expected) == _glosses(got)
        assert expected.log_probability == pytest.approx(got.log_probability, abs=0.02)  # half precision
    assert sorted(path.name for path in tmp_path.iterdir()) == ["small.json", "small.safetensors"]


@pytest.mark.parametrize("name", ["large", "../small", ""])
def test_an_unknown_model_is_refused_with_those_available(tmp_path: Path, name: str) -> None:
    _save(tmp_path)
    with pytest.raises(TranslationError, match="small") as error:
        load_sentence_model(name, tmp_path)
    assert error.value.code == "unknown_model"


def _cut(directory: Path) -> None:
    path = directory / "small.safetensors"
    path.write_bytes(path.read_bytes()[:-100])


def _no_weights(directory: Path) -> None:
    (directory / "small.safetensors").write_bytes(b"")


def _no_card(directory: Path) -> None:
    (directory / "small.json").unlink()


def _spoil(text: str) -> Callable[[Path], None]:
    return lambda directory: (directory / "small.json").write_text(text, encoding="utf-8") and None


def _card(**values: object) -> Callable[[Path], None]:
    def change(directory: Path) -> None:
        path = directory / "small.json"
        path.write_text(json.dumps(json.loads(path.read_text("utf-8")) | values), encoding="utf-8")

    return change


def _not_a_number(directory: Path) -> None:
    _save(directory, **{"output.bias": np.full(4, np.nan, np.float32)})


@pytest.mark.parametrize(
    "damage",
    [
        _cut,
        _no_weights,
        _no_card,
        _not_a_number,
        _spoil("{"),
        _spoil("[]"),
        _card(schema=99),
        _card(network={"hidden": 16}),
        _card(network={"width": 16}),
        _card(network=None),
        _card(lexis={}),
        _card(lexis=[]),
    ],
)
def test_a_damaged_model_is_refused(tmp_path: Path, damage: Callable[[Path], None]) -> None:
    _save(tmp_path)
    damage(tmp_path)
    with pytest.raises(TranslationError) as error:
        load_sentence_model("small", tmp_path)
    assert error.value.code == "invalid_model"
