# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from teo_synthetic_signer.body.hand import HandShape
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.script.motion import Motion
from teo_synthetic_signer.script.script_file import read_script, script_of
from teo_synthetic_signer.script.scripts import SCRIPTS

GOOD = """\
about: a test
keys:
  - {right: hanging, left: hanging, hold: 0.4}
  - right:
      at: mouth
      offset: [0.02, 0, 0]
      point: fingertips
      fingers: [0.1, -0.3, 1]
      palm: [-1, -0.5, 0]
      shape: {index: [10, 20, 5], middle: [2, 4, 3], ring: [80, 90, 60], little: [80, 90, 60], thumb: out}
      swing: {forearm: 10}
    move: 0.6
    head: [20, 5, 0]
  - times: 2
    keys:
      - {right: hanging, bulge: [0, 0, 0.05]}
      - {right: hanging, face: {jawOpen: 0.5}}
"""


@pytest.fixture(scope="module")
def signer() -> Signer:
    return Signer("woman_average")


def written(folder: Path, text: str) -> Path:
    path = folder / "wave.yaml"
    path.write_text(text, "utf-8")
    return path


def test_keys_are_as_written_and_what_is_not_said_stays(tmp_path: Path) -> None:
    script = read_script(written(tmp_path, GOOD))
    assert script.about == "a test"
    rest, up, *down = script.keys
    assert rest.hold == 0.4 and rest.left is not None and up.left is None
    assert up.right is not None and isinstance(up.right.shape, HandShape)
    np.testing.assert_allclose(np.degrees(up.right.shape.flexion[0]), [10.0, 20.0, 5.0])
    assert np.degrees(up.right.swing.forearm) == pytest.approx(10.0)
    assert [np.degrees(key.head).round(6).tolist() for key in down] == [[20.0, 5.0, 0.0]] * 4
    assert [key.bulge[2] for key in down] == [0.05, 0.0, 0.05, 0.0]
    assert [dict(key.face) for key in down] == [{}, *[{"jawOpen": 0.5}] * 3]
    assert all(key.keep_out for key in script.keys)


@pytest.mark.parametrize(
    ("good", "bad", "where"),
    [
        ("at: mouth", "at: muoth", "wave.yaml:5: keys.1.right.at: expected one of crown"),
        ("offset: [0.02, 0, 0]", "offset: [2.2, 0, 0]", "wave.yaml:6: keys.1.right.offset.0"),
        ("point: fingertips", "point: tips", "wave.yaml:7: keys.1.right.point"),
        ("fingers: [0.1, -0.3, 1]", "fingers: [0, 0, 0]", "wave.yaml:8: keys.1.right.fingers: expected a d"),
        ("palm: [-1, -0.5, 0]", "palm: [-0.1, 0.3, -1]", "wave.yaml:4: keys.1.right: expected a palm"),
        ("[10, 20, 5]", "[10, 20]", "wave.yaml:10: keys.1.right.shape.index"),
        ("[10, 20, 5]", "[10, 200, 5]", "wave.yaml:10: keys.1.right.shape.index.1"),
        ("thumb: out", "thumb: aut", "wave.yaml:10: keys.1.right.shape.thumb: expected one of out"),
        ("{forearm: 10}", "{shoulder: 10}", "wave.yaml:11: keys.1.right.swing.shoulder"),
        ("move: 0.6", "move: .nan", "wave.yaml:12: keys.1.move"),
        ("move: 0.6", "move: 0", "wave.yaml:12: keys.1.move"),
        ("head: [20, 5, 0]", "head: [200, 5, 0]", "wave.yaml:13: keys.1.head.0"),
        ("head: [20, 5, 0]", "{through: true}", "wave.yaml"),
        ("times: 2", "times: 1", "wave.yaml:14: keys.2.times"),
        ("bulge: [0, 0, 0.05]", "through: true, hold: 1", "wave.yaml:16: keys.2.keys.0: expected neither"),
        ("{jawOpen: 0.5}", "{jawOpne: 0.5}", "wave.yaml:17: keys.2.keys.1.face: expected facial actions"),
        ("{jawOpen: 0.5}", "{jawOpen: 5}", "wave.yaml:17: keys.2.keys.1.face: expected a strength"),
        (", left: hanging", "", "wave.yaml:3: keys.0: the first key to say where the left arm is"),
        ("about: a test", "aboot: a test", "wave.yaml:1: about"),
        ("times: 2\n", "times: 100\n    keyz: []\n", "wave.yaml"),
    ],
)
def test_mistakes_are_named_with_line_and_field(tmp_path: Path, good: str, bad: str, where: str) -> None:
    assert good in GOOD
    with pytest.raises(SyntheticError) as raised:
        read_script(written(tmp_path, GOOD.replace(good, bad)))
    assert raised.value.code in ("bad_script", "not_yaml")
    assert where in str(raised.value)


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (b"", "bad_script"),
        (b"- 1\n", "bad_script"),
        (b"keys: [\n", "not_yaml"),
        (b"about: \xff\n", "not_yaml"),
        (b"about: x\nkeys: []\n", "bad_script"),
        (b"#" * 2_000_001, "script_too_large"),
        (
            GOOD.replace("times: 2", "times: 100").replace("[0, 0, 0.05]", "[0, 0, 0], hold: 9").encode(),
            "bad_script",
        ),
    ],
)
def test_what_is_no_script_is_refused(tmp_path: Path, data: bytes, code: str) -> None:
    path = tmp_path / "wave.yaml"
    path.write_bytes(data)
    with refused(code):
        read_script(path)


