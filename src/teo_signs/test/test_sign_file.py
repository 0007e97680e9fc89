# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""An entry's file: what is written is read back, and whatever is wrong is refused with its reason."""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from teo_names import COMMANDED_JOINTS, description_hash, joint_limits
from teo_signs.sign import Sign, sign_warnings, with_alternatives
from teo_signs.sign_file import MAX_FILE_BYTES, format_sign, parse_sign, read_sign, save_sign
from teo_signs.sign_schema import Provenance, sign_json_schema

PACKAGE = Path(__file__).resolve().parent.parent


def entry() -> dict[str, Any]:
    return {
        "schema": 1,
        "gloss": "TÚ",
        "language": "ssp",
        "kind": "lexical",
        "handedness": "right",
        "joints": ["FrontalRightElbow", "RightIndexFinger"],
        "times": [0.0, 0.5],
        "knots": [[-0.5, 0.2], [-1.0, 0.2]],
        "provenance": {
            "standing": "recorded",
            "source": "made up",
            "method": "by hand",
            "recorded": None,
            "created": "2025-01-01",
            "licence": "Apache-2.0",
            "description_hash": description_hash(),
            "notes": "",
        },
        "quality": {"error_mm": 3.5},
    }


def parse(content: object) -> Sign:
    return parse_sign(content if isinstance(content, str | bytes) else json.dumps(content), file="TÚ.json")


def test_a_good_entry_is_read_as_it_says() -> None:
    sign = parse(entry())
    assert (sign.gloss, sign.kind, sign.handedness) == ("TÚ", "lexical", "right")
    assert sign.joints == ("FrontalRightElbow", "RightIndexFinger")
    np.testing.assert_array_equal(sign.knots, [[-0.5, 0.2], [-1.0, 0.2]])
    assert sign.duration == 0.5
    assert sign.provenance.licence == "Apache-2.0"
    assert sign.quality == {"error_mm": 3.5}
    assert not sign.forms
    assert not sign.alternatives
    assert "forms" not in format_sign(sign)
    for array in (sign.knots, sign.times):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
    # The same name in another Unicode form.
    assert parse_sign(json.dumps(entry()), file=unicodedata.normalize("NFD", "TÚ.json")).gloss == "TÚ"


def test_a_sign_may_have_a_single_knot_and_be_on_a_limit() -> None:
    lower = float(joint_limits(("FrontalRightElbow",)).lower[0])
    for value in (lower, round(lower, 6)):
        assert parse(entry() | {"times": [0], "knots": [[value, 0.2]]}).duration == 0.0


WRONG = [
    ("not_json", "", lambda c: json.dumps(c)[:150]),
    ("not_json", "", lambda _: "[" * 100_000),
    ("not_json", "", lambda c: json.dumps(c).replace("0.5", "9" * 5000, 1)),
    ("not_utf8", "", lambda _: b'{"gloss": "T\xda"}'),
    ("empty_file", "", lambda _: ""),
    ("too_large", "", lambda _: " " * (MAX_FILE_BYTES + 1)),
    ("not_an_object", "", lambda _: "[1, 2]"),
    ("non_finite", "", lambda c: json.dumps(c).replace("-0.5", "NaN", 1)),
    ("non_finite", "knots[0][0]", lambda c: json.dumps(c).replace("-0.5", "1e999", 1)),
    ("duplicate_field", "gloss", lambda c: json.dumps(c).replace('"gloss"', '"gloss": "A", "gloss"', 1)),
    ("missing_field", "knots", lambda c: c.__delitem__("knots")),
    ("unknown_field", "speed", lambda c: c.update(speed=2)),
    ("unknown_field", "provenance.author", lambda c: c["provenance"].update(author="x")),
    ("unsupported_schema", "schema", lambda c: c.update(schema=2)),
    ("unsupported_schema", "schema", lambda c: c.update(schema=True)),
    ("gloss_mismatch", "gloss", lambda c: c.update(gloss="TU")),
    ("bad_value", "gloss", lambda c: c.update(gloss="tú")),
    ("bad_value", "gloss", lambda c: c.update(gloss=unicodedata.normalize("NFD", "TÚ"))),
    ("bad_value", "gloss", lambda c: c.update(gloss="../TÚ")),
    ("bad_value", "gloss", lambda c: c.update(gloss="A" * 61)),
    ("bad_value", "language", lambda c: c.update(language="Spanish")),
    ("bad_value", "joints", lambda c: c.update(joints=[])),
    ("unknown_joint", "joints[1]", lambda c: c.update(joints=["FrontalRightElbow", "RightElbow"])),
    ("duplicate_joint", "joints[1]", lambda c: c.update(joints=["FrontalRightElbow", "FrontalRightElbow"])),
    ("bad_value", "times", lambda c: c.update(times=[])),
    ("bad_start", "times[0]", lambda c: c.update(times=[0.1, 0.5])),
    ("times_not_increasing", "times[1]", lambda c: c.update(times=[0.0, 0.0])),
    ("bad_type", "times[1]", lambda c: c.update(times=[0.0, "0.5"])),
    ("bad_type", "times[1]", lambda c: c.update(times=[0.0, True])),
    ("bad_value", "knots", lambda c: c.update(knots=[])),
    ("wrong_length", "knots", lambda c: c.update(knots=[[-0.5, 0.2]])),
    ("wrong_length", "knots[1]", lambda c: c.update(knots=[[-0.5, 0.2], [-1.0]])),
    ("wrong_length", "alternatives[0]", lambda c: c.update(alternatives=[[[-0.5, 0.2]]])),
    ("outside_limits", "alternatives[0][0][0]", lambda c: c.update(alternatives=[[[9.0, 0.2]] * 2])),
    ("bad_value", "alternatives", lambda c: c.update(alternatives=[c["knots"]] * 17)),
    ("outside_limits", "knots[1][0]", lambda c: c.update(knots=[[-0.5, 0.2], [-2.0, 0.2]])),
    ("bad_value", "provenance.created", lambda c: c["provenance"].update(created="2025-02-30")),
    ("bad_value", "provenance.description_hash", lambda c: c["provenance"].update(description_hash="abc")),
    ("bad_type", "quality.error_mm", lambda c: c["quality"].update(error_mm="small")),
]


