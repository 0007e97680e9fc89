# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a camera makes of a scene: rays, colours, visibility, and the errors of its depth."""
