# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The steps from landmarks to signs, each against a truth of its own."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import cache
from importlib import resources
from pathlib import Path

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.hand_geometry import segment_distances
from teo_description.robot import Robot
from teo_names import RIGHT_ARM, RIGHT_HAND
from teo_sign_authoring.alphabet.hand_fit import HandPose, SignerHand, fit_hand, measure_signer
from teo_sign_authoring.alphabet.letter_clips import DEPTH_SCALE, LetterClip, find_stroke, load_letter_clips
from teo_sign_authoring.alphabet.spelling_arm import fit_arm, shift_off_face, spelling_bounds
from teo_sign_authoring.alphabet.spelling_hand import fit_robot_hand
from teo_sign_authoring.cli.capture_table import demonstration_main, letters_main
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_languages import DEFAULT_LANGUAGE, Alphabet, Language, LetterClips, load_language
from teo_signs.look_up_table import Lut, LutError
from teo_skeleton_retriever.lifting.hand_axes import palm_axes


@cache
def clips() -> dict[str, LetterClip]:
    return load_letter_clips(load_language(DEFAULT_LANGUAGE))


@cache
def signer() -> SignerHand:
    return measure_signer(clip.hand for clip in clips().values())


def hand_of(rotation: Array, bends: Array, spreads: Array) -> Array:
    """Landmarks of the signer's hand in a pose, seen without error [pixel]."""
    points = np.zeros((21, 3))
    points[[0, 1, 5, 9, 13, 17]] = signer().palm
    for finger in range(4):
        sideways = np.array([np.cos(spreads[finger]), np.sin(spreads[finger]), 0.0])
        at = points[5 + 4 * finger]
        for bone, total in enumerate(np.cumsum(bends[finger])):
            ahead = np.cos(total) * sideways + np.sin(total) * np.array([0.0, 0.0, 1.0])
            at = at + signer().fingers[finger, bone] * ahead
            points[6 + 4 * finger + bone] = at
    for bone in range(3):
        points[2 + bone] = points[1 + bone] + signer().thumb[bone] * np.array([0.8, -0.6, 0.0])
    return points @ rotation.T


# --- recordings


def test_the_thirty_letters_are_read_in_the_order_of_the_alphabet() -> None:
    assert " ".join(clips()) == "A B C CH D E F G H I J K L LL M N Ñ O P Q R RR S T U V W X Y Z"
    for clip in clips().values():
        assert clip.rate == 25.0
        assert 20 <= len(clip.hand) <= 32
        assert not clip.hand.flags.writeable


def test_where_the_hand_was_lost_it_is_led_from_where_it_was_last_seen() -> None:
    # Q's hand shrinks to a third from one frame to the next and grows again 15 frames later: nobody's does.
    clip = clips()["Q"]
    assert np.flatnonzero(clip.lost).tolist() == list(range(6, 21))
    assert sum(int(clip.lost.sum()) for letter, clip in clips().items() if letter != "Q") <= 1
    length = np.linalg.norm(clip.hand[5:22, 9, 1:] - clip.hand[5:22, 0, 1:], axis=1)
    assert length.min() > 0.9 * length.max()
    np.testing.assert_allclose(clip.hand[13], 0.5 * clip.hand[5] + 0.5 * clip.hand[21])


def test_the_depth_scale_keeps_the_bones_longest_constant() -> None:
    frames = np.concatenate([clip.hand for clip in clips().values()])
    bones = [(first, first + 1) for first in range(1, 20) if first % 4] + [(0, 5), (0, 17), (5, 17)]

    def deviation(scale: float) -> float:
        scaled = frames * [scale / DEPTH_SCALE, 1.0, 1.0]
        lengths = np.array([np.linalg.norm(scaled[:, a] - scaled[:, b], axis=1) for a, b in bones])
        median = np.median(lengths, axis=1, keepdims=True)
        return float(np.median(np.abs(lengths / median - 1.0), axis=1).mean())

    best = min(range(0, 1500, 50), key=deviation)
    assert abs(best - DEPTH_SCALE) <= 100
    assert deviation(0.0) > 1.3 * deviation(DEPTH_SCALE)


