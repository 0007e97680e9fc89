"""A synthetic signer: colour and depth of a person who signs, rendered, with the truth of each keypoint."""

from __future__ import annotations

from teo_synthetic_signer.take.take import Take, TakeOptions, render_take
from teo_synthetic_signer.take.truth import SyntheticFrame, Truth

__all__ = ["SyntheticFrame", "Take", "TakeOptions", "Truth", "render_take"]
