# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whole signs of the LSE community's dictionary, against what the symbols say to a reader."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from teo_sign_authoring.notation.score_file import read_score
from teo_sign_authoring.notation.score_schema import Step, flattened
from teo_sign_authoring.signwriting.compiler import Compilation, compile_fsw
from teo_sign_authoring.signwriting.dictionary_import import score_text
from teo_sign_authoring.signwriting.written_sign import UnreadableError
from teo_sign_capture.signing_space import split_place
from teo_signs.errors import LutError

# SignPuddle LSE dictionary, single strings.
FRIENDSHIP = "M520x520S1ce48480x490S1ce40498x490S20800493x479"
BLUE = "M535x539S2ff00482x482S14c02465x516S19217516x505S26506500x521"
BLACK = "M548x536S2ff00482x482S15a10495x504S26b04521x507S20500529x525"
MINE = "M521x517S36d00479x484S15a11475x494S20600496x494"
LIKE = "M545x571S33b00482x482S20600490x520S10018499x534S10002515x526S26a02531x544"
LEAST = "M521x530S15a02491x485S15a06479x501S20e00490x470S22b04505x500"
ICE = "M529x545S33b00482x482S1850f510x510S26a02487x518"
ANGRY = "M535x539S30c00482x482S15a10495x504S26506521x507"  # a face that TEO has not
SAW = "M543x530S14c02512x472S14c0a456x471S2ea00525x498S2ea40459x499S2fb04492x524"


def steps(compilation: Compilation) -> list[Step]:
    return flattened(compilation.score.steps)


def compiled(fsw: str) -> Compilation:
    return compile_fsw("PRUEBA", fsw, source="a test")


def test_a_hand_at_the_chest_touches_it_as_often_as_drawn() -> None:
    touching = [
        step.right.place for step in steps(compiled(MINE)) if step.right is not None and step.right.place
    ]
    assert all("chest" in place for place in touching)
    assert len(touching) == 4  # off, on, off, on: a double touch


def test_a_hand_drawn_beside_the_face_is_at_the_head() -> None:
    first = steps(compiled(BLACK))[0].right
    assert first is not None and first.place is not None
    assert first.place.split()[0] in ("chin", "mouth", "mouth_corner", "cheek")
    assert (first.shape, first.palm, first.fingers) == ("flat", "in", "up")


def test_a_hand_drawn_twice_changes_its_shape_along_the_arrow() -> None:
    shapes = [
        step.right.shape for step in steps(compiled(BLUE)) if step.right is not None and step.right.shape
    ]
    assert shapes == ["open", "little"]


def test_a_movement_drawn_twice_is_made_twice_where_hands_are_no_mirrors() -> None:
    compilation = compiled(LIKE)
    assert compilation.score.hands == "both"
    places = [step.right.place for step in steps(compilation) if step.right is not None]
    assert len(places) == 4
    assert places[0] == places[2] != places[1] == places[3]


def test_two_flat_hands_that_touch_are_no_hand_before_and_after() -> None:
    compilation = compiled(LEAST)
    assert compilation.score.hands == "both"
    moved = [step for step in steps(compilation)[1:] if step.left is not None]
    assert not moved, "the hand below is no longer where the arrow leads"


def test_the_black_arrow_of_a_lone_hand_is_the_right_hands() -> None:
    score = compiled(ICE).score
    assert score.hands == "right"
    places = [step.right.place for step in flattened(score.steps) if step.right is not None]
    assert all(place is not None for place in places)
    sideways = [split_place(str(place))[1][1] for place in places]
    assert sideways[1] > sideways[0], "the arrow points to the left, the inside of a right hand"


@pytest.mark.parametrize(
    ("fsw", "code"),
    [
        ("M518x517S30a00482x482", "no_hand"),
        ("M520x520S15a00480x480S29600500x480", "movement"),
        ("M514x521S1a120493x492S21900487x480", "movement"),  # horns that close to what TEO does not have
        (SAW, "movement"),  # a head of an arrow that is neither hand's
        ("M520x520S15a00480x480S20300500x480S17600490x500", "too_many_hands"),
        ("M520x520S15d00480x480S1f700520x520", "order"),
        ("M520x520S1c400480x480", "handshape"),
        ("M520x520S15a00480x480S37700520x480", "limb"),
    ],
)
def test_what_is_not_understood_is_refused_by_name(fsw: str, code: str) -> None:
    with refused(code):
        compiled(fsw)


@pytest.mark.parametrize("fsw", [FRIENDSHIP, BLUE, BLACK, MINE, ANGRY])
def test_a_score_reads_back_as_it_was_written(fsw: str, tmp_path: Path) -> None:
    compilation = compiled(fsw)
    score = compilation.score
    assert (score.hands == "mirrored") == (fsw == FRIENDSHIP)  # like hands that face each other
    assert (
        ("eyebrows" in score.face) == (fsw == ANGRY) == any("eyebrows" in loss for loss in compilation.losses)
    )
    (tmp_path / "PRUEBA.yaml").write_text(score_text(score), "utf-8")
    assert read_score(tmp_path / "PRUEBA.yaml") == score


@given(
    base=st.integers(0x100, 0x204),
    fill=st.integers(0, 5),
    rotation=st.integers(0, 15),
    movement=st.integers(0x205, 0x2F4),
    way=st.integers(0, 7),
)
def test_any_hand_with_any_movement_is_compiled_or_refused(
    base: int, fill: int, rotation: int, movement: int, way: int
) -> None:
    fsw = f"M550x550S{base:03x}{fill:x}{rotation:x}480x480S{movement:03x}0{way:x}510x480"
    try:
        score = compiled(fsw).score
    except (UnreadableError, LutError) as refused:
        assert refused.code
    else:
        assert all(np.isfinite(step.time) for step in flattened(score.steps))


@pytest.mark.parametrize(
    "text",
    ["", "hola", "M518x517", "M518x517S15a00", "M5x5S15a00482x482", "M518x517" + "S15a00482x482" * 1000],
)
def test_what_is_no_sign_is_refused(text: str) -> None:
    with refused("bad_fsw"):
        compiled(text)
