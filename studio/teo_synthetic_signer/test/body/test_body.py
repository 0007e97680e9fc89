# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from refusals import refused
from scipy.spatial import cKDTree

from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_synthetic_signer.body.body_data import load_body_data
from teo_synthetic_signer.body.body_shapes import Phenotype, target_weights
from teo_synthetic_signer.body.pose import BodyPose
from teo_synthetic_signer.body.rig import PLACES
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.script.keys import ArmKey, Key, KeyResolver
from teo_synthetic_signer.script.motion import Motion
from teo_synthetic_signer.script.scripts import REST, SCRIPTS, script

FINGERS = {"thumb": 1, "index": 5, "middle": 9, "ring": 13, "little": 17}
STRAIGHT = ("index", "middle", "ring", "little")
EXTENDED = {
    **dict.fromkeys(("open", "flat", "b"), STRAIGHT),
    **dict.fromkeys(("fist", "thumb_up"), ()),
    **{finger: (finger,) for finger in ("index", "middle", "little")},
    **{"l": ("index",), "y": ("little",), "horns": ("index", "little")},
    "v": ("index", "middle"),
    "u": ("index", "middle"),
    "w": ("index", "middle", "ring"),
    "f": ("middle", "ring", "little"),
}


@pytest.fixture(scope="module")
def signer() -> Signer:
    return Signer("man_average")


@pytest.fixture(scope="module")
def still(signer: Signer) -> BodyPose:
    return Motion(signer.poser, (REST, REST)).pose(0.0)


def points(signer: Signer, pose: BodyPose) -> tuple[np.ndarray, ...]:
    return signer.keypoints(pose, signer.poser.transforms(pose))


def joint(body: np.ndarray, name: str) -> np.ndarray:
    return body[BODY_25.index[name]]


def wrists(signer: Signer, motion: Motion, rate: float) -> np.ndarray:
    """Where the right and the left wrist are over time [m]. Shape (n, 2, 3)."""
    bones = [signer.rig.bone(f"wrist.{side}") for side in "RL"]
    heads = np.column_stack([signer.rig.heads[bones], [1.0, 1.0]])
    times = np.arange(0.0, motion.duration, 1.0 / rate)
    moved = (signer.poser.transforms(motion.pose(float(time)))[bones] for time in times)
    return np.array([np.einsum("bij,bj->bi", transforms, heads)[:, :3] for transforms in moved])


def bends(hand: np.ndarray, finger: str) -> np.ndarray:
    """Angles between the consecutive bones of a finger, from its first joint on [deg]."""
    base = FINGERS[finger]
    bones = [b - a for a, b in pairwise(hand[base : base + 4])]
    return np.array(
        [
            np.degrees(np.arccos(np.clip(a @ b / np.linalg.norm(a) / np.linalg.norm(b), -1.0, 1.0)))
            for a, b in pairwise(bones)
        ]
    )


def with_hand(signer: Signer, side: str, key: ArmKey) -> tuple[np.ndarray, ...]:
    resolver = KeyResolver(signer.poser)
    rest = Motion(signer.poser, (REST, REST)).pose(0.0).arms
    return points(signer, BodyPose(arms={**rest, side: resolver.arm(side, key, None)}))


