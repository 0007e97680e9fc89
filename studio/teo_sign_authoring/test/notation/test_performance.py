# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Scores performed by the synthetic signer: hands where the score says, turned as it says, when it says."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_sign_authoring.notation.performance import REST, WAY, Performance, performance
from teo_sign_authoring.notation.score_file import default_scores_directory, read_score
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_capture.retarget import handshapes
from teo_sign_capture.signing_space import OTHER_HAND, direction
from teo_sign_capture.tracks.signer_motion import signer_arm
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.lifting.hand_axes import straight_bends
from teo_synthetic_signer.body.body_data import load_body_data
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.script.motion import Motion
from teo_synthetic_signer.script.script_file import read_script

BODIES = ("man_tall", "woman_small", "man_heavy")
UP = {"palm": "front", "fingers": "up"}
FLAT = {"shape": "flat", "place": "space", **UP}
# Keypoints of FACE_70, iBUG's definition.
FACE = {"nose": [30], "chin": [8], "mouth": list(range(48, 68))}


@cache
def signer(body: str) -> Signer:
    return Signer(body)


def score(*steps: dict[str, Any], hands: str = "right") -> Score:
    return Score.model_validate(
        {"gloss": "X", "standing": "sketched", "source": "a test", "hands": hands, "steps": list(steps)}
    )


def played(performed: Performance, folder: Path, body: str = "woman_small") -> Motion:
    path = folder / "X.yaml"
    path.write_text(performed.text, "utf-8")
    return Motion(signer(body).poser, read_script(path).keys)


def truth(motion: Motion, time: float, body: str) -> dict[str, np.ndarray]:
    """Keypoints in the axes of the floor: x out of the chest, y to the left, z up [m]."""
    pose = motion.pose(time)
    person = signer(body)
    names = ("body", "left", "right", "face")
    return dict(zip(names, person.keypoints(pose, person.poser.transforms(pose)), strict=True))


def ways(hand: np.ndarray, side: str) -> tuple[np.ndarray, np.ndarray]:
    """The ways that a palm faces and its fingers point, of 21 keypoints."""
    along = hand[9] - hand[0]
    out = np.cross(hand[5] - hand[0], hand[17] - hand[0]) * (1.0 if side == "right" else -1.0)
    return out / np.linalg.norm(out), along / np.linalg.norm(along)


def angle(first: np.ndarray, second: np.ndarray) -> float:
    return float(np.degrees(np.arccos(np.clip(first @ second, -1.0, 1.0))))


DIRECTIONS = ("front", "back", "in", "up", "2 up in", "front up", "2 back in", "in up", "down", "in down")
on_body = st.sampled_from([*FACE, "eye", "ear", "temple", "cheek", "forehead", "shoulder", "chest", "belly"])


@settings(max_examples=8, deadline=None)
@given(
    body=st.sampled_from(BODIES),
    place=on_body,
    side=st.sampled_from(["right", "left"]),
    shape=st.sampled_from(["flat", "index", "fist", "l", "two", "open", "bunched"]),
    part=st.sampled_from(["palm", "fingertips", "index", "little_side"]),
    turned=st.tuples(st.sampled_from(DIRECTIONS), st.sampled_from(DIRECTIONS)).filter(
        lambda pair: abs(direction(pair[0]) @ direction(pair[1])) < 0.5
    ),
)
def test_hands_are_at_the_place_and_turned_as_said(
    tmp_path_factory: pytest.TempPathFactory,
    body: str,
    place: str,
    side: str,
    shape: str,
    part: str,
    turned: tuple[str, str],
) -> None:
    palm, fingers = turned
    # 22 cm before the skin, where no part of any hand need give way to the body.
    hand = {"shape": shape, "place": f"{place} 22 front", "part": part, "palm": palm, "fingers": fingers}
    performed = performance(score({"right": hand}, hands="right" if side == "right" else "mirrored"))
    motion = played(performed, tmp_path_factory.mktemp("x"), body)
    seen = truth(motion, performed.start, body)
    mirror = np.array([1.0, 1.0 if side == "right" else -1.0, 1.0])
    out, along = ways(seen[side], side)
    wanted = direction(fingers) - (direction(fingers) @ direction(palm)) * direction(palm)
    assert angle(along, wanted * mirror / np.linalg.norm(wanted)) < 2.0
    assert angle(out, direction(palm) * mirror) < 14.0  # the hollow of a fist: knuckles are in no plane
    letter = side[0].upper()
    joints = {name: seen["body"][index] for name, index in BODY_25.index.items()}
    known = {name: seen["face"][points].mean(axis=0) for name, points in FACE.items()}
    known |= {"eye": joints[f"{letter}Eye"], "ear": joints[f"{letter}Ear"]}
    parts = {"index": seen[side][8], "palm": seen[side][[0, 9]].mean(axis=0)}
    # Two hands at one place give way to each other.
    if place in known and part in parts and side == "right":
        arm = signer(body).poser.arms["R"]
        ahead = np.array([0.22 * (arm.upper + arm.fore) / 0.53, 0.0, 0.0])
        assert np.linalg.norm(parts[part] - known[place] - ahead) < 0.02


