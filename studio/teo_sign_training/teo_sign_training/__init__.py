# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Making translation models: pairs from a grammar, models from pairs, figures from both.

Each room imports only rooms above it in this list:

    corpus      a grammar that makes sentence pairs, and the paper's pairs
    lstm256     the published model
    fitting     from pairs to models; the only room that needs PyTorch
    cli         the commands
"""
