# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentence pairs: by the hundred thousand from a grammar of Spanish and its LSE order, and the paper's.

`grammar_file` reads `data/grammar` into a `Grammar`, `generator.Generator` makes `Pair`s of it, and files
keep them. The README beside this file tells how a rule is written.
"""

from teo_sign_translator.corpus.pairs_file import SPLITS, Pair, read_pairs, write_pairs

__all__ = ["SPLITS", "Pair", "read_pairs", "write_pairs"]
