# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The original skeletonRetriever's processing, reproduced; what is ours and better is outside this folder.

Source: robotology/assistive-rehab 0.6.0, module `skeletonRetriever` and library `skeleton` (BSD-3-Clause),
re-written from their behaviour.
"""