def test_recordings_that_are_missing_or_of_others_are_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    american = load_language("ase")

    def edited(**changes: object) -> Language:
        alphabet = msgspec.structs.replace(american.alphabet, **changes)
        return msgspec.structs.replace(american, alphabet=alphabet)

    more = edited(letters=[*american.alphabet.letters, "Ñ"], frequencies={})
    french = edited(clips=LetterClips(collection="fsl"))  # whose rows name the American files
    for language, code, said in (
        (french, "other_language", "files of ase under its name"),
        (more, "no_clips", "^Ñ: "),
    ):
        with pytest.raises(LutError, match=said) as caught:
            load_letter_clips(language)
        assert caught.value.code == code

    def missing(*_: object) -> None:
        raise ModuleNotFoundError("No module named 'spoken_to_signed'")

    monkeypatch.setattr("importlib.resources.files", missing)
    with pytest.raises(LutError, match="pip install spoken-to-signed") as caught:
        load_letter_clips(american)
    assert caught.value.code == "no_clips"


def recordings_of(collection: str, *letters: str) -> Language:
    """A language of some letters of a collection."""
    alphabet = Alphabet(letters=letters, clips=LetterClips(collection=collection))
    return msgspec.structs.replace(load_language("ase"), alphabet=alphabet)


def test_a_recording_in_which_the_hand_comes_late_is_read_from_where_it_is_seen() -> None:
    # The index spells sgg's Ä with a combining mark.
    for collection, letter, frames in (("mfs", "S", 22), ("sgg", "Y", 31), ("sgg", "Ä", 33)):
        clip = load_letter_clips(recordings_of(collection, letter))[letter]
        assert len(clip.hand) == frames
        assert np.isfinite(clip.hand).all()


def test_a_letter_signed_with_the_left_hand_is_its_mirror_image() -> None:
    # The Italian signer has her right hand down all the time. V stands up, its palm to the viewer.
    clip = load_letter_clips(recordings_of("ise", "V"))["V"]
    axes = palm_axes(np.median(clip.hand, axis=0)[None])[0]
    assert axes[0, 2] > 0.7
    assert axes[2, 0] > 0.7
    # To her right, as right hands of the other collections are.
    assert np.median(clip.hand[:, 0, 1]) < 250.0


def test_a_letter_of_two_hands_is_refused() -> None:
    # Turkish Sign Language spells with two hands, but for a few letters.
    with pytest.raises(LutError, match=r"A: .*both hands") as caught:
        load_letter_clips(recordings_of("tsm", "A", "C"))
    assert caught.value.code == "two_hands"


def test_a_damaged_recording_is_named_and_the_other_letters_are_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lexicon = Path(str(resources.files("spoken_to_signed"))) / "assets" / "fingerspelling_lexicon"
    folder = tmp_path / "assets" / "fingerspelling_lexicon"
    (folder / "mfs").mkdir(parents=True)
    for letter in "AL":
        (folder / "mfs" / f"{letter}.pose").write_bytes((lexicon / "ssp" / clips()[letter].file).read_bytes())
    (folder / "mfs" / "B.pose").write_bytes(b"\x00" * 40)
    rows = [f"mfs/{letter}.pose,mfs,{letter}" for letter in "ABL"]
    (folder / "index.csv").write_text("\n".join(["path,signed_language,words", *rows]), "utf-8")
    monkeypatch.setattr("importlib.resources.files", lambda _: tmp_path)
    home = tmp_path / "teo" / "languages" / "mfs"
    home.mkdir(parents=True)
    (home / "language.yaml").write_text(
        "{code: mfs, bcp47: mfs, names: {en: M, own: M, short: M}, spoken: {code: es, name: Spanish}, "
        "alphabet: {letters: [A, B, L, Q], clips: {collection: mfs}}, sentences: [A]}"
    )
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.setattr(sys, "argv", ["capture_letters", "--language", "mfs", "--out", str(tmp_path / "lut")])
    with pytest.raises(SystemExit) as caught:
        letters_main()
    said = " ".join(capsys.readouterr().err.split())
    assert caught.value.code == 1
    assert "bad_clip: B: B.pose" in said
    assert "no_clips: Q: " in said
    assert "2 of 4 letters left out: B, Q" in said
    assert sorted(path.stem for path in (tmp_path / "lut").glob("*.json")) == ["A", "L"]


