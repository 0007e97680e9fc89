"""What the retriever raises: one base class, a stable reason and a sentence."""

from __future__ import annotations


class RetrieverError(Exception):
    """Base of everything this package raises.

    Attributes:
        code: stable reason, for programs.
        sentence: what was expected, what came and what to do, for people.
    """

    def __init__(self, code: str, sentence: str) -> None:
        super().__init__(f"{code}: {sentence}")
        self.code = code
        self.sentence = sentence


class KeypointError(RetrieverError):
    """Keypoints that do not have the shape or the values of their layout."""


class OpenPoseFormatError(RetrieverError):
    """A file that is not what OpenPose's `--write_json` writes."""


class CameraError(RetrieverError):
    """Intrinsics or a distortion that describe no usable camera."""


class DepthError(RetrieverError):
    """A depth image that cannot be decoded, or a filter that cannot be built."""


class LimbError(RetrieverError):
    """Limb lengths or a limb chain that make no problem to solve."""


class TrackingError(RetrieverError):
    """Settings or times with which nobody can be followed."""


class ParameterError(RetrieverError):
    """A parameter that is not of its kind or outside its range."""


class FrameError(RetrieverError):
    """An image whose parts do not fit together."""


class DetectorError(RetrieverError):
    """A detector that cannot be made, or an image that it cannot tell about."""


class ImageError(RetrieverError):
    """A colour image that cannot be decoded."""


class BagError(RetrieverError):
    """A bag that cannot be opened, or in which the topics are not found."""


class OutputError(RetrieverError):
    """A result that cannot be written."""
