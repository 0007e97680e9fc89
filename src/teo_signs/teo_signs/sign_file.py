# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The file of a sign: read with every check, written whole or not at all."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from types import MappingProxyType
from typing import Any, NoReturn

import msgspec
import numpy as np
from numpy.typing import NDArray

from teo_common.atomic_files import write_atomically
from teo_common.checked_content import ContentError, converted
from teo_description.errors import DescriptionError
from teo_description.humanoid import Humanoid, load_humanoid
from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, load_language
from teo_signs.errors import LutError
from teo_signs.sign import (
    DECIMALS,
    Form,
    Sign,
    gloss_key,
    with_alternatives_in_force,
    with_standing_in_force,
)
from teo_signs.sign_schema import (
    DEFAULT_ROBOT,
    SCHEMA_VERSION,
    FormFile,
    SignFile,
    check_date,
    check_gloss,
)

# 28 joints at 25 frames a second for a minute are 0.8 MB of text; no sign is longer than that.
MAX_FILE_BYTES = 1_000_000

# A knot on a limit that another program rounded may be beyond it by half a digit.
LIMIT_TOLERANCE = 1e-6


def parse_sign(text: str | bytes, *, file: str | Path) -> Sign:
    """Read and check one entry.

    Args:
        text: Content of the file.
        file: Its name: the stem must be the gloss, and every message begins with it.

    Returns:
        The sign, with read-only arrays. A review of another motion than the entry's leaves the standing
        before it in force, alternatives of another motion are left out; `sign_warnings` says so.

    Raises:
        LutError: The entry is not a good one; the message names file, field, expected and got.
    """
    content = _Reader(Path(file)).read(text)
    forms = {
        inflection: Form(times=_array(form.times), knots=_array(form.knots))
        for inflection, form in content.forms.items()
    }
    sign = Sign(
        gloss=content.gloss,
        language=content.language,
        kind=content.kind,
        handedness=content.handedness,
        joints=tuple(content.joints),
        times=_array(content.times),
        knots=_array(content.knots),
        provenance=content.provenance,
        quality=MappingProxyType(dict(content.quality)),
        forms=MappingProxyType(forms),
        alternatives=tuple(_array(other) for other in content.alternatives),
        alternatives_of=content.alternatives_of,
        robot=content.robot,
    )
    return with_standing_in_force(with_alternatives_in_force(sign))


def read_sign(path: Path) -> Sign:
    """Read and check one entry from its file.

    Raises:
        LutError: The file cannot be read or is not a good entry.
    """
    try:
        with path.open("rb") as file:
            # One byte more than allowed tells a file that is too large without reading it all.
            return parse_sign(file.read(MAX_FILE_BYTES + 1), file=path)
    except OSError as error:
        reason = error.strerror or str(error)
        raise LutError("unreadable", f"{path.name}: expected a file to read, got: {reason}") from error


def format_sign(sign: Sign) -> str:
    """The text of a sign's file: fields in the order of the schema, a line for each knot."""
    head: dict[str, Any] = {
        "schema": SCHEMA_VERSION,
        "gloss": sign.gloss,
        "language": sign.language,
        "robot": sign.robot,
        "kind": sign.kind,
        "handedness": sign.handedness,
        "joints": list(sign.joints),
        "times": np.round(sign.times, DECIMALS).tolist(),
    }
    lines = [f'  "{key}": {_json(value)}' for key, value in head.items()]
    lines.append(_block("knots", "[]", [_json(row) for row in _rounded_within(sign, sign.knots).tolist()]))
    if sign.forms:
        forms = [f"{_json(inflection)}: {_form(sign, form)}" for inflection, form in sign.forms.items()]
        lines.append(_block("forms", "{}", forms))
    if sign.alternatives:
        others = [_json(_rounded_within(sign, other).tolist()) for other in sign.alternatives]
        lines.append(_block("alternatives", "[]", others))
        lines.append(f'  "alternatives_of": {_json(sign.alternatives_of)}')
    provenance = msgspec.to_builtins(sign.provenance)
    if sign.provenance.review is None:
        del provenance["review"]
    for key, fields in (("provenance", provenance), ("quality", dict(sign.quality))):
        lines.append(_block(key, "{}", [f"{_json(name)}: {_json(value)}" for name, value in fields.items()]))
    return "{\n" + ",\n".join(lines) + "\n}\n"


def save_sign(directory: Path, sign: Sign, *, replace: bool = False) -> Path:
    """Write a sign into a table, whole or not at all; what would not be read back is not written.

    Args:
        directory: Directory of the table; made if it is not there.
        sign: The sign.
        replace: Whether an entry of that name may be replaced.

    Returns:
        The file written.

    Raises:
        LutError: The sign is not a good one ("outside_limits", ...), is there already ("exists"), or of
            another language or robot than the table's ("other_language", "other_robot").
        OSError: The directory cannot be written.
    """
    path = directory / f"{gloss_key(sign.gloss)}.json"
    try:
        text = format_sign(sign)
    except ValueError as error:  # NaN and infinity have no JSON
        raise LutError("non_finite", f"{path.name}: expected finite numbers, got: {error}") from error
    text = format_sign(parse_sign(text, file=path))  # as it will be read: with the standing in force
    if not replace and path.exists():
        message = f"{path.name}: expected a gloss that {directory} does not hold, got {sign.gloss!r}"
        raise LutError("exists", message)
    _refuse_mixed(sign, path)
    directory.mkdir(parents=True, exist_ok=True)
    write_atomically(path, text.encode("utf-8"))
    return path


