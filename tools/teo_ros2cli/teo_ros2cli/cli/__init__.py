# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The commands: their options and output, a module or a room each, loaded when called."""
