# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the packages share: errors, text folding, atomic files, parameters, diagnostics, running a node.

Its modules are imported by name, and nothing here: every `ros2` command loads `teo_common.errors`, and comes
up in half the time without the rest.
"""