@pytest.mark.parametrize(
    ("body", "place", "part", "palm", "fingers"),
    [
        ("woman_small", "mouth", "fingertips", "back", "up in"),
        ("man_tall", "chin", "index", "back", "2 up in"),
        ("man_heavy", "cheek", "palm", "2 in back", "up"),
        ("man_heavy", "chest", "palm", "back", "in"),
        ("woman_small", "belly", "palm", "back", "in"),
    ],
)
def test_hands_touch_the_body_and_do_not_enter_it(
    tmp_path: Path, body: str, place: str, part: str, palm: str, fingers: str
) -> None:
    hand = {"shape": "flat", "place": place, "part": part, "palm": palm, "fingers": fingers}
    performed = performance(score({"right": hand, "hold": 0.3}))
    motion = played(performed, tmp_path, body)
    seen = truth(motion, performed.start + 0.1, body)
    pose = motion.pose(performed.start + 0.1)
    person = signer(body)
    skin = person.vertices(pose, person.poser.transforms(pose))
    arm = np.array([name.endswith(".R") for name in load_body_data().bones])[person.dress.surface.bones]
    others = np.unique(person.dress.surface.triangles[~arm])
    tip = {"fingertips": seen["right"][[8, 12, 16, 20]], "index": seen["right"][[8]]}.get(
        part, seen["right"][[5, 9, 13, 17]]
    )
    nearest = min(float(np.linalg.norm(skin[others] - point, axis=1).min()) for point in tip)
    assert nearest < 0.05  # joints are a centimetre or two below the skin, vertices as far apart


def test_the_time_of_a_score_is_the_time_of_its_performance(tmp_path: Path) -> None:
    steps = (
        {"right": FLAT, "hold": 0.2},
        {"time": 0.5, "right": {"place": "space 10 up"}, "hold": 0.3},
        {"time": 0.25, "right": {"place": "space"}},
    )
    performed = performance(score(*steps))
    assert performed.start == pytest.approx(REST + WAY)
    assert performed.end - performed.start == pytest.approx(0.2 + 0.5 + 0.3 + 0.25)
    motion = played(performed, tmp_path)
    assert motion.duration == pytest.approx(performed.end + WAY + REST)
    heights = [
        float(truth(motion, performed.start + time, "woman_small")["right"][0][2])
        for time in (0.0, 0.2, 0.7, 1.0, 1.25)
    ]
    assert np.abs(np.diff(heights)[[0, 2]]).max() < 0.005  # holds, but for swaying
    assert np.diff(heights)[1] > 0.06 and np.diff(heights)[3] < -0.06
    hanging = truth(motion, 0.1, "woman_small")
    assert hanging["right"][0][2] < hanging["body"][BODY_25.index["RElbow"]][2]
    assert hanging["left"][0][2] < hanging["body"][BODY_25.index["LElbow"]][2]


def test_a_circle_is_round_and_does_not_stop(tmp_path: Path) -> None:
    circle = {"plane": "front", "radius": 6.0, "turns": 2.0, "start": "up", "time": 1.2}
    hand = {**FLAT, "place": "space 12 front 6 up"}  # off the body all the way round
    performed = performance(score({"right": hand, "circle": circle}))
    motion = played(performed, tmp_path)
    times = np.linspace(performed.start, performed.end, 61)
    wrists = np.array([motion.pose(float(time)).arms["R"].wrist for time in times])
    middle = (wrists[:-1:2].min(axis=0) + wrists[:-1:2].max(axis=0)) / 2.0
    reach = (signer("woman_small").poser.arms["R"].upper + signer("woman_small").poser.arms["R"].fore) / 0.53
    radii = np.linalg.norm((wrists - middle)[:, 1:], axis=1)
    np.testing.assert_allclose(radii, 0.06 * reach, atol=0.004)
    assert np.ptp(wrists[:, 0]) < 0.004
    speeds = np.linalg.norm(np.diff(wrists, axis=0), axis=1)
    assert speeds[6:-6].min() > 0.6 * speeds[6:-6].max()
    assert wrists[6, 1] < wrists[0, 1]  # from the top outwards, as on the robot


@pytest.mark.parametrize("joint", ["wrist", "forearm", "elbow", "fingers", "index", "thumb"])
def test_what_wiggles_goes_away_and_comes_back_and_the_rest_stays(tmp_path: Path, joint: str) -> None:
    wiggle = {"joint": joint, "angle": 20.0, "times": 2, "time": 0.8}
    performed = performance(score({"right": FLAT, "wiggle": wiggle}))
    motion = played(performed, tmp_path)
    at = [truth(motion, performed.start + time, "woman_small")["right"] for time in (0.0, 0.2, 0.4, 0.6, 0.8)]
    assert max(np.abs(at[0] - at[2]).max(), np.abs(at[0] - at[4]).max()) < 0.05 * (joint == "fingers") + 0.01
    assert np.abs(at[1] - at[3]).max() < 0.01
    away = np.linalg.norm(at[1] - at[0], axis=1)
    if joint in ("index", "thumb"):
        moved = {"index": 8, "thumb": 4}[joint]
        assert away[moved] > 0.02
        assert np.delete(away, range(moved - 3, moved + 1)).max() < 0.01
    elif joint == "fingers":
        assert min(away[8], away[16]) > 0.02 and max(away[12], away[20]) < 0.02
    elif joint == "elbow":
        assert away[0] > 0.02
    else:
        assert away[0] < 0.01
        hands = [motion.pose(performed.start + time).arms["R"].hand for time in (0.0, 0.2)]
        cosine = (np.trace(hands[0].T @ hands[1]) - 1.0) / 2.0
        assert np.degrees(np.arccos(cosine)) == pytest.approx(20.0, abs=0.5)


