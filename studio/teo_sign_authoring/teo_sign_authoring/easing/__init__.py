# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Other arm postures of a word that show the same, with which a sentence takes less time."""
