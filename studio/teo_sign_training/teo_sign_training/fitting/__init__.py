# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Making the models: from a corpus, or the paper's pairs, to weights. Only this room needs PyTorch."""
