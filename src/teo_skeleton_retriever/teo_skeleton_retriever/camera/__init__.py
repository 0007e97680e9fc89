# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a depth camera sends.

Its model with distortion, colour and depth from messages and files, and which depth image belongs to
which colour image.
"""
