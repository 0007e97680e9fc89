# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How translations are judged: accepted answers, texts, and the systems to compare with."""
