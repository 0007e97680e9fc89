# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentence pairs: by the hundred thousand from a language's grammar, and those it must know by heart.

`grammar_file` reads `text/grammar` into a `Grammar`, `generator.Generator` makes `Pair`s of it, and files
keep them. The README beside this file tells how a rule is written.
"""

from teo_sign_training.corpus.pairs import SPLITS, Pair, read_pairs, write_pairs

__all__ = ["SPLITS", "Pair", "read_pairs", "write_pairs"]
