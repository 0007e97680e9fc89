# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Letters of manual alphabets, from measured postures of one hand."""
