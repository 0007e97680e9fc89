# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From colour and depth images to people in space: keypoints of bodies, hands and faces.

`retrieve_recording` goes through a whole recording; an `ImageRetriever`, made of a detector and a
`Retriever`, takes one image after the other. The names below are loaded when they are first used, so that
importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from teo_skeleton_retriever.camera.camera_model import CameraModel
    from teo_skeleton_retriever.camera.rgbd_image import RgbdImage
    from teo_skeleton_retriever.detectors.detection_frame import DetectionFrame
    from teo_skeleton_retriever.detectors.factory import DETECTORS, make_detector
    from teo_skeleton_retriever.errors import RetrieverError
    from teo_skeleton_retriever.image_retriever import ImageRetriever, Retrieved, make_retriever
    from teo_skeleton_retriever.layouts.person_2d import Person2D
    from teo_skeleton_retriever.layouts.skeleton_3d import Keypoints3D, KeypointStatus, Skeleton
    from teo_skeleton_retriever.recording import RetrievalReport, retrieve_recording
    from teo_skeleton_retriever.retriever import Retriever
    from teo_skeleton_retriever.retriever_parameters import RetrieverParameters

__all__ = [
    "DETECTORS",
    "CameraModel",
    "DetectionFrame",
    "ImageRetriever",
    "KeypointStatus",
    "Keypoints3D",
    "Person2D",
    "RetrievalReport",
    "Retrieved",
    "Retriever",
    "RetrieverError",
    "RetrieverParameters",
    "RgbdImage",
    "Skeleton",
    "make_detector",
    "make_retriever",
    "retrieve_recording",
]

_MODULES = {
    "camera.camera_model": ("CameraModel",),
    "camera.rgbd_image": ("RgbdImage",),
    "detectors.detection_frame": ("DetectionFrame",),
    "detectors.factory": ("DETECTORS", "make_detector"),
    "errors": ("RetrieverError",),
    "image_retriever": ("ImageRetriever", "Retrieved", "make_retriever"),
    "layouts.person_2d": ("Person2D",),
    "layouts.skeleton_3d": ("KeypointStatus", "Keypoints3D", "Skeleton"),
    "recording": ("RetrievalReport", "retrieve_recording"),
    "retriever": ("Retriever",),
    "retriever_parameters": ("RetrieverParameters",),
}
_MODULE_OF = {name: module for module, names in _MODULES.items() for name in names}


def __getattr__(name: str) -> object:
    """Load a public name from its module."""
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE_OF[name]}"), name)
