# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The file of a script: YAML, every error with its line and field."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Literal, NamedTuple, Self

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator

from teo_synthetic_signer.body.body_data import data_folder
from teo_synthetic_signer.body.hand import (
    FINGERS,
    HAND_SHAPES,
    OTHER_HAND,
    POINTS,
    THUMBS,
    HandShape,
    hand_thumb,
)
from teo_synthetic_signer.body.rig import PLACES
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.script.keys import ArmKey, Key, Swing, Vector
from teo_synthetic_signer.script.scripts import HANGING, about, script
from teo_synthetic_signer.yaml_lines import YamlLines

_STRICT = ConfigDict(strict=True, extra="forbid", frozen=True)
# Palm and fingers nearer to one line than 5 deg do not say how the hand is turned.
_MOST_OBLIQUE = math.cos(math.radians(5.0))


def _one_of(*names: str) -> AfterValidator:
    def check(value: str) -> str:
        if value not in names:
            raise ValueError(f"expected one of {', '.join(names)}; got {value!r}")
        return value

    return AfterValidator(check)


def _not_zero(value: tuple[float, float, float]) -> tuple[float, float, float]:
    if math.hypot(*value) < 1e-6:
        raise ValueError(f"expected a direction, got {list(value)}")
    return value


def _face(value: dict[str, float]) -> dict[str, float]:
    folder = data_folder() / "faceunits01/targets/faceunits"
    for name, strength in value.items():
        if not (folder / f"{name}.target").is_file():
            known = ", ".join(sorted(file.stem for file in folder.glob("*.target")))
            raise ValueError(f"expected facial actions of {known}; got {name!r}")
        if not 0.0 <= strength <= 1.0:
            raise ValueError(f"expected a strength of 0 to 1 for {name}, got {strength:g}")
    return value


_Number = Annotated[float, Field(allow_inf_nan=False)]
_Metres = Annotated[float, Field(ge=-2.0, le=2.0)]
_Bend = Annotated[float, Field(ge=-40.0, le=130.0)]
_Spread = Annotated[float, Field(ge=-40.0, le=40.0)]
_Seconds = Annotated[float, Field(ge=0.0, le=60.0)]
_Way = Annotated[tuple[_Number, _Number, _Number], Field(strict=False), AfterValidator(_not_zero)]
_Bends = Annotated[tuple[_Bend, _Bend, _Bend], Field(strict=False)]


class ThumbText(BaseModel):
    """A thumb in full."""

    model_config = _STRICT

    points: _Way = Field(
        description="Where its metacarpal points: along the fingers, out of the palm, thumbwards."
    )
    bends: _Way = Field(description="Towards where it bends, likewise.")
    flexion: Annotated[tuple[_Bend, _Bend], Field(strict=False)] = Field(
        description="Of its two outer joints [deg]."
    )


class ShapeText(BaseModel):
    """A hand shape in full."""

    model_config = _STRICT

    index: _Bends = Field(description="Flexion of knuckle, middle and last joint; 0 is straight [deg].")
    middle: _Bends
    ring: _Bends
    little: _Bends
    spread: Annotated[tuple[_Spread, _Spread, _Spread, _Spread], Field(strict=False)] = Field(
        (2.0, 0.0, -2.0, -5.0), description="Of index to little finger towards the thumb [deg]."
    )
    thumb: Annotated[str, _one_of(*THUMBS)] | ThumbText = Field(description="By name or in full.")

    thumb_bent: _Bend = Field(0.0, description="By how much its two outer joints are bent further [deg].")

    def shape(self) -> HandShape:
        """Give the shape."""
        thumb = self.thumb
        if isinstance(thumb, str):
            ways, angles = hand_thumb(thumb)
        else:
            ways, angles = np.array([thumb.points, thumb.bends]), np.radians(thumb.flexion)
        flexion = np.radians([getattr(self, finger) for finger in FINGERS])
        return HandShape(
            flexion,
            np.radians(np.array(self.spread, dtype=float)),
            ways,
            angles + math.radians(self.thumb_bent),
        )


