# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How near a retriever comes to the truth, and how fast limbs are fitted: takes, other methods, errors."""
