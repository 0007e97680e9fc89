# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from teo_skeleton_retriever.detectors.openpose_files import parse_frame, read_frame
from teo_skeleton_retriever.errors import RetrieverError

# As OpenPose 1.7 writes one person without hands and face.
WRITTEN_BY_OPENPOSE = """{"version":1.3,"people":[{"person_id":[-1],"pose_keypoints_2d":[BODY],
"face_keypoints_2d":[],"hand_left_keypoints_2d":[],"hand_right_keypoints_2d":[],"pose_keypoints_3d":[],
"face_keypoints_3d":[],"hand_left_keypoints_3d":[],"hand_right_keypoints_3d":[]}]}""".replace(
    "BODY", ",".join(["582.349,507.866,0.845918"] + ["0,0,0"] * 24)
)


def person(**parts: Any) -> str:
    return json.dumps({"version": 1.3, "people": [parts]})


def test_reads_what_openpose_writes() -> None:
    frame = parse_frame(WRITTEN_BY_OPENPOSE)
    assert len(frame) == 1
    assert frame[0].body[0].tolist() == [582.349, 507.866, 0.845918]
    assert len(frame[0].face) == len(frame[0].left_hand) == 0


@pytest.mark.parametrize(
    ("version", "body", "others"),
    [
        (0.1, "body_parts", None),
        (0.1, "pose_keypoints", None),
        (1.0, "pose_keypoints", "{}_keypoints"),
        (1.1, "pose_keypoints", "{}_keypoints"),
        (1.2, "pose_keypoints_2d", "{}_keypoints_2d"),
        (1.3, "pose_keypoints_2d", "{}_keypoints_2d"),
    ],
)
def test_reads_every_version_by_its_own_names(version: float, body: str, others: str | None) -> None:
    entry: dict[str, Any] = {body: [1, 2, 0.5] * 18}
    sizes = {"hand_left": 21, "hand_right": 21, "face": 70} if others else {}
    for x, (part, size) in enumerate(sizes.items(), start=3):
        entry[str(others).format(part)] = [x, 4, 0.5] * size
    first, person = parse_frame(json.dumps({"version": version, "people": [entry, entry]}))
    assert first.body.tolist() == person.body.tolist() == [[1, 2, 0.5]] * 18
    parts = zip(sizes.values(), (person.left_hand, person.right_hand, person.face), strict=False)
    for x, (size, part) in enumerate(parts, start=3):
        assert part.tolist() == [[x, 4, 0.5]] * size
    assert len(person.left_hand) == (21 if others else 0)


@pytest.mark.parametrize(
    ("content", "people"),
    [
        (WRITTEN_BY_OPENPOSE.replace("\n", "\r\n").encode("utf-8-sig"), 1),
        ('{"version":1.1,"people":[],"part_candidates":[{"0":[1,2,0.5]}]}', 0),
        (person(person_id=[7], pose_keypoints_3d=[1, 2, 3, 1] * 25), 1),
    ],
    ids=["from Windows", "with candidates", "in 3D"],
)
def test_what_is_not_used_does_not_matter(content: bytes | str, people: int) -> None:
    assert len(parse_frame(content)) == people


@given(st.integers(0, len(WRITTEN_BY_OPENPOSE) - 1))
@settings(max_examples=60)
def test_a_file_cut_anywhere_is_refused(length: int) -> None:
    with refused("not_json"):
        parse_frame(WRITTEN_BY_OPENPOSE[:length])


@given(st.binary(max_size=200))
@settings(max_examples=60)
def test_noise_is_refused_and_never_another_exception(noise: bytes) -> None:
    with pytest.raises(RetrieverError) as caught:
        parse_frame(noise)
    assert caught.value.code in {"not_text", "not_json", "not_an_object", "no_people"}


@pytest.mark.parametrize(
    ("content", "code"),
    [
        ("", "not_json"),
        ("[" * 100_000, "not_json"),
        ("[]", "not_an_object"),
        ("{}", "no_people"),
        ('{"version":1.3,"people":{}}', "no_people"),
        ('{"version":2.0,"people":[]}', "unknown_version"),
        ('{"version":true,"people":[]}', "unknown_version"),
        ('{"version":1.3,"people":[7]}', "not_a_person"),
        (person(pose_keypoints_2d="1,2,3"), "not_a_list"),
        (person(pose_keypoints_2d=None), "not_a_list"),
        (person(pose_keypoints_2d=[1, 2, "3"]), "not_numbers"),
        (person(pose_keypoints_2d=[1, 2]), "wrong_length"),
        (person(pose_keypoints_2d=[1, 2, 3] * 24), "wrong_shape"),
        (person(hand_left_keypoints_2d=[1, 2, 3] * 20), "wrong_shape"),
        (person(pose_keypoints_2d=[float("nan"), 2, 3] * 25), "not_finite"),
        (person(pose_keypoints_2d=[10**400, 2, 3] * 25), "not_finite"),
    ],
)
def test_what_openpose_does_not_write_is_refused_with_its_reason_file_and_place(
    tmp_path: Path, content: str, code: str
) -> None:
    path = tmp_path / "7_keypoints.json"
    path.write_text(content)
    with refused(code, r"7_keypoints\.json: "):
        read_frame(path)
