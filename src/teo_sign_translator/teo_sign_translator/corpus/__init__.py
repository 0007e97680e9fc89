"""Sentence pairs by the hundred thousand from a grammar of everyday Spanish and its LSE order."""

from teo_sign_translator.corpus.pairs_file import SPLITS, Pair, read_pairs, write_pairs

__all__ = ["SPLITS", "Pair", "read_pairs", "write_pairs"]
