# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How joints go: curves between points, trajectories, time on a path, who commands what of it."""