class _Reader:
    """Reads one file; every check that fails names it."""

    def __init__(self, file: Path) -> None:
        self._name = file.name
        self._stem = gloss_key(file.stem)

    def read(self, text: str | bytes) -> SignFile:
        content = self._check_fields(self._load_json(text))
        self._check_names(content)
        self._humanoid = _humanoid(content.robot, self._name)
        self._check_joints(content.joints)
        self._check_motion(content.joints, content, "")
        for inflection, form in content.forms.items():
            self._check_motion(content.joints, form, f"forms.{inflection}.")
        for index, other in enumerate(content.alternatives):
            self._check_rows(content.joints, content.times, other, f"alternatives[{index}]")
        for name, value in content.quality.items():
            self._check_finite(f"quality.{name}", value)
        return content

    def _check_motion(self, joints: list[str], motion: SignFile | FormFile, field: str) -> None:
        self._check_times(motion.times, field)
        self._check_rows(joints, motion.times, motion.knots, f"{field}knots")

    def _refuse(self, code: str, field: str, expected: str, got: str) -> NoReturn:
        place = f"{self._name}: {field}" if field else self._name
        raise LutError(code, f"{place}: expected {expected}, got {got}")

    def _load_json(self, text: str | bytes) -> dict[str, Any]:
        if len(text) > MAX_FILE_BYTES:
            self._refuse("too_large", "", f"at most {MAX_FILE_BYTES} bytes", "more")
        if not text.strip():
            self._refuse("empty_file", "", "a JSON object", "nothing")
        try:
            if isinstance(text, bytes):
                text = text.decode("utf-8")
            content = json.loads(text, object_pairs_hook=self._fields, parse_constant=self._constant)
        except UnicodeDecodeError as error:
            byte = error.object[error.start]
            self._refuse("not_utf8", "", "UTF-8 text", f"byte 0x{byte:02x} at offset {error.start}")
        except json.JSONDecodeError as error:
            self._refuse("not_json", "", "JSON", f"line {error.lineno}, column {error.colno}: {error.msg}")
        except (RecursionError, ValueError) as error:  # nested without end, a number of thousands of digits
            self._refuse("not_json", "", "JSON of a sign", str(error))
        if not isinstance(content, dict):
            self._refuse("not_an_object", "", "a JSON object", _short(content))
        return content

    def _fields(self, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for key, value in pairs:
            if key in found:
                self._refuse("duplicate_field", key, "each field once", "it twice")
            found[key] = value
        return found

    def _constant(self, word: str) -> NoReturn:
        self._refuse("non_finite", "", "finite numbers", word)

    def _check_fields(self, content: dict[str, Any]) -> SignFile:
        version = content.get("schema", SCHEMA_VERSION)
        if type(version) is not int or version != SCHEMA_VERSION:
            self._refuse("unsupported_schema", "schema", f"{SCHEMA_VERSION}", _short(version))
        try:
            return converted(content, SignFile)
        except ContentError as error:
            steps = (f"[{step}]" if isinstance(step, int) else f".{step}" for step in error.way)
            self._refuse(error.code, "".join(steps)[1:], error.expected, error.got)

    def _check_names(self, content: SignFile) -> None:
        """What of its texts a pattern cannot say."""
        self._check_text("gloss", content.gloss, check_gloss)
        if content.gloss != self._stem:
            self._refuse("gloss_mismatch", "gloss", f"{self._stem!r}, the file's name", repr(content.gloss))
        provenance = content.provenance
        self._check_text("provenance.created", provenance.created, check_date)
        if provenance.recorded is not None:
            self._check_text("provenance.recorded", provenance.recorded, check_date)
        if provenance.review is not None:
            self._check_text("provenance.review.reviewed", provenance.review.reviewed, check_date)

    def _check_text(self, field: str, text: str, check: Callable[[str], None]) -> None:
        try:
            check(text)
        except ValueError as error:
            self._refuse("bad_value", field, str(error), _short(text))

    def _check_finite(self, field: str, value: float) -> None:
        """Refuse what JSON has as a number and a float has not, such as 1e999."""
        if not math.isfinite(value):
            self._refuse("non_finite", field, "a finite number", _short(value))

    def _check_joints(self, joints: list[str]) -> None:
        seen: set[str] = set()
        for index, joint in enumerate(joints):
            if joint not in self._humanoid.commanded_joints:
                names = ", ".join(self._humanoid.commanded_joints)
                self._refuse("unknown_joint", f"joints[{index}]", f"one of {names}", repr(joint))
            if joint in seen:
                self._refuse("duplicate_joint", f"joints[{index}]", "each joint once", f"{joint!r} again")
            seen.add(joint)

    def _check_times(self, times: list[float], field: str) -> None:
        if times[0] != 0.0:
            self._refuse("bad_start", f"{field}times[0]", "0 s", f"{times[0]:g} s")
        for index in range(1, len(times)):
            self._check_finite(f"{field}times[{index}]", times[index])
            if times[index] <= times[index - 1]:
                expected = f"more than {times[index - 1]:g} s, the time before"
                self._refuse(
                    "times_not_increasing", f"{field}times[{index}]", expected, f"{times[index]:g} s"
                )

    def _check_rows(
        self, joints: list[str], times: list[float], given: list[list[float]], field: str
    ) -> None:
        if len(given) != len(times):
            self._refuse("wrong_length", field, f"{len(times)} rows, one a time", f"{len(given)}")
        for index, row in enumerate(given):
            if len(row) != len(joints):
                expected = f"{len(joints)} positions, one a joint"
                self._refuse("wrong_length", f"{field}[{index}]", expected, f"{len(row)}")
        knots = np.array(given, dtype=np.float64)
        for row_index, column in np.argwhere(~np.isfinite(knots)).tolist():
            self._check_finite(f"{field}[{row_index}][{column}]", knots[row_index, column])
        limits = self._humanoid.limits(joints)
        lower, upper = limits.lower, limits.upper
        outside = np.argwhere((knots < lower - LIMIT_TOLERANCE) | (knots > upper + LIMIT_TOLERANCE))
        if outside.size:
            row_index, column = outside[0].tolist()
            expected = f"{joints[column]} within {lower[column]:.6f} .. {upper[column]:.6f} rad"
            got = f"{knots[row_index, column]:.6f} rad"
            self._refuse("outside_limits", f"{field}[{row_index}][{column}]", expected, got)


def _refuse_mixed(sign: Sign, path: Path) -> None:
    """Refuse to write a sign beside those of another language or robot: one of them tells for all."""
    beside = next((other for other in path.parent.glob("[!.]*.json") if other != path), None)
    if beside is None:
        return
    try:
        entry = json.loads(beside.read_bytes())
        language, robot = entry.get("language", DEFAULT_LANGUAGE), entry.get("robot", DEFAULT_ROBOT)
    except (OSError, ValueError, AttributeError):  # a broken entry is named when it is asked for
        return
    same = language == sign.language or _language_code(language) == _language_code(sign.language)
    if robot == sign.robot and same:
        return
    raise LutError(
        "other_language" if robot == sign.robot else "other_robot",
        f"{path}: expected a sign of {language} for {robot}, as those in {path.parent}, got one of "
        f"{sign.language} for {sign.robot}; give it a directory of its own",
    )


def _language_code(language: str) -> str:
    """The code of a language that may be named as it was formerly."""
    try:
        return load_language(language).code
    except LanguageError:  # one that is not installed here is like itself alone
        return language


def _humanoid(name: str, where: str) -> Humanoid:
    try:
        return load_humanoid(name)
    except DescriptionError as error:
        raise LutError(error.code, f"{where}: robot: {error}") from error


def _array(values: list[float] | list[list[float]]) -> NDArray[np.float64]:
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def _form(sign: Sign, form: Form) -> str:
    """The text of a form: its times, then a line for each knot."""
    rows = ",\n".join(f"      {_json(row)}" for row in _rounded_within(sign, form.knots).tolist())
    times = _json(np.round(form.times, DECIMALS).tolist())
    return f'{{\n      "times": {times},\n      "knots": [\n{rows}\n      ]\n    }}'


def _rounded_within(sign: Sign, knots: NDArray[np.float64]) -> NDArray[np.float64]:
    """Knots rounded for the file, inwards where the nearest digit lies beyond a limit that the knot keeps."""
    rounded: NDArray[np.float64] = np.round(knots, DECIMALS)
    humanoid = _humanoid(sign.robot, sign.gloss)
    known = set(sign.joints) <= set(humanoid.commanded_joints)
    if not known or rounded.ndim != 2 or not np.isfinite(rounded).all():
        return rounded  # refused by name when it is read
    limits, step = humanoid.limits(sign.joints), 10.0**-DECIMALS
    beyond = (rounded > limits.upper) & (knots <= limits.upper)
    rounded = np.where(beyond, np.round(rounded - step, DECIMALS), rounded)
    beyond = (rounded < limits.lower) & (knots >= limits.lower)
    return np.where(beyond, np.round(rounded + step, DECIMALS), rounded)


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 80 else text[:77] + "..."


def _block(key: str, brackets: str, lines: list[str]) -> str:
    if not lines:
        return f'  "{key}": {brackets}'
    inside = ",\n".join(f"    {line}" for line in lines)
    return f'  "{key}": {brackets[0]}\n{inside}\n  {brackets[1]}'


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
