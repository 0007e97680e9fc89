# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where signs are made: directions in words, places of articulation, points of a hand that meet them."""
