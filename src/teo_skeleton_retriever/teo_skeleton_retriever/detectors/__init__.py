# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who is in an image, and where their keypoints are: detectors behind one small interface."""

from teo_skeleton_retriever.detectors.detector import DETECTORS, Detector, make_detector

__all__ = ["DETECTORS", "Detector", "make_detector"]