@pytest.mark.parametrize(("code", "field", "spoil"), WRONG)
def test_a_spoiled_entry_is_refused_with_file_field_and_reason(
    code: str, field: str, spoil: Callable[[dict[str, Any]], object]
) -> None:
    content = entry()
    spoiled = spoil(content)
    with refused(code) as caught:
        parse(spoiled if isinstance(spoiled, str | bytes) else content)
    error = caught.value
    assert str(error).startswith(f"TÚ.json: {field}: expected " if field else "TÚ.json: expected ")
    assert ", got " in str(error)
    assert len(str(error)) < 1000
    if code == "unknown_joint":
        assert all(joint in str(error) for joint in COMMANDED_JOINTS)


def test_a_file_that_cannot_be_read_says_so(tmp_path: Path) -> None:
    with refused("unreadable"):
        read_sign(tmp_path / "NADA.json")
    (tmp_path / "X.json").mkdir()
    with refused("unreadable"):
        read_sign(tmp_path / "X.json")


def made(knots: np.ndarray, times: np.ndarray, joints: tuple[str, ...], gloss: str = "TÚ") -> Sign:
    return Sign(
        gloss=gloss,
        language="ssp",
        kind="letter",
        handedness="right",
        joints=joints,
        times=times,
        knots=knots,
        provenance=Provenance(**entry()["provenance"]),
        quality={"palm_angle_error_deg": 1.5},
    )


@given(data=st.data())
def test_what_is_written_is_read_back_to_a_microradian(data: st.DataObject) -> None:
    joints = tuple(data.draw(st.lists(st.sampled_from(COMMANDED_JOINTS), min_size=1, unique=True)))
    limits = joint_limits(joints)
    count = data.draw(st.integers(1, 5))
    share = np.array(
        data.draw(st.lists(st.floats(0, 1), min_size=count * len(joints), max_size=count * len(joints)))
    )
    ratio = share.reshape(count, len(joints))
    knots = np.clip(limits.lower + ratio * (limits.upper - limits.lower), limits.lower, limits.upper)
    steps = data.draw(st.lists(st.floats(0.001, 5.0), min_size=count - 1, max_size=count - 1))
    times = np.concatenate([[0.0], np.cumsum(steps)])
    sign = made(knots, times, joints)
    again = parse(format_sign(sign))
    assert again.joints == joints
    np.testing.assert_allclose(again.knots, knots, atol=1.1e-6)
    assert ((again.knots >= limits.lower) & (again.knots <= limits.upper)).all()
    np.testing.assert_allclose(again.times, times, atol=5.1e-7)
    assert again.provenance == sign.provenance
    assert format_sign(again) == format_sign(sign)


def test_a_saved_sign_is_in_the_table_whole_and_alone(tmp_path: Path) -> None:
    path = save_sign(tmp_path / "new", parse(entry()))
    assert list((tmp_path / "new").iterdir()) == [path] == [tmp_path / "new" / "TÚ.json"]
    assert read_sign(path).pose(1) == {"FrontalRightElbow": -1.0, "RightIndexFinger": 0.2}


