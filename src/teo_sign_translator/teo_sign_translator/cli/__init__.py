# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The commands: translate, and those that make and measure models. Each module is one command."""
