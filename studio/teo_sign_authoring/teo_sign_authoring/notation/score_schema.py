# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The text form of a score, field by field."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from teo_description.humanoid import Side
from teo_sign_capture.retarget.handshapes import written_shape
from teo_sign_capture.signing_space import OTHER_HAND, direction, displacement, split_place
from teo_signs.sign_schema import SOURCE_STANDING_MEANING, SourceStanding, check_gloss

# Part of the hand that is at the place.
Part = Literal["palm", "fingertips", "index", "thumb", "index_side", "little_side", "back", "wrist"]


def _checked(check: object) -> AfterValidator:
    def validate(value: str) -> str:
        check(value)  # type: ignore[operator]
        return value

    return AfterValidator(validate)


Gloss = Annotated[str, _checked(check_gloss)]
Text = Annotated[str, Field(min_length=1)]
_Shape = Annotated[str, _checked(written_shape)]
_Direction = Annotated[str, _checked(direction)]
_Displacement = Annotated[str, _checked(displacement)]
_PlaceText = Annotated[str, _checked(split_place)]
Seconds = Annotated[float, Field(ge=0.0, le=10.0, description="[s]")]

# Cosine of 50 deg: words are rough, and the fingers are turned to a right angle with the palm.
_MOST_OBLIQUE = 0.643

_STRICT = ConfigDict(strict=True, extra="forbid", frozen=True)


class HandScore(BaseModel):
    """What one hand does in a step; what is left out stays as in the step before."""

    model_config = _STRICT

    shape: _Shape | None = Field(None, description="Handshape by name.")
    place: _PlaceText | None = Field(
        None, description="Where: a place, then centimetres from it: 'mouth 3 front'."
    )
    part: Part | None = Field(None, description="Part of the hand that is there; 'palm' if never said.")
    palm: _Direction | None = Field(None, description="Way the palm faces, e.g. 'back' is to the signer.")
    fingers: _Direction | None = Field(None, description="Way from wrist to knuckles.")


class Circle(BaseModel):
    """A circle that the hands make about their place."""

    model_config = _STRICT

    plane: Literal["front", "side", "top"] = Field(
        description="Plane: as seen from the front, the side, above."
    )
    radius: float = Field(gt=0.0, le=20.0, description="[cm]")
    turns: float = Field(gt=0.0, le=6.0, description="How often round.")
    start: _Direction = Field("up", description="Where on the circle it begins.")
    clockwise: bool = Field(
        True, description="As the signer sees it; in plane side from the hand's own side, in top from above."
    )
    time: Annotated[float, Field(gt=0.0, le=10.0)] = Field(description="Of the whole movement [s].")
    hand: Side | None = Field(None, description="Which hand of two written ones; both without it.")


class Wiggle(BaseModel):
    """A joint that goes to and fro while the hand keeps its place."""

    model_config = _STRICT

    joint: Literal["fingers", "index", "middle", "little", "thumb", "wrist", "forearm", "elbow"] = Field(
        description="What goes to and fro; 'fingers' one after the other."
    )
    angle: float = Field(gt=0.0, le=90.0, description="From one end to the other [deg].")
    times: int = Field(ge=1, le=10, description="How often there and back.")
    time: Annotated[float, Field(gt=0.0, le=10.0)] = Field(description="Of the whole movement [s].")
    hand: Side | None = Field(None, description="Which hand of two written ones; both without it.")


class HeadScore(BaseModel):
    """Where the head is in a step."""

    model_config = _STRICT

    turn: float = Field(
        0.0, ge=-60.0, le=60.0, description="Towards the signing hand's side, negative away [deg]."
    )
    bow: float = Field(0.0, ge=-10.0, le=10.0, description="Forward, negative back [deg].")


class Step(BaseModel):
    """A posture, and how it is reached and held."""

    model_config = _STRICT

    time: Seconds = Field(
        0.3, description="From the posture before to this one [s]; of the first, without meaning."
    )
    hold: Seconds = Field(0.0, description="Held before going on [s].")
    right: HandScore | None = None
    left: HandScore | None = None
    head: HeadScore | None = None
    arc: _Displacement | None = Field(
        None, description="How far the way here swings out in its middle, e.g. '5 up'."
    )
    circle: Circle | None = Field(None, description="Made after the posture is reached.")
    wiggle: Wiggle | None = Field(None, description="Made after the posture is reached.")


# One hand; both, each written; or the left as the mirror of the right.
Hands = Literal["right", "both", "mirrored"]


class Repeat(BaseModel):
    """Steps that are made again."""

    model_config = _STRICT

    times: int = Field(ge=2, le=6, description="How often in all.")
    steps: list[Step] = Field(min_length=1)


