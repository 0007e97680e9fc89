# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The text form of a sign, field by field: one JSON object, `SCHEMA_VERSION` 1.

`sign_json_schema()` is published as `sign.schema.json`, so that editors and other programs can check an
entry without this package. What a schema cannot say (limits of the robot, order of the times, one row of
knots for each time) is checked in `sign_file.py`.
"""

from __future__ import annotations

import datetime
import unicodedata
from typing import Annotated, Any, Literal, get_args

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, FiniteFloat, model_validator

SCHEMA_VERSION = 1

#: The robot that entries without a name are for: the first, when there was no other.
DEFAULT_ROBOT = "teo"

Kind = Literal["lexical", "letter", "number"]
Handedness = Literal["right", "left", "both"]

# A file name may hold 255 bytes on the usual file systems, and a letter of a gloss takes up to 4 of them.
MAX_GLOSS_LENGTH = 60

# Planning time grows with the square of their number.
MAX_ALTERNATIVES = 16


def _gloss(value: str) -> str:
    if value != unicodedata.normalize("NFC", value):
        raise ValueError("Unicode in composed form (NFC)")
    if any(not (char.isalnum() or char in "_-+()") for char in value):
        raise ValueError("letters, digits and _-+() only")
    if value != value.upper():
        raise ValueError(f"upper case ({value.upper()!r})")
    return value


def _date(value: str) -> str:
    try:
        datetime.date.fromisoformat(value)
    except ValueError:
        raise ValueError("a day of the calendar, written YYYY-MM-DD") from None
    return value


Date = Annotated[
    str,
    Field(pattern=r"^\d{4}-\d{2}-\d{2}$", json_schema_extra={"format": "date"}),
    AfterValidator(_date),
]
Text = Annotated[str, Field(min_length=1)]
Gloss = Annotated[str, Field(min_length=1, max_length=MAX_GLOSS_LENGTH), AfterValidator(_gloss)]

#: Longest name of an inflection; the message holds no longer one.
MAX_INFLECTION_LENGTH = 16
Inflection = Annotated[
    str, Field(min_length=1, max_length=MAX_INFLECTION_LENGTH, pattern=r"^[0-9A-ZÁÉÍÓÚÜÑ_>]+$")
]

# What a sign's form is founded on, the best first.
SourceStanding = Literal["recorded", "measured", "described", "sketched"]
SOURCE_STANDINGS: tuple[SourceStanding, ...] = get_args(SourceStanding)
SOURCE_STANDING_MEANING = (
    "How well founded the form is: made from a real recording; measured on a dictionary's video; taken from "
    "a published description; or sketched without a source, not to be trusted."
)

# The same with what signers have said of the motion; no source gives that (see `reviews`).
Standing = Literal["reviewed", SourceStanding]
STANDINGS: tuple[Standing, ...] = get_args(Standing)

_HASH = r"^[0-9a-f]{64}$"


class Review(BaseModel):
    """What signers have said of a sign's motion."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True)

    reviewers: int = Field(ge=1, description="How many people rated the motion.")
    right: int = Field(ge=0, description="How many of them found it right.")
    standing: SourceStanding = Field(
        description="The standing without the review: of another motion than the reviewed one it holds."
    )
    motion_hash: str = Field(
        pattern=_HASH, description="SHA-256 of the motion that was shown, lower-case hexadecimal."
    )
    reviewed: Date = Field(description="Day on which the review was entered.")


class Provenance(BaseModel):
    """Where a sign came from."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True)

    standing: Standing = Field(
        description=f"{SOURCE_STANDING_MEANING} 'reviewed': enough signers found this motion right."
    )
    source: Text = Field(description="Recording, publication or person that the sign was taken from.")
    method: Text = Field(description="How the source became joint angles.")
    recorded: Date | None = Field(description="Day on which the source was recorded; null where not known.")
    created: Date = Field(description="Day on which this entry was made.")
    licence: Text = Field(description="Terms of the source, as an SPDX identifier or a sentence.")
    description_hash: str = Field(
        pattern=_HASH,
        description="SHA-256 of the URDF text that the joint angles were made for, lower-case hexadecimal.",
    )
    notes: str = Field(description="What a reader must know beside the numbers; may be empty.")
    review: Review | None = Field(
        default=None, description="What signers said of the motion. Left out where nobody was asked."
    )

    @model_validator(mode="after")
    def _reviewed_by_somebody(self) -> Provenance:
        if self.standing == "reviewed" and self.review is None:
            raise ValueError("a review of a sign whose standing is 'reviewed'")
        return self


class FormFile(BaseModel):
    """An inflected form of a sign, on the joints of its citation form."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True)

    times: list[FiniteFloat] = Field(min_length=1, description="As of the sign [s].")
    knots: list[list[FiniteFloat]] = Field(min_length=1, description="As of the sign [rad].")


class SignFile(BaseModel):
    """One sign of TEO's look-up table, as its JSON file holds it."""

    model_config = ConfigDict(
        strict=True,
        extra="forbid",
        frozen=True,
        title="TEO sign",
        json_schema_extra={"$schema": "https://json-schema.org/draft/2020-12/schema"},
    )

    # "schema" is the field's name in the file; pydantic keeps that name for itself.
    schema_version: Literal[1] = Field(alias="schema", description="Version of this format.")
    gloss: Gloss = Field(
        description="Name of the sign: capitals with their accents (NFC), a space written '_'."
    )
    language: str = Field(pattern=r"^[a-z]{3}$", description="ISO 639-3 code of the sign language.")
    robot: str = Field(
        default=DEFAULT_ROBOT,
        pattern=r"^[a-z0-9][a-z0-9_]*$",
        description="Name of the robot whose joints the sign moves; entries of TEO may leave it out.",
    )
    kind: Kind = Field(description="A sign of its own, a letter of the manual alphabet, or a number.")
    handedness: Handedness = Field(description="The hands that make the sign.")
    joints: list[str] = Field(
        min_length=1, description="Names of the joints that the sign moves, each once; the others are free."
    )
    times: list[FiniteFloat] = Field(
        min_length=1, description="Time of each knot [s]: the first is 0, each later than the one before."
    )
    knots: list[list[FiniteFloat]] = Field(
        min_length=1,
        description="A row for each time: the position [rad] of each of 'joints', in its order.",
    )
    forms: dict[Inflection, FormFile] = Field(
        default={},
        description="Inflected forms beside that citation form, by inflection: '2>1' is from the addressee "
        "to the signer, the gloss of a place is there. May be left out.",
    )
    alternatives: list[list[list[FiniteFloat]]] = Field(
        default=[],
        max_length=MAX_ALTERNATIVES,
        description="Other postures of the same sign that are read as well, of which the planner takes the "
        "one with the shortest way: each as 'knots', at the same times.",
    )
    alternatives_of: str = Field(
        default="",
        pattern=f"{_HASH}|^$",
        description="SHA-256 of the joints, times and knots that 'alternatives' were made for, lower-case "
        "hexadecimal: of another motion they are not used. Left out without alternatives.",
    )
    provenance: Provenance
    quality: dict[str, FiniteFloat] = Field(
        description="Figures of how well the sign was captured: name with its unit as last word, value."
    )


def sign_json_schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a sign's file."""
    return SignFile.model_json_schema()