# --- hand of the signer


@pytest.mark.parametrize("turn", [(0.2, -1.2, 0.3), (0.0, -1.5, 0.6), (0.3, -0.9, -0.8)])
def test_a_hand_seen_without_error_is_recovered(turn: tuple[float, float, float]) -> None:
    rotation = Rotation.from_euler("xyz", turn).as_matrix()
    bends = np.radians([[5.0, 3.0, 2.0], [10.0, 40.0, 24.0], [60.0, 90.0, 50.0], [20.0, 20.0, 12.0]])
    spreads = np.radians([-8.0, 0.0, 3.0, 10.0])
    pose = fit_hand(hand_of(rotation, bends, spreads), signer())
    assert np.degrees(Rotation.from_matrix(rotation.T @ pose.rotation).magnitude()) < 4.0
    assert np.degrees(pose.bends.sum(axis=1)) == pytest.approx(np.degrees(bends.sum(axis=1)), abs=12.0)
    assert pose.residual < 1.5


def test_a_depth_that_is_wrong_by_half_is_corrected_by_the_bones() -> None:
    rotation = Rotation.from_euler("xyz", (0.1, -1.1, 0.5)).as_matrix()
    seen = hand_of(rotation, np.zeros((4, 3)), np.zeros(4))
    flat = seen * [0.5, 1.0, 1.0]
    naive = palm_axes(flat[None])[0]
    fitted = fit_hand(flat, signer()).rotation
    error = [Rotation.from_matrix(rotation.T @ found).magnitude() for found in (naive, fitted)]
    assert error[1] < 0.7 * error[0]


# --- stroke


def test_a_stroke_leaves_out_the_rise_and_the_fall() -> None:
    for clip in clips().values():
        stroke = find_stroke(clip)
        assert 2 <= stroke.first < stroke.last <= len(clip.hand) - 2
        wrist = clip.hand[:, 0, 2]
        assert np.median(wrist[stroke.first : stroke.last + 1]) > min(wrist[0], wrist[-1]) + 20.0


def test_only_letters_that_turn_have_several_holds() -> None:
    turning = {letter for letter, clip in clips().items() if find_stroke(clip).turns}
    assert turning == {"H", "X"}


# --- TEO's hand


@given(numbers=st.lists(st.floats(-1.0, 1.0), min_size=12, max_size=12))
def test_segment_distance_is_the_least_of_all_pairs_of_points(numbers: list[float]) -> None:
    start, end, other_start, other_end = np.array(numbers).reshape(4, 3)
    if np.linalg.norm(end - start) < 0.05 or np.linalg.norm(other_end - other_start) < 0.05:
        return  # bones have lengths
    share = np.linspace(0.0, 1.0, 40)[:, None]
    one, other = start + share * (end - start), other_start + share * (other_end - other_start)
    sampled = np.linalg.norm(one[:, None] - other[None], axis=2).min()
    exact = segment_distances(start, end, other_start[None], other_end[None])[0]
    assert exact <= sampled + 1e-9
    assert exact >= sampled - 0.1


def posed(bends_deg: list[list[float]], rotation: Array, thumb: Array) -> HandPose:
    return HandPose(
        rotation=rotation,
        bends=np.radians(bends_deg),
        spreads=np.zeros(4),
        thumb=thumb,
        tips=np.array([[1.0, 0.0, 0.2]] * 4),
        residual=0.0,
    )


PALM_OUT = np.column_stack([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])
BESIDE = np.array([[-0.4, -0.3, 0.1], [0.0, -0.35, 0.1], [0.3, -0.35, 0.1]])


def test_fingers_that_bend_like_teos_are_taken_over_as_they_are(robot: Robot) -> None:
    bends = [[25.0] * 3, [30.0] * 3, [45.0] * 3, [70.0] * 3]
    fit = fit_robot_hand(robot, posed(bends, PALM_OUT, BESIDE), PALM_OUT)
    assert np.degrees(fit.positions[2:]) == pytest.approx([25, 30, 45, 70], abs=2.0)
    assert fit.fingertip_error < 0.002


