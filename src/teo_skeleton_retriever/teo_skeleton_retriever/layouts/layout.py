"""What a set of keypoints is called, in which order it comes and how it is drawn."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise


@dataclass(frozen=True)
class Layout:
    """A fixed order of named keypoints.

    Attributes:
        name: of the layout, as its authors call it.
        keypoints: names, in the order of the data.
        bones: pairs of names that are joined when the skeleton is drawn.
    """

    name: str
    keypoints: tuple[str, ...]
    bones: tuple[tuple[str, str], ...]

    @cached_property
    def index(self) -> dict[str, int]:
        """Place of each name in the data."""
        return {keypoint: i for i, keypoint in enumerate(self.keypoints)}

    def __len__(self) -> int:
        return len(self.keypoints)


def bones_of(keypoints: tuple[str, ...], pairs: str) -> tuple[tuple[str, str], ...]:
    """Read bones from a table of index pairs.

    Args:
        keypoints: the names that the indices point to.
        pairs: for example ``"0-1 1-2"``; a longer run ``"0-1-2"`` is its consecutive pairs.
    """
    runs = [[keypoints[int(i)] for i in run.split("-")] for run in pairs.split()]
    return tuple(pair for run in runs for pair in pairwise(run))
