"""The node's parameters, in one table."""

from __future__ import annotations

from dataclasses import dataclass

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

from teo_sign_translator.model_store import DEFAULT_MODEL
from teo_sign_translator.translator import DEFAULT_MIN_CONFIDENCE

#: Depth of `sign_tokens` [messages]: a whole text can wait there for a reader that is busy.
SIGN_TOKENS_DEPTH = 100


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter.

    Attributes:
        name: Of the parameter.
        default: Its value if none is given.
        description: Meaning and unit.
        least: Smallest value; None for text.
        most: Largest value; None for text.
    """

    name: str
    default: str | float | int
    description: str
    least: float | int | None = None
    most: float | int | None = None

    def descriptor(self) -> ParameterDescriptor:
        """The parameter as ROS describes it."""
        descriptor = ParameterDescriptor(description=self.description)
        if isinstance(self.default, int):
            descriptor.integer_range = [IntegerRange(from_value=self.least, to_value=self.most, step=1)]
        elif isinstance(self.default, float):
            descriptor.floating_point_range = [FloatingPointRange(from_value=self.least, to_value=self.most)]
        return descriptor


PARAMETERS = (
    Parameter("model", DEFAULT_MODEL, "Name of the model, one that `translate --list-models` lists."),
    Parameter(
        "min_confidence",
        DEFAULT_MIN_CONFIDENCE,
        "Probability of a token of the model, 0 to 1, below which a sentence is signed word by word.",
        0.0,
        1.0,
    ),
    Parameter(
        "max_sentences",
        SIGN_TOKENS_DEPTH,
        "Sentences that one text may have [1]; a longer text is refused, since sign_tokens could not hold "
        "all "
        "of it for a reader that is busy.",
        1,
        SIGN_TOKENS_DEPTH,
    ),
)