def test_a_fist_is_a_fist_and_a_flat_hand_flat(robot: Robot) -> None:
    fist = fit_robot_hand(robot, posed([[80.0, 100.0, 70.0]] * 4, PALM_OUT, BESIDE), PALM_OUT)
    flat = fit_robot_hand(robot, posed([[0.0, 0.0, 0.0]] * 4, PALM_OUT, BESIDE), PALM_OUT)
    assert (np.degrees(fist.positions[2:]) > 75.0).all()
    assert np.degrees(flat.positions[2:]) == pytest.approx([7.0] * 4, abs=0.5)


# --- TEO's arm


def placed(robot: Robot, arm: Array) -> Array:
    pose = dict(zip(RIGHT_ARM, arm.tolist(), strict=True))
    return robot.placement(robot.configuration(pose), "right_palm")


@settings(max_examples=25)
@given(share=st.lists(st.floats(0.1, 0.9), min_size=6, max_size=6))
def test_an_arm_is_within_its_bounds_and_as_far_off_as_it_says(share: list[float]) -> None:
    robot = Robot.load()
    lower, upper = spelling_bounds(ArmKinematics(robot))
    wanted = placed(robot, lower + np.array(share) * (upper - lower))
    fit = fit_arm(robot, wanted[:3, :3], wanted[:3, 3])
    assert (fit.positions >= lower).all() and (fit.positions <= upper).all()
    away = np.linalg.norm(placed(robot, fit.positions)[:3, 3] - wanted[:3, 3])
    assert fit.place_error == pytest.approx(away, abs=1e-9)


def test_a_pose_near_the_spelling_place_is_reached_to_a_degree_and_centimetres(robot: Robot) -> None:
    wanted = placed(robot, np.radians([-70.0, 5.0, 15.0, -85.0, 30.0, -10.0]))
    fit = fit_arm(robot, wanted[:3, :3], wanted[:3, 3])
    assert np.degrees(fit.angle_error) < 1.0
    assert fit.place_error < 0.02


def test_a_hand_before_the_face_is_moved_off_it_and_one_beside_it_is_not(robot: Robot) -> None:
    beside = Lut.open()["U"].knots
    assert not shift_off_face(robot, beside).any()
    q = robot.configuration(dict(zip(RIGHT_ARM + RIGHT_HAND, beside[0].tolist(), strict=True)))
    place = robot.placement(q, "right_palm")
    before = fit_arm(robot, place[:3, :3], place[:3, 3] + [0.0, 0.17, -0.02])
    shift = shift_off_face(robot, np.concatenate([before.positions, beside[0, 6:]])[None])
    assert shift[1] < -0.01 or shift[2] < -0.01
    assert shift[0] == 0.0


# --- the command


def run(monkeypatch: pytest.MonkeyPatch, command: Callable[[], None], *arguments: str) -> int:
    monkeypatch.setattr(sys, "argv", ["capture", *arguments])
    with pytest.raises(SystemExit) as ended:
        command()
    return int(ended.value.code or 0)


def test_the_command_writes_the_letter_that_the_table_has(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert run(monkeypatch, letters_main, "--out", str(tmp_path), "--only", "I") == 0
    assert [path.name for path in tmp_path.iterdir()] == ["I.json"]
    made, kept = Lut.open(tmp_path)["I"], Lut.open()["I"]
    np.testing.assert_allclose(made.knots, kept.knots, atol=0.02)  # processors add in other orders
    np.testing.assert_allclose(made.times, kept.times)


def test_entries_are_not_replaced_unasked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("--out", str(tmp_path))
    assert run(monkeypatch, demonstration_main, *words) == 0
    assert Lut.open(tmp_path).glosses() == ("HOLA", "MI", "NOMBRE")
    before = (tmp_path / "MI.json").read_bytes()
    assert run(monkeypatch, demonstration_main, *words) == 1
    assert "exists" in capsys.readouterr().err
    assert (tmp_path / "MI.json").read_bytes() == before
    assert run(monkeypatch, demonstration_main, *words, "--replace") == 0


def test_what_was_not_recorded_and_where_it_cannot_be_written_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    assert run(monkeypatch, letters_main, "--out", str(tmp_path / "lut"), "--only", "Ç") == 1
    assert "unknown_letter" in capsys.readouterr().err
    assert run(monkeypatch, demonstration_main, "--out", str(tmp_path / "file" / "lut")) == 1
    assert "not_written" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
