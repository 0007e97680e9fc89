# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One person, in one room, plays one script before one sensor: images with truth, and their bag."""
