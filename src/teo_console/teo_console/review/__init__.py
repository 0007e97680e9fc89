# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What signers understand and think of the signs: one file, the blind order of items, figures, exports."""
