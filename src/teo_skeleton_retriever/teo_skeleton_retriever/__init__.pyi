# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from .camera.camera_model import CameraModel as CameraModel
from .camera.rgbd_image import RgbdImage as RgbdImage
from .detectors.detector import DETECTORS as DETECTORS
from .detectors.detector import DetectionFrame as DetectionFrame
from .detectors.detector import make_detector as make_detector
from .errors import RetrieverError as RetrieverError
from .image_retriever import (
    ImageRetriever as ImageRetriever,
)
from .image_retriever import (
    Retrieved as Retrieved,
)
from .image_retriever import (
    make_retriever as make_retriever,
)
from .layouts.person_2d import Person2D as Person2D
from .layouts.skeleton_3d import (
    Keypoints3D as Keypoints3D,
)
from .layouts.skeleton_3d import (
    KeypointStatus as KeypointStatus,
)
from .layouts.skeleton_3d import (
    Skeleton as Skeleton,
)
from .recording import RetrievalReport as RetrievalReport
from .recording import retrieve_recording as retrieve_recording
from .retriever import Retriever as Retriever
from .retriever_parameters import RetrieverParameters as RetrieverParameters
