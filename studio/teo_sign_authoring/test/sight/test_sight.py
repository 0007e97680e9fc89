# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Networks for lifting, fitted to people of whom everything is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import safetensors.numpy

from teo_common.arrays import Array
from teo_sign_authoring.notation.score_file import default_scores_directory, read_score
from teo_sign_authoring.sight.fitting import Examples, arm_examples, fit, hand_examples
from teo_sign_authoring.sight.rendered_people import RenderedPerson, rendered_person
from teo_skeleton_retriever.lifting.clip import SHOULDER, WRIST
from teo_skeleton_retriever.lifting.network import load_network

pytestmark = pytest.mark.slow

SCORES = ("BIEN", "CASA")


@pytest.fixture(scope="module")
def people(tmp_path_factory: pytest.TempPathFactory) -> list[RenderedPerson]:
    scores = [read_score(default_scores_directory() / f"{gloss}.yaml") for gloss in SCORES]
    folder = tmp_path_factory.mktemp("people")
    return [rendered_person(number, scores, folder) for number in (1_000_001, 1_000_002)]


def test_what_is_seen_lies_over_what_is_there(people: list[RenderedPerson]) -> None:
    """A pinhole camera shows what is to the left and up at its share of the distance."""
    for person in people:
        seen, true = person.clip.body.places[..., 1:], person.truth[:, : person.clip.body.places.shape[1]]
        rows = [*SHOULDER.values(), *WRIST.values()]
        shown = true[:, rows, 1:] / -true[:, rows, :1]
        known = np.isfinite(seen[:, rows]).all(axis=2)
        for axis in (0, 1):
            slope, start = np.polyfit(shown[known, axis], seen[:, rows][known, axis], 1)
            assert slope > 0.0
            off = seen[:, rows][known, axis] - (slope * shown[known, axis] + start)
            assert np.median(np.abs(off)) < 0.05 * slope  # 5 cm at a metre


def test_a_person_is_kept_and_another_number_is_another(people: list[RenderedPerson], tmp_path: Path) -> None:
    first, second = (person.truth for person in people)
    assert first.shape != second.shape or not np.allclose(first, second)
    (tmp_path / "7.npy").write_bytes(b"")
    with pytest.raises(Exception):  # noqa: B017  # what is kept is read, not rendered again
        rendered_person(7, [], tmp_path)


def test_examples_are_what_networks_see(people: list[RenderedPerson]) -> None:
    for name, found in (
        ("arms", arm_examples(people, np.random.default_rng(0))),
        ("hands", hand_examples(people)),
    ):
        network = load_network(name)
        assert found.inputs.shape[1] == network.weights[0].shape[1]
        assert np.isfinite(found.inputs).all()
        assert np.isfinite(found.outputs).all()
        # Nobody of these was shown to the shipped networks: they know better than the mean all the same.
        said = network(found.inputs)[:, : found.outputs.shape[1]]
        spread = found.outputs - found.outputs.mean(axis=0)
        assert np.square(said - found.outputs).mean() < 0.8 * np.square(spread).mean()


def linear(count: int) -> Examples:
    random = np.random.default_rng(1)
    slopes = random.normal(0.0, 0.3, (4, 2))
    inputs = random.normal(0.0, 1.0, (count, 4))
    outputs: Array = inputs @ slopes
    return Examples(inputs, outputs + random.normal(0.0, 0.1, outputs.shape))


@pytest.mark.parametrize("name", ["arms", "hands"])
def test_a_network_learns_and_knows_how_sure_it_is(tmp_path: Path, name: str) -> None:
    file = tmp_path / "networks.safetensors"
    file.write_bytes(safetensors.numpy.save(fit(name, linear(1500))))
    new = linear(1600)
    said = load_network(name, file)(new.inputs[1500:])
    off = said[:, :2] - new.outputs[1500:]
    assert np.sqrt(np.square(off).mean()) < 0.25
    if name == "arms":
        assert np.exp(said[:, 2:]).mean() == pytest.approx(np.sqrt(np.square(off).mean()), rel=0.6)
