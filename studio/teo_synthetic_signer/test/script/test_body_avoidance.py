# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_synthetic_signer.body.pose import ArmPose
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.script.body_avoidance import Clearing
from teo_synthetic_signer.script.keys import ArmKey, Key, KeyResolver
from teo_synthetic_signer.script.motion import Motion
from teo_synthetic_signer.script.scripts import HANGING

TO_SELF = ArmKey(at="sternum", fingers=(0.1, -1.0, 0.3), palm=(-1.0, 0.0, 0.0), shape="flat")


@pytest.fixture(scope="module", params=["man_heavy", "woman_small"])
def signer(request: pytest.FixtureRequest) -> Signer:
    return Signer(request.param)


def arms(signer: Signer, right: ArmKey, left: ArmKey = HANGING) -> dict[str, ArmPose]:
    resolver = KeyResolver(signer.poser)
    return {"R": resolver.arm("R", right, None), "L": resolver.arm("L", left, None)}


@pytest.mark.parametrize(("at", "inwards"), [("sternum", 0.04), ("belly", 0.06), ("mouth", 0.03)])
def test_a_hand_in_the_body_comes_out_to_the_skin(signer: Signer, at: str, inwards: float) -> None:
    clearing = Clearing(signer.poser)
    asked = arms(signer, ArmKey(**{**vars(TO_SELF), "at": at, "offset": (-inwards, 0.0, 0.0)}))
    assert clearing.depth(asked) > 0.01
    kept = clearing.cleared(asked)
    assert clearing.depth(kept) < 5e-3
    np.testing.assert_array_equal(kept["R"].hand, asked["R"].hand)
    assert (
        np.linalg.norm(kept["R"].wrist - asked["R"].wrist) < inwards + 0.07
    )  # half a hand, cloth, and not always the shortest way


def test_hands_in_each_other_give_way_both_alike(signer: Signer) -> None:
    clearing = Clearing(signer.poser)
    inside = ArmKey(at="sternum", offset=(0.25, 0.0, 0.1), fingers=(0.3, 0.0, 1.0), palm=(0.0, -1.0, 0.0))
    asked = arms(signer, inside, inside)
    assert clearing.depth(asked) > 0.01
    kept = clearing.cleared(asked)
    assert clearing.depth(kept) < 5e-3
    moved = {side: kept[side].wrist - asked[side].wrist for side in "RL"}
    assert moved["R"][1] < -0.005 and moved["L"][1] > 0.005
    np.testing.assert_allclose(moved["R"] * [1.0, -1.0, 1.0], moved["L"], atol=0.01)


def test_hands_in_the_air_stay_where_they_are(signer: Signer) -> None:
    asked = arms(signer, ArmKey(**{**vars(TO_SELF), "offset": (0.2, 0.1, 0.0)}))
    kept = Clearing(signer.poser).cleared(asked)
    np.testing.assert_array_equal(kept["R"].wrist, asked["R"].wrist)


def test_a_way_from_cheek_to_cheek_leads_round_the_face(signer: Signer) -> None:
    palm = ArmKey(at="cheek", fingers=(0.0, -0.3, 1.0), palm=(-0.3, -1.0, 0.0), point="fingertips")
    across = ArmKey(
        at="nose",
        offset=(-0.04, -0.09, 0.0),
        fingers=(-0.3, -0.5, 0.8),
        palm=(-1.0, 0.0, -0.3),
        point="fingertips",
    )
    keys = [Key(right=palm, left=HANGING, keep_out=True), Key(right=across, move=1.0, keep_out=True)]
    motion, clearing = Motion(signer.poser, keys), Clearing(signer.poser)
    poses = [motion.pose(float(time)).arms for time in np.arange(0.15, motion.duration, 0.04)]
    assert max(clearing.depth(pose) for pose in poses) < 5e-3
    wrists = np.array([pose["R"].wrist for pose in poses])
    assert np.linalg.norm(np.diff(wrists, axis=0), axis=1).max() / 0.04 < 2.0  # as fast as signers [m/s]