def with_another_posture() -> Sign:
    other = np.array([[-0.4, 0.3], [-0.9, 0.3]])
    return with_alternatives(parse(entry()), (other,))


def test_alternatives_are_kept_and_an_entry_without_them_has_none(tmp_path: Path) -> None:
    kept = read_sign(save_sign(tmp_path, with_another_posture()))
    np.testing.assert_array_equal(kept.alternatives[0], [[-0.4, 0.3], [-0.9, 0.3]])
    assert not kept.alternatives[0].flags.writeable
    assert sign_warnings(kept) == sign_warnings(parse(entry()))


@pytest.mark.parametrize(
    ("field", "changed"),
    [
        ("knots", [[-0.5, 0.2], [-1.0, 0.200001]]),
        ("times", [0.0, 0.9]),
        ("joints", ["FrontalRightElbow", "RightMiddleFinger"]),
        ("alternatives_of", "0" * 64),
        ("alternatives_of", ""),
    ],
)
def test_alternatives_of_a_sign_that_changed_since_are_not_used_and_named(
    field: str, changed: object
) -> None:
    content = json.loads(format_sign(with_another_posture()))
    assert content[field] != changed
    sign = parse(content | {field: changed})
    assert sign.alternatives == ()
    (named,) = [warning for warning in sign_warnings(sign) if "alternatives_of" in warning]
    assert "lut ease TÚ" in named


def test_an_entry_is_not_replaced_unless_told(tmp_path: Path) -> None:
    sign = parse(entry())
    save_sign(tmp_path, sign)
    with refused("exists"):
        save_sign(tmp_path, sign)
    save_sign(tmp_path, sign, replace=True)


@pytest.mark.parametrize(
    ("code", "knots", "gloss"),
    [("outside_limits", [[9.0]], "TÚ"), ("non_finite", [[np.nan]], "TÚ"), ("bad_value", [[0.0]], "a/b")],
)
def test_what_could_not_be_read_back_is_not_written(
    tmp_path: Path, code: str, knots: list[list[float]], gloss: str
) -> None:
    sign = made(np.array(knots), np.zeros(1), ("FrontalRightElbow",), gloss)
    with refused(code):
        save_sign(tmp_path, sign)
    assert list(tmp_path.iterdir()) == []


def test_a_failed_write_leaves_the_old_entry(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sign = parse(entry())
    path = save_sign(tmp_path, sign)
    before = path.read_bytes()

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OSError, match="No space left"):
        save_sign(tmp_path, sign, replace=True)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_the_published_schema_is_the_one_in_use() -> None:
    published = json.loads((PACKAGE / "sign.schema.json").read_text(encoding="utf-8"))
    assert published == sign_json_schema(), "write it anew: ros2 run teo_lut_executor lut schema"


def with_forms() -> dict[str, Any]:
    content = entry()
    content["forms"] = {
        "2>1": {"times": [0.0, 0.4, 0.6], "knots": [[-0.6, 0.2], [-1.0, 0.2], [-1.2, 0.2]]},
        "CABEZA": {"times": [0.0], "knots": [[-0.7, 0.2]]},
    }
    return content


def test_forms_are_read_and_written_again() -> None:
    sign = parse(with_forms())
    assert sign.inflected("2>1").times.tolist() == [0.0, 0.4, 0.6]
    assert sign.inflected("2>1").knots[-1].tolist() == [-1.2, 0.2]
    assert sign.inflected("") is sign and sign.inflected("1>2") is sign
    again = parse(format_sign(sign))
    assert list(again.forms) == ["2>1", "CABEZA"]
    np.testing.assert_array_equal(again.forms["2>1"].knots, sign.forms["2>1"].knots)
    assert format_sign(again) == format_sign(sign)
    assert not again.forms["CABEZA"].knots.flags.writeable


@pytest.mark.parametrize(
    ("change", "code", "field"),
    [
        (lambda forms: forms["2>1"]["times"].__setitem__(0, 0.1), "bad_start", "forms.2>1.times[0]"),
        (lambda forms: forms["CABEZA"]["knots"][0].pop(), "wrong_length", "forms.CABEZA.knots[0]"),
        (lambda forms: forms.__setitem__("to me", forms.pop("2>1")), "bad_value", "forms"),
        (lambda forms: forms["2>1"].pop("times"), "missing_field", "forms.2>1.times"),
    ],
)
def test_a_bad_form_is_refused_by_its_name(change: Callable[[Any], object], code: str, field: str) -> None:
    content = with_forms()
    change(content["forms"])
    with refused(code, re.escape(field)):
        parse(content)
