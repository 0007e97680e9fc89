"""The node's parameters, in one table."""

from __future__ import annotations

from dataclasses import dataclass

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

from teo_sign_translator.model_store import DEFAULT_MODEL
from teo_sign_translator.sentence_route import DEFAULT_BEAM_WIDTH
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
        fixed: Whether it counts only when the node starts.
    """

    name: str
    default: str | float | int | bool
    description: str
    least: float | int | None = None
    most: float | int | None = None
    fixed: bool = False

    def descriptor(self) -> ParameterDescriptor:
        """The parameter as ROS describes it."""
        descriptor = ParameterDescriptor(description=self.description, read_only=self.fixed)
        if isinstance(self.default, float):
            descriptor.floating_point_range = [FloatingPointRange(from_value=self.least, to_value=self.most)]
        elif isinstance(self.default, int) and not isinstance(self.default, bool):
            descriptor.integer_range = [IntegerRange(from_value=self.least, to_value=self.most, step=1)]
        return descriptor


PARAMETERS = (
    Parameter(
        "model",
        DEFAULT_MODEL,
        "Name of the model, one that `translate --list-models` lists. Setting it loads its files anew.",
    ),
    Parameter(
        "beam_width",
        DEFAULT_BEAM_WIDTH,
        "Translations that the model weighs against each other [1]; its time grows with it. lstm256 has one.",
        1,
        16,  # wider beams find nothing better and take tens of milliseconds
    ),
    Parameter(
        "min_confidence",
        DEFAULT_MIN_CONFIDENCE,
        "Probability of a token, 0 to 1, below which its sentence is called uncertain.",
        0.0,
        1.0,
    ),
    Parameter(
        "max_sentences",
        SIGN_TOKENS_DEPTH,
        "Sentences that one text may have [1]; a longer text is refused, since sign_tokens could not hold "
        "all of it for a reader that is busy.",
        1,
        SIGN_TOKENS_DEPTH,
    ),
    Parameter(
        "queue_size",
        100,  # a second's work for short texts: nobody waits longer for an answer without wondering
        "Texts that may wait while one is translated [1]; further ones are refused.",
        1,
        1000,
    ),
    Parameter(
        "signs_file",
        "",
        "File with the glosses that have signs, one a line; used until the executor's list_signs answers. "
        "Empty: until then every gloss may have one, and the executor spells what it lacks.",
    ),
    Parameter(
        "autostart",
        True,  # `ros2 run` without a lifecycle manager must give a node that translates
        "Whether the node configures and activates itself when it starts; else a manager does.",
        fixed=True,
    ),
)