class SwingText(BaseModel):
    """By how much joints are turned after the hand is there [deg]."""

    model_config = _STRICT

    wrist: Annotated[float, Field(ge=-60.0, le=60.0)] = Field(0.0, description="To the thumb's side.")
    forearm: Annotated[float, Field(ge=-120.0, le=120.0)] = Field(0.0, description="The palm upwards.")
    elbow: Annotated[float, Field(ge=-90.0, le=90.0)] = Field(0.0, description="Stretched.")


class ArmText(BaseModel):
    """Where an arm goes; see `ArmKey`."""

    model_config = _STRICT

    at: Annotated[str, _one_of(*PLACES, *OTHER_HAND)]
    offset: Annotated[tuple[_Metres, _Metres, _Metres], Field(strict=False)] = (0.0, 0.0, 0.0)
    point: Annotated[str, _one_of(*POINTS)] = "palm"
    fingers: _Way
    palm: _Way
    shape: Annotated[str, _one_of(*HAND_SHAPES)] | ShapeText
    swing: SwingText | None = None
    swivel: Annotated[float, Field(ge=-90.0, le=90.0)] = Field(
        0.0, description="Elbow outwards and up [deg]."
    )

    @model_validator(mode="after")
    def _palm_is_across(self) -> Self:
        cosine = abs(np.dot(self.fingers, self.palm)) / math.hypot(*self.fingers) / math.hypot(*self.palm)
        if cosine > _MOST_OBLIQUE:
            raise ValueError(
                "expected a palm that faces across the fingers; got both along one line: "
                f"fingers {list(self.fingers)}, palm {list(self.palm)}"
            )
        return self

    def key(self) -> ArmKey:
        """Give what it says."""
        swing = dict(self.swing) if self.swing else {}
        return ArmKey(
            at=self.at,
            offset=self.offset,
            point=self.point,
            fingers=self.fingers,
            palm=self.palm,
            shape=self.shape if isinstance(self.shape, str) else self.shape.shape(),
            swing=Swing(**{joint: math.radians(angle) for joint, angle in swing.items()}),
            swivel=math.radians(self.swivel),
        )


_Hanging = Literal["hanging"]
_Angle = Annotated[float, Field(ge=-90.0, le=90.0)]
_Angles = Annotated[tuple[_Angle, _Angle, _Angle], Field(strict=False)]


class KeyText(BaseModel):
    """One key pose; see `Key`. What arms, head, trunk and face do stays until said otherwise."""

    model_config = _STRICT

    right: ArmText | _Hanging | None = None
    left: ArmText | _Hanging | None = None
    move: Annotated[float, Field(gt=0.0, le=60.0)] = 0.45
    hold: _Seconds = 0.0
    bulge: Annotated[tuple[_Metres, _Metres, _Metres], Field(strict=False)] = (0.0, 0.0, 0.0)
    through: bool = False
    head: _Angles | None = Field(None, description="Turned left, bowed, tilted left [deg].")
    lean: _Angles | None = Field(None, description="Of the trunk: forwards, left, turned left [deg].")
    face: Annotated[dict[str, float], AfterValidator(_face)] | None = None

    @model_validator(mode="after")
    def _goes_on(self) -> Self:
        if self.through and (self.hold or any(self.bulge)):
            raise ValueError("expected neither hold nor bulge where hands go through")
        return self

    def key(self, before: Key, hanging: ArmKey) -> Key:
        """Give what it says after another key."""

        def arm(text: ArmText | str | None) -> ArmKey | None:
            return text.key() if isinstance(text, ArmText) else hanging if text else None

        def angles(text: tuple[float, float, float] | None, kept: Vector) -> Vector:
            return (
                kept
                if text is None
                else (math.radians(text[0]), math.radians(text[1]), math.radians(text[2]))
            )

        return Key(
            right=arm(self.right),
            left=arm(self.left),
            move=self.move,
            hold=self.hold,
            arc=0.0,
            bulge=self.bulge,
            through=self.through,
            head=angles(self.head, before.head),
            lean=angles(self.lean, before.lean),
            face=before.face if self.face is None else self.face,
            keep_out=True,
        )