def test_names_are_names_and_files_are_files(tmp_path: Path) -> None:
    assert script_of("hello").keys == SCRIPTS["hello"]
    assert script_of(str(written(tmp_path, GOOD))).about == "a test"
    with pytest.raises(SyntheticError, match="unreadable_script"):
        script_of(str(tmp_path / "nothing.yaml"))
    with pytest.raises(SyntheticError, match="unknown_script"):
        script_of("nothing")


def test_a_place_that_no_arm_reaches_is_refused_and_a_little_too_far_is_said(
    signer: Signer, tmp_path: Path
) -> None:
    text = (
        "about: x\nkeys:\n- {right: hanging, left: hanging}\n"
        "- right: {at: shoulders, offset: [AHEAD, 0.1, 0], fingers: [1, 0, 0], palm: [0, -1, 0],\n"
        "    shape: flat}\n"
    )
    near = Motion(signer.poser, read_script(written(tmp_path, text.replace("AHEAD", "0.5"))).keys)
    assert near.shortfall < 1e-6
    far = Motion(signer.poser, read_script(written(tmp_path, text.replace("AHEAD", "0.7"))).keys)
    assert 0.02 < far.shortfall < 0.15
    with pytest.raises(SyntheticError, match=r"out_of_reach.*beyond it at 0\.45 s"):
        Motion(signer.poser, read_script(written(tmp_path, text.replace("AHEAD", "1.0"))).keys)


def test_the_example_of_the_documentation_can_be_played(tmp_path: Path) -> None:
    text = (Path(__file__).parents[2] / "README.md").read_text("utf-8")
    example = re.search(r"```yaml\n(.*?)```", text, re.DOTALL)
    assert example
    assert len(read_script(written(tmp_path, example[1])).keys) == 7


angles = st.tuples(*(st.floats(0.0, 85.0),) * 12)


@settings(max_examples=6)
@given(flexion=angles, side=st.sampled_from(["right", "left"]))
def test_fingers_bend_as_the_file_says(
    signer: Signer, tmp_path_factory: pytest.TempPathFactory, flexion: tuple[float, ...], side: str
) -> None:
    bends = np.reshape(flexion, (4, 3)).round(2)
    names = ("index", "middle", "ring", "little")
    shape = ", ".join(f"{name}: {row.tolist()}" for name, row in zip(names, bends, strict=True))
    text = (
        "about: x\nkeys:\n- {right: hanging, left: hanging}\n"
        f"- {side}: {{at: shoulders, offset: [0.35, 0.1, 0.1], fingers: [0, 0, 1], palm: [1, 0, 0], "
        f"shape: {{{shape}, spread: [0, 0, 0, 0], thumb: out}}}}\n"
    )
    motion = Motion(signer.poser, read_script(written(tmp_path_factory.mktemp("x"), text)).keys)
    pose = motion.pose(motion.duration)
    _, left, right, _ = signer.keypoints(pose, signer.poser.transforms(pose))
    hand = right if side == "right" else left
    for finger, wanted in enumerate(bends):
        base = 5 + 4 * finger
        bones = [b - a for a, b in pairwise(hand[base : base + 4])]
        for (a, b), angle in zip(pairwise(bones), wanted[1:], strict=True):
            cosine = a @ b / np.linalg.norm(a) / np.linalg.norm(b)
            assert np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))) == pytest.approx(angle, abs=0.1)


def test_hands_go_through_a_pose_without_a_stop_and_swing_out_on_the_way(
    signer: Signer, tmp_path: Path
) -> None:
    hand = "at: shoulders, fingers: [0, 0, 1], palm: [1, 0, 0], shape: flat"
    text = (
        "about: x\nkeys:\n- {right: hanging, left: hanging}\n"
        f"- right: {{{hand}, offset: [0.3, 0.0, 0.0]}}\n"
        f"- {{right: {{{hand}, offset: [0.3, 0.1, 0.0]}}, move: 0.3, through: true}}\n"
        f"- {{right: {{{hand}, offset: [0.3, 0.2, 0.0]}}, move: 0.3}}\n"
        f"- {{right: {{{hand}, offset: [0.3, 0.0, 0.0]}}, move: 0.4, bulge: [0, 0, 0.06]}}\n"
    )
    motion = Motion(signer.poser, read_script(written(tmp_path, text)).keys)

    def wrist(time: float) -> np.ndarray:
        return np.asarray(motion.pose(time).arms["R"].wrist)

    def speed(time: float) -> float:
        return float(np.linalg.norm(wrist(time + 1e-3) - wrist(time - 1e-3))) / 2e-3

    start = motion.duration - 1.0
    reach = (signer.poser.arms["R"].upper + signer.poser.arms["R"].fore) / 0.53
    assert speed(start) < 0.02 and speed(start + 0.6) < 0.02
    assert speed(start + 0.3) == pytest.approx(0.2 * reach / 0.6, rel=0.05)
    np.testing.assert_allclose(wrist(start + 0.3)[1] - wrist(start)[1], -0.1 * reach, atol=1e-3)
    middle = (wrist(start + 0.6) + wrist(start + 1.0)) / 2.0
    np.testing.assert_allclose(wrist(start + 0.8) - middle, [0.0, 0.0, 0.06 * reach], atol=1e-3)
