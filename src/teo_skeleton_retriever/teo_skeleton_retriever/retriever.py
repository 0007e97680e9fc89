"""The retriever: 2D keypoints and depth of one image after the other in, tracked 3D people out."""

from __future__ import annotations

from teo_skeleton_retriever.frame import Frame
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.skeleton_3d import Keypoints3D, KeypointStatus, Skeleton

__all__ = ["Frame", "KeypointStatus", "Keypoints3D", "Retriever", "RetrieverParameters", "Skeleton"]


class Retriever:
    """Follows people in space. Knows the time from the stamps of the frames alone."""

    def __init__(self, parameters: RetrieverParameters | None = None) -> None:
        """Build a retriever that has seen nobody yet."""
        self._parameters = parameters or RetrieverParameters()

    def process(self, frame: Frame) -> tuple[Skeleton, ...]:
        """Take one image.

        Returns:
            Everybody who is seen in it, by ascending id.
        """
        del frame
        return ()

    def lock_signer(self, track_id: int | None) -> None:
        """Follow this person as the signer and nobody else; None chooses by the rule again."""
        del track_id
