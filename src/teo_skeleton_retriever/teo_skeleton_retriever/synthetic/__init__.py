"""A synthetic signer: colour and depth of a person who signs, rendered, with the truth of each keypoint."""

from __future__ import annotations

from teo_skeleton_retriever.synthetic.take import Take, TakeOptions, render_take
from teo_skeleton_retriever.synthetic.truth import SyntheticFrame, Truth

__all__ = ["SyntheticFrame", "Take", "TakeOptions", "Truth", "render_take"]
