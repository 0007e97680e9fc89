# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Skeletons for others: messages, markers, JSON, MCAP files, pictures and films."""