@pytest.mark.parametrize("name", ["woman_small", "man_tall", "man_heavy"])
def test_people_have_the_size_of_people_and_places_where_their_names_say(name: str) -> None:
    # Extremes of adults: NASA-STD-3000, 5th percentile woman of Japan to 95th percentile man of the USA, and
    # a little beyond.
    signer = Signer(name)
    pose = Motion(signer.poser, (REST, REST)).pose(0.0)
    body, left, right, _ = points(signer, pose)
    assert 1.45 < signer.height < 2.0
    for side in "RL":
        upper = np.linalg.norm(joint(body, f"{side}Shoulder") - joint(body, f"{side}Elbow"))
        fore = np.linalg.norm(joint(body, f"{side}Elbow") - joint(body, f"{side}Wrist"))
        assert 0.22 < upper < 0.36
        assert 0.17 < fore < 0.33
    for hand in (left, right):
        stretched = sum(np.linalg.norm(b - a) for a, b in pairwise(hand[[0, 9, 10, 11, 12]]))
        assert 0.15 < stretched < 0.24
    assert joint(body, "LShoulder")[1] > 0.1 > -0.1 > joint(body, "RShoulder")[1]  # y is to the left
    assert joint(body, "Nose")[0] > joint(body, "REar")[0]  # and x forwards
    assert min(joint(body, f"{side}Heel")[2] for side in "RL") > -0.01

    at = {place: signer.poser.places.at(place, "R") for place in PLACES}
    skin = signer.rig.vertices[np.unique(load_body_data().groups["body"])]
    away, _ = cKDTree(skin).query([at[place] for place in set(PLACES) - {"shoulders", "hip", "side"}])
    assert away.max() < 0.02  # as far as vertices of the chest are from each other
    down = ["crown", "forehead", "eye", "nose", "mouth", "chin", "throat", "upper_chest", "sternum", "belly"]
    heights = [at[place][2] for place in down]
    assert heights == sorted(heights, reverse=True)
    aside = [-at[place][1] for place in ("mouth", "mouth_corner", "cheek", "ear", "shoulder")]
    assert aside == sorted(aside)
    assert at["other_shoulder"][1] > 0.05 and at["other_chest"][1] > 0.05
    assert at["cheek"][0] > at["ear"][0] and at["throat"][0] < at["chin"][0]


def test_target_weights_of_each_kind_sum_to_one() -> None:
    sums: dict[str, float] = {}
    for name, weight in target_weights(Phenotype(gender=0.3, age=0.8, weight=0.7, height=0.2, muscle=0.9)):
        folder = (
            name.split("/")[1] if name.count("/") > 1 else name.split("/")[1].split("-")[0] == "universal"
        )
        sums[str(folder)] = sums.get(str(folder), 0.0) + weight
    assert len(sums) == 4
    assert list(sums.values()) == pytest.approx([1.0] * 4)


@pytest.mark.parametrize("wrong", [{"gender": 1.1}, {"age": 0.1}, {"african": 0, "asian": 0, "caucasian": 0}])
def test_a_phenotype_outside_its_range_is_refused(wrong: dict[str, float]) -> None:
    with refused("bad_phenotype"):
        Phenotype(**wrong)


@pytest.mark.parametrize("shape", EXTENDED)
def test_fingers_are_straight_or_folded_as_the_shape_says(signer: Signer, shape: str) -> None:
    _, _, hand, _ = with_hand(signer, "R", ArmKey(offset=(0.3, 0.1, 0.0), shape=shape))
    for finger in STRAIGHT:
        if finger in EXTENDED[shape]:
            assert bends(hand, finger).max() < 10.0
        elif shape == "f":
            assert np.linalg.norm(hand[4] - hand[8]) < 0.025  # the index finger meets the thumb
        else:
            assert bends(hand, finger)[0] > 70.0


def test_a_shown_palm_has_its_thumb_towards_the_middle_of_the_body(signer: Signer) -> None:
    key = ArmKey(offset=(0.3, 0.15, 0.0), fingers=(0.0, 0.0, 1.0), palm=(1.0, 0.0, 0.0), shape="open")
    _, _, right, _ = with_hand(signer, "R", key)
    _, left, _, _ = with_hand(signer, "L", key)
    assert right[4, 1] > right[20, 1]
    assert left[4, 1] < left[20, 1]
    assert right[12, 2] > right[0, 2] + 0.1
    np.testing.assert_allclose(right * [1, -1, 1], left, atol=2e-3)  # the body is the same on both sides
    _, _, bent, _ = with_hand(signer, "R", replace(key, shape="bent"))
    assert bent[8, 0] > bent[5, 0] + 0.03  # curled fingers come out on the side of the palm


def test_a_fingertip_goes_to_the_place_it_was_sent_to(signer: Signer) -> None:
    key = ArmKey(
        at="chin", point="index_tip", fingers=(-0.3, -0.4, 1.0), palm=(-1.0, 0.0, 0.0), shape="index"
    )
    _, _, right, face = with_hand(signer, "R", key)
    assert np.linalg.norm(right[8] - face[8]) < 0.04  # from the middle of the chin's front to its lower edge


