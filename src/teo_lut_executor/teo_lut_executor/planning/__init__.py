# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Planning in a process of its own, so that the node hears and answers meanwhile."""
