# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Letters and numbers of the LSE manual alphabet, from measured postures of one hand."""