@pytest.mark.parametrize(
    "movement",
    [
        {"circle": {"plane": "top", "radius": 6.0, "turns": 1.0, "time": 0.8, "hand": "left"}},
        {"wiggle": {"joint": "wrist", "angle": 20.0, "times": 1, "time": 0.8, "hand": "left"}},
    ],
)
def test_a_movement_of_one_hand_leaves_the_other_still(tmp_path: Path, movement: dict[str, Any]) -> None:
    hand = {**FLAT, "place": "space 12 out"}
    performed = performance(score({"right": hand, "left": hand, **movement}, hands="both"))
    motion = played(performed, tmp_path)
    at = [truth(motion, performed.start + time, "woman_small") for time in (0.0, 0.4)]
    assert np.abs(at[0]["right"] - at[1]["right"]).max() < 0.01
    assert np.abs(at[0]["left"] - at[1]["left"]).max() > 0.03


def test_a_head_turns_and_bows_and_a_way_swings_out_in_its_middle(tmp_path: Path) -> None:
    steps = (
        {"right": FLAT, "head": {"turn": 20.0, "bow": 8.0}, "hold": 0.3},
        {"time": 0.6, "right": {"place": "space 10 in"}, "arc": "8 up"},
    )
    performed = performance(score(*steps))
    motion = played(performed, tmp_path)
    yaw, pitch, _ = motion.pose(performed.start).head
    assert np.degrees([yaw, pitch]) == pytest.approx([-20.0, 8.0], abs=1.5)  # nobody stands still
    assert np.degrees(motion.pose(motion.duration).head[0]) == pytest.approx(0.0, abs=1.5)
    start, middle, end = (motion.pose(performed.start + time).arms["R"].wrist[2] for time in (0.3, 0.6, 0.9))
    assert middle - (start + end) / 2.0 > 0.05


@pytest.mark.parametrize("place", OTHER_HAND)
def test_the_right_hand_is_at_the_left_one_and_not_in_it(tmp_path: Path, place: str) -> None:
    left = {"shape": "flat", "place": "middle_space", "palm": "up", "fingers": "front in"}
    right = {"shape": "index", "place": place, "part": "index", "palm": "in", "fingers": "front down"}
    performed = performance(score({"left": left, "right": right}, hands="both"))
    motion = played(performed, tmp_path)
    seen = truth(motion, performed.start, "woman_small")
    nearest = np.linalg.norm(seen["left"] - seen["right"][8], axis=1).min()
    assert 0.005 < nearest < 0.06


@pytest.mark.parametrize("name", handshapes.NAMES)
def test_every_handshape_has_a_persons_hand(tmp_path: Path, name: str) -> None:
    performed = performance(score({"right": {**FLAT, "shape": name}}))
    hand = truth(played(performed, tmp_path), performed.start, "woman_small")["right"]
    robot = np.degrees(handshapes.written_shape(name))[2:]
    bends = []
    for base in (5, 9, 13, 17):
        bones = [b - a for a, b in pairwise(hand[[0, *range(base, base + 4)]])]
        bends.append(sum(angle(a / np.linalg.norm(a), b / np.linalg.norm(b)) for a, b in pairwise(bones)))
    # Fingers that TEO stretches are the ones that a person does; likewise those that it folds.
    assert max((bend for bend, angle_ in zip(bends, robot, strict=True) if angle_ < 15), default=0) < 60
    assert min((bend for bend, angle_ in zip(bends, robot, strict=True) if angle_ > 70), default=999) > 150
    # It is taken for what it is; three may be for a commoner one that differs little.
    arm = signer_arm("right", np.zeros((1, 3, 3)), hand[None], straight_bends(hand[None]))
    taken = handshapes.SHOWN[int(handshapes.shape_chances({"right": arm})["right"][0].argmax())]
    commoner = {"cupped": "relaxed", "relaxed": "flat", "three_flick": "bunched"}
    assert taken in {name, commoner.get(name, name)}


def test_scores_of_the_table_become_scripts_that_can_be_played(tmp_path: Path) -> None:
    paths = sorted(default_scores_directory().glob("*.yaml"))[::12]
    assert len(paths) > 8
    for path in paths:
        made = performance(read_score(path))
        written = tmp_path / path.name
        written.write_text(made.text, "utf-8")
        script = read_script(written)
        assert script.about.startswith(f"{path.stem}, performed from its score (")
        assert sum(key.move + key.hold for key in script.keys[1:]) == pytest.approx(made.end + WAY)
