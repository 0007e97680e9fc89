# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The project's own commands as processes with limits, in a queue, and the recordings that they look at."""