def test_a_place_out_of_reach_is_pointed_at_with_an_arm_that_is_nearly_straight(signer: Signer) -> None:
    body, _, _, _ = with_hand(signer, "R", ArmKey(offset=(2.0, 0.0, 0.0)))
    upper, fore = (
        joint(body, b) - joint(body, a) for a, b in (("RShoulder", "RElbow"), ("RElbow", "RWrist"))
    )
    cosine = upper @ fore / np.linalg.norm(upper) / np.linalg.norm(fore)
    assert np.degrees(np.arccos(cosine)) < 25.0
    assert joint(body, "RWrist")[0] > 0.4


@pytest.mark.parametrize("name", SCRIPTS)
def test_bones_keep_their_length_wrists_bend_as_wrists_can_and_movement_is_smooth(
    signer: Signer, name: str
) -> None:
    motion = Motion(signer.poser, script(name))
    lengths = []
    for time in np.linspace(0.0, motion.duration, 8):
        pose = motion.pose(float(time))
        for side, arm in pose.arms.items():
            joints = signer.poser.limb(side, arm.wrist, arm.swivel)
            roll, bend = signer.poser.arms[side].wrist_strain(*joints, arm.hand)
            assert np.degrees(abs(roll)) < 125.0, (time, side)
            assert np.degrees(bend) < 90.0, (time, side)
        body, left, right, _ = points(signer, pose)
        limbs = [("Shoulder", "Elbow"), ("Elbow", "Wrist"), ("Hip", "Knee"), ("Knee", "Ankle")]
        lengths.append(
            [np.linalg.norm(joint(body, s + a) - joint(body, s + b)) for s in "RL" for a, b in limbs]
            + [
                np.linalg.norm(b - a)
                for hand in (left, right)
                for f in range(5)
                for a, b in pairwise(hand[1 + 4 * f : 5 + 4 * f])
            ]
        )
    assert np.ptp(np.array(lengths), axis=0).max() < 1e-9
    if name in ("face", "crossing", "fast"):
        velocity = np.diff(wrists(signer, motion, 40.0), axis=0) * 40.0
        speed = np.linalg.norm(velocity, axis=2)
        assert speed.max() < 6.0  # [m/s]; fastest signing is about 5
        assert name != "fast" or speed.max(axis=0).min() > 2.0
        jump = np.linalg.norm(np.diff(velocity, axis=0), axis=2).max()
        assert jump < 1.5  # [m/s] in a fortieth of a second: 60 m/s2


@pytest.mark.parametrize(
    ("code", "known", "key"),
    [
        ("unknown_hand_shape", "fist", {"shape": "paw"}),
        ("unknown_place", "chin", {"at": "moon"}),
        ("unknown_point", "index_tip", {"point": "elbow"}),
    ],
)
def test_unknown_names_are_named_with_those_that_are_known(
    signer: Signer, code: str, known: str, key: dict[str, str]
) -> None:
    with refused(code, known):
        KeyResolver(signer.poser).arm("R", ArmKey(**key), None)  # type: ignore[arg-type]


def test_a_step_moves_the_feet_and_never_sinks_them(signer: Signer) -> None:
    motion = Motion(signer.poser, script("side_step"))
    ankles = np.array(
        [
            [joint(points(signer, motion.pose(float(t)))[0], f"{side}Ankle") for side in "RL"]
            for t in np.linspace(0.0, motion.duration, 30)
        ]
    )
    assert ankles[-1, :, 1] - ankles[0, :, 1] == pytest.approx([0.3, 0.3], abs=0.02)
    floor = ankles[0, :, 2].min()
    assert ankles[:, :, 2].min() > floor - 0.02
    assert ankles[:, :, 2].max() > floor + 0.04


def test_a_face_moves_with_its_actions(signer: Signer, still: BodyPose) -> None:
    def opened(**actions: float) -> float:
        face = points(signer, BodyPose(arms=still.arms, face=actions))[3]
        return float(np.linalg.norm(face[66] - face[62]))

    assert opened(jawOpen=1.0) > opened() + 0.01
    with refused("unknown_facial_action"):
        opened(earWiggle=1.0)


def test_one_key_stands_still(signer: Signer) -> None:
    motion = Motion(signer.poser, (Key(right=REST.right, left=REST.left), REST))
    assert motion.pose(-1.0).arms["R"].wrist == pytest.approx(motion.pose(99.0).arms["R"].wrist)
