# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From takes to entries of the table.

One take, several takes, checks by the planner, evidence, pictures, batches.
"""
