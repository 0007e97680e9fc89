# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the retriever raises: one base class, a stable reason and a sentence."""

from __future__ import annotations

from teo_common.errors import CodedError


class RetrieverError(CodedError):
    """Base of everything this package raises; its text is the code and the sentence."""

    @property
    def sentence(self) -> str:
        """What was expected, what came and what to do, for people."""
        return str(self.args[0])

    def __str__(self) -> str:
        return f"{self.code}: {self.sentence}"


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


class TopicError(BagError):
    """A topic of a bag that is to be named, as none or several may be meant.

    Attributes:
        argument: What names it: "color_topic", "depth_topic" or "camera_info_topic".
    """

    def __init__(self, code: str, sentence: str, argument: str) -> None:
        super().__init__(code, sentence)
        self.argument = argument

    def __reduce__(self) -> tuple[type[TopicError], tuple[str, ...]]:
        return type(self), (self.code, self.sentence, self.argument)


class OutputError(RetrieverError):
    """A result that cannot be written."""
