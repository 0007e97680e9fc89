# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The simulated joints: ideal ones, and ones with mass; what can be wrong with them."""