class RepeatText(BaseModel):
    """Keys that are played again."""

    model_config = _STRICT

    times: int = Field(ge=2, le=100, description="How often in all.")
    keys: list[KeyText] = Field(min_length=1)


class ScriptText(BaseModel):
    """A script."""

    model_config = _STRICT

    about: Annotated[str, Field(min_length=1, max_length=500)] = Field(description="What happens.")
    keys: list[KeyText | RepeatText] = Field(min_length=2, max_length=2000)


# By which a script's file is told from a script's name.
_SUFFIXES = (".yaml", ".yml")
# A minute of signing is 50 kB; this is no script.
_MOST_BYTES = 2_000_000
# Codes of files that are none, of scripts.
_CODES = {
    "unreadable": "unreadable_script",
    "too_large": "script_too_large",
    "not_utf8": "not_yaml",
    "no_fields": "bad_script",
}
# [s] Of a script: 18,000 frames take 40 min to render.
_LONGEST = 600.0
# What pydantic puts between the fields of a path where a field can be of several kinds.
_UNIONS = ("ArmText", "ShapeText", "KeyText", "RepeatText", "ThumbText", "str", "literal['hanging']")


class Script(NamedTuple):
    """A script from a file."""

    keys: tuple[Key, ...]
    about: str


def script_of(name: str) -> Script:
    """Give a script by its name, or from its file if that ends as files of scripts do.

    Raises:
        SyntheticError: As `script` or `read_script`.
    """
    if name.lower().endswith(_SUFFIXES):
        return read_script(Path(name))
    return Script(script(name), about(name))


def read_script(path: Path) -> Script:
    """Read and check a script.

    Raises:
        SyntheticError: "unreadable_script", "script_too_large", "not_yaml", "bad_script"; the message begins
            with file and line and names the field.
    """
    try:
        lines = YamlLines(path, most_bytes=_MOST_BYTES, fields="fields such as 'keys:'")
    except SyntheticError as error:
        raise SyntheticError(_CODES.get(error.code, error.code), error.sentence) from error
    try:
        text = ScriptText.model_validate(lines.content)
    except ValidationError as error:
        raise _refusal(lines, *_first_error(error)) from error
    flat = _flattened(text.keys)
    for side in ("right", "left"):
        if getattr(flat[0], side) is None:
            raise _refusal(lines, ["keys", 0], f"the first key to say where the {side} arm is")
    keys: list[Key] = []
    for key in flat:
        keys.append(key.key(keys[-1] if keys else Key(), HANGING))
    duration = sum(key.move + key.hold for key in keys)
    if duration > _LONGEST:
        raise _refusal(lines, ["keys"], f"a script of at most {_LONGEST:g} s, got {duration:.0f} s")
    return Script(tuple(keys), text.about)


def _flattened(keys: list[KeyText | RepeatText]) -> list[KeyText]:
    flat: list[KeyText] = []
    for key in keys:
        flat += key.keys * key.times if isinstance(key, RepeatText) else [key]
    return flat


def _first_error(error: ValidationError) -> tuple[list[int | str], str]:
    """Choose the error that is deepest in the text: where a field can be of kinds, of the nearest one."""
    found = []
    for one in error.errors():
        where = [part for part in one["loc"] if part not in _UNIONS and "[" not in str(part)]
        expected = str(one["msg"]).removeprefix("Value error, ")
        if isinstance(one["input"], (str, int, float)) and "got" not in expected:
            expected = f"{expected}; got {one['input']!r}"
        found.append((where, expected))
    return max(found, key=lambda one: len(one[0]))


def _refusal(lines: YamlLines, where: list[int | str], expected: str) -> SyntheticError:
    field = ".".join(map(str, where)) or "script"
    return SyntheticError("bad_script", f"{lines.place(where)}: {field}: {expected}")
