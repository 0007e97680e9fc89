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

import msgspec
from msgspec import Meta, Struct, field

SCHEMA_VERSION = 1

#: The robot that entries without a name are for: the first, when there was no other.
DEFAULT_ROBOT = "teo"

Kind = Literal["lexical", "letter", "number"]
Handedness = Literal["right", "left", "both"]

# A file name may hold 255 bytes on the usual file systems, and a letter of a gloss takes up to 4 of them.
MAX_GLOSS_LENGTH = 60

# Planning time grows with the square of their number.
MAX_ALTERNATIVES = 16


def check_gloss(value: str) -> None:
    """Refuse a name that no sign may have.

    Raises:
        ValueError: Its text says what was expected.
    """
    if not 1 <= len(value) <= MAX_GLOSS_LENGTH:
        raise ValueError(f"1 to {MAX_GLOSS_LENGTH} characters")
    if value != unicodedata.normalize("NFC", value):
        raise ValueError("Unicode in composed form (NFC)")
    if any(not (char.isalnum() or char in "_-+()") for char in value):
        raise ValueError("letters, digits and _-+() only")
    if value != value.upper():
        raise ValueError(f"upper case ({value.upper()!r})")


def check_date(value: str) -> None:
    """Refuse what is no day of the calendar, written YYYY-MM-DD.

    Raises:
        ValueError: Its text says what was expected.
    """
    try:
        datetime.date.fromisoformat(value)
    except ValueError:
        raise ValueError("a day of the calendar, written YYYY-MM-DD") from None


Date = Annotated[str, Meta(pattern=r"^\d{4}-\d{2}-\d{2}$", extra_json_schema={"format": "date"})]
Text = Annotated[str, Meta(min_length=1)]
Gloss = Annotated[str, Meta(min_length=1, max_length=MAX_GLOSS_LENGTH)]

#: Longest name of an inflection; the message holds no longer one.
MAX_INFLECTION_LENGTH = 16
Inflection = Annotated[
    str, Meta(min_length=1, max_length=MAX_INFLECTION_LENGTH, pattern=r"^[0-9A-ZÁÉÍÓÚÜÑ_>]+$")
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

_Hash = Annotated[str, Meta(pattern=r"^[0-9a-f]{64}$")]
_Count = Annotated[int, Meta(ge=0)]


class Review(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What signers have said of a sign's motion."""

    reviewers: Annotated[int, Meta(ge=1, description="How many people rated the motion.")]
    right: Annotated[_Count, Meta(description="How many of them found it right.")]
    standing: Annotated[
        SourceStanding,
        Meta(
            description="The standing without the review: of another motion than the reviewed one it holds."
        ),
    ]
    motion_hash: Annotated[
        _Hash, Meta(description="SHA-256 of the motion that was shown, lower-case hexadecimal.")
    ]
    reviewed: Annotated[Date, Meta(description="Day on which the review was entered.")]


class Provenance(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where a sign came from."""

    standing: Annotated[
        Standing,
        Meta(description=f"{SOURCE_STANDING_MEANING} 'reviewed': enough signers found this motion right."),
    ]
    source: Annotated[
        Text, Meta(description="Recording, publication or person that the sign was taken from.")
    ]
    method: Annotated[Text, Meta(description="How the source became joint angles.")]
    recorded: Annotated[
        Date | None, Meta(description="Day on which the source was recorded; null where not known.")
    ]
    created: Annotated[Date, Meta(description="Day on which this entry was made.")]
    licence: Annotated[Text, Meta(description="Terms of the source, as an SPDX identifier or a sentence.")]
    description_hash: Annotated[
        _Hash,
        Meta(description="SHA-256 of the URDF text that the joint angles were made for."),
    ]
    notes: Annotated[str, Meta(description="What a reader must know beside the numbers; may be empty.")]
    review: Annotated[
        Review | None, Meta(description="What signers said of the motion. Left out where nobody was asked.")
    ] = None

    def __post_init__(self) -> None:
        """Refuse a standing that nobody gave."""
        if self.standing == "reviewed" and self.review is None:
            raise ValueError("a review of a sign whose standing is 'reviewed'")


# Rows of positions [rad], one for each time, in the order of the joints.
_Rows = Annotated[list[list[float]], Meta(min_length=1)]
_Times = Annotated[list[float], Meta(min_length=1)]


class FormFile(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An inflected form of a sign, on the joints of its citation form."""

    times: Annotated[_Times, Meta(description="As of the sign [s].")]
    knots: Annotated[_Rows, Meta(description="As of the sign [rad].")]


class SignFile(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One sign of a robot's look-up table, as its JSON file holds it."""

    schema: Annotated[Literal[1], Meta(description="Version of this format.")]
    gloss: Annotated[
        Gloss, Meta(description="Name of the sign: capitals with their accents (NFC), a space written '_'.")
    ]
    language: Annotated[str, Meta(pattern=r"^[a-z]{3}$", description="ISO 639-3 code of the sign language.")]
    robot: Annotated[
        str,
        Meta(
            pattern=r"^[a-z0-9][a-z0-9_]*$",
            description="Name of the robot whose joints the sign moves; entries of TEO may leave it out.",
        ),
    ] = DEFAULT_ROBOT
    kind: Annotated[
        Kind, Meta(description="A sign of its own, a letter of the manual alphabet, or a number.")
    ]
    handedness: Annotated[Handedness, Meta(description="The hands that make the sign.")]
    joints: Annotated[
        list[str],
        Meta(
            min_length=1,
            description="Names of the joints that the sign moves, each once; the others are free.",
        ),
    ]
    times: Annotated[
        _Times, Meta(description="Time of each knot [s]: the first is 0, each later than the one before.")
    ]
    knots: Annotated[
        _Rows,
        Meta(description="A row for each time: the position [rad] of each of 'joints', in its order."),
    ]
    forms: Annotated[
        dict[Inflection, FormFile],
        Meta(
            description="Inflected forms beside that citation form, by inflection: '2>1' is from the "
            "addressee to the signer, the gloss of a place is there. May be left out."
        ),
    ] = field(default_factory=dict)
    alternatives: Annotated[
        list[list[list[float]]],
        Meta(
            max_length=MAX_ALTERNATIVES,
            description="Other postures of the same sign that are read as well, of which the planner takes "
            "the one with the shortest way: each as 'knots', at the same times.",
        ),
    ] = field(default_factory=list)
    alternatives_of: Annotated[
        str,
        Meta(
            pattern="^([0-9a-f]{64})?$",
            description="SHA-256 of the joints, times and knots that 'alternatives' were made for, "
            "lower-case hexadecimal: of another motion they are not used. Left out without alternatives.",
        ),
    ] = ""
    provenance: Provenance
    quality: Annotated[
        dict[str, float],
        Meta(
            description="Figures of how well the sign was captured: name with its unit as last word, value."
        ),
    ]


def sign_json_schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a sign's file."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **msgspec.json.schema(SignFile)}
