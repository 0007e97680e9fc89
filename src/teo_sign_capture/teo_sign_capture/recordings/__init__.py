# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a sign is captured from.

Bags of images or skeletons, films, `.pose` clips, live skeletons.
"""
