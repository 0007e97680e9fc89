# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The signs of a language on any robot, each from what it is known by, and how well they are shown."""
