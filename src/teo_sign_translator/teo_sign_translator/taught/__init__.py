# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences whose translation is given: the paper's, and how they are recognised in a text."""