class _Heading(BaseModel):
    """What every score says of its sign."""

    model_config = _STRICT

    gloss: Gloss = Field(description="Name of the sign; equal to the file's name.")
    kind: Literal["lexical", "number"] = Field("lexical", description="A sign of its own, or a number.")
    standing: SourceStanding = Field(description=SOURCE_STANDING_MEANING)
    source: Text = Field(description="What the form was taken from.")
    face: str = Field(
        "", description="What the face does, in words: TEO has none, a viewer of the text does."
    )
    notes: str = Field("", description="What a reader must know.")


class Compound(_Heading):
    """A sign that is made of others, or that is another under a second name."""

    signs: list[Gloss] = Field(min_length=1, max_length=4, description="Scores it is made of, in order.")
    inflection: str = Field("", description="Form of its one sign, e.g. '2>1'; the citation form without it.")

    @model_validator(mode="after")
    def _one_is_inflected(self) -> Compound:
        if self.inflection and len(self.signs) > 1:
            raise ValueError("an inflection of one sign, not of several")
        return self


class _FormHand(HandScore):
    """What one hand does in a step of the forms; checked when persons and places are filled in."""

    place: str | None = Field(None, description="As of a hand; also 'giver', 'receiver', or 'there'.")
    palm: str | None = Field(None, description="As of a hand; also 'onward', 'homeward'.")
    fingers: str | None = Field(None, description="As of a hand; also 'onward', 'homeward'.")


class FormStep(Step):
    """A step of the forms."""

    right: _FormHand | None = None
    left: _FormHand | None = None
    arc: str | None = Field(None, description="As of a step; also 'onward', 'homeward'.")


class FormRepeat(BaseModel):
    """Steps of the forms that are made again."""

    model_config = _STRICT

    times: int = Field(ge=2, le=6, description="How often in all.")
    steps: list[FormStep] = Field(min_length=1)


class Forms(BaseModel):
    """Inflected forms: the steps of all of them, said once."""

    model_config = _STRICT

    along: Literal["persons", "body"] = Field(
        description="What the sign agrees with: who acts on whom, or the place of the body that is meant."
    )
    only: list[Literal["1>2", "1>3", "2>1", "2>3", "3>1", "3>2"]] | None = Field(
        None, description="Forms along persons that TEO can make; all without it."
    )
    hands: Literal["right", "both"] | None = Field(
        None, description="Hands of the forms, if the score mirrors them: two that go to one side are both."
    )
    steps: list[FormStep | FormRepeat] = Field(min_length=1)


class Score(_Heading):
    """A sign as its form is described."""

    hands: Hands = Field(description="One hand; both, each written; or the left as the mirror of the right.")
    steps: list[Step | Repeat] = Field(min_length=1)
    forms: Forms | None = Field(None, description="Inflected forms beside these steps, the citation form.")

    @model_validator(mode="after")
    def _hands_are_written(self) -> Score:
        steps = flattened(self.steps)
        for side, used in (("right", True), ("left", self.hands == "both")):
            first = getattr(steps[0], side)
            if used and (first is None or None in (first.shape, first.place, first.palm, first.fingers)):
                raise ValueError(f"the first step to say shape, place, palm and fingers of the {side} hand")
            if not used and any(getattr(step, side) is not None for step in steps):
                raise ValueError(f"no {side} hand where hands is {self.hands!r}")
        moved = [movement.hand for step in steps for movement in (step.circle, step.wiggle) if movement]
        if self.hands != "both" and any(moved):
            raise ValueError(f"no hand named for a movement where hands is {self.hands!r}")
        for side in ("right", "left"):
            palm = fingers = ""
            for step in steps:
                hand: HandScore | None = getattr(step, side)
                if hand is not None and (hand.palm or hand.fingers):
                    palm, fingers = hand.palm or palm, hand.fingers or fingers
                    if abs(float(direction(palm) @ direction(fingers))) > _MOST_OBLIQUE:
                        raise ValueError(
                            f"palm and fingers about at a right angle, as on any hand; not {palm!r} with "
                            f"{fingers!r}"
                        )
        for step in steps:
            named = [(hand.place or "").split(" ")[0] for hand in (step.right, step.left) if hand]
            if self.hands != "both" and set(named) & set(OTHER_HAND):
                raise ValueError("hands: both, where a place is on the other hand")
            if step.left and (step.left.place or "").split(" ")[0] in OTHER_HAND:
                raise ValueError("places on the other hand for the right hand only")
        return self


def flattened(steps: Sequence[Step | Repeat | FormRepeat]) -> list[Step]:
    """All steps in the order in which they are made."""
    made: list[Step] = []
    for step in steps:
        made += step.steps * step.times if isinstance(step, Repeat | FormRepeat) else [step]
    return made
