# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sentence before and after planning: its form and rhythm, the postures it passes, the plan."""
