# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What benches of signs share: tracks of performed signs, baselines, errors, a check by other code."""
