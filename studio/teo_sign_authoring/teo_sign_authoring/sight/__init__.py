# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Networks for `teo_skeleton_retriever.lifting`: what detectors see of people, learned from rendered ones."""
