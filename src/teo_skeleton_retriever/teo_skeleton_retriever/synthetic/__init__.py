"""A synthetic signer: colour and depth of a person who signs, rendered, and the exact place of each keypoint."""

from __future__ import annotations

from teo_skeleton_retriever.synthetic.take import render_take
from teo_skeleton_retriever.synthetic.truth import SyntheticFrame, Truth

__all__ = ["SyntheticFrame", "Truth", "render_take"]
