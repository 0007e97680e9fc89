# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Places of a body: on the skin, in the order of a body, on the side of the hand."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from teo_synthetic_signer.body.body_data import load_body_data
from teo_synthetic_signer.body.body_shapes import BODIES
from teo_synthetic_signer.body.rig import PLACES, Places
from teo_synthetic_signer.body.signer import Signer

INSIDE = {"shoulders", "hip", "side"}


@pytest.fixture(scope="module", params=BODIES)
def signer(request: pytest.FixtureRequest) -> Signer:
    return Signer(request.param)


def test_places_are_on_the_skin_where_their_names_say(signer: Signer) -> None:
    places = Places(signer.rig)
    right = {name: places.at(name, "R") for name in PLACES}
    skin = signer.rig.vertices[np.unique(load_body_data().groups["body"])]
    away, _ = cKDTree(skin).query([right[name] for name in PLACES if name not in INSIDE])
    assert away.max() < 0.02  # as far as vertices of the chest are from each other

    down = ["crown", "forehead", "eye", "nose", "mouth", "chin", "throat", "upper_chest", "sternum", "belly"]
    heights = [right[name][2] for name in down]
    assert heights == sorted(heights, reverse=True)
    outwards = ["mouth_corner", "cheek", "ear", "shoulder"]
    aside = [-right[name][1] for name in ("mouth", *outwards)]
    assert aside == sorted(aside)
    assert right["other_shoulder"][1] > 0.05 and right["other_chest"][1] > 0.05
    assert right["cheek"][0] > right["ear"][0] and right["throat"][0] < right["chin"][0]


def test_places_of_the_left_hand_mirror_those_of_the_right(signer: Signer) -> None:
    places = Places(signer.rig)
    for name in PLACES:
        np.testing.assert_allclose(places.at(name, "L"), places.at(name, "R") * [1.0, -1.0, 1.0])
