# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""OpenPose's method, part affinity fields, with a network that the user brings as an ONNX file."""
