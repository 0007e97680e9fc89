"""From typed text to words: cleaning, short forms, numbers, clauses, kinds of sentence, readings of words.

A text is cleaned (`clean`), read into clauses of words (`read`), and its words get their readings
(`source_words`): a model reads the same words in training and in use.
"""

from teo_sign_translator.text.cleaning import clean
from teo_sign_translator.text.reading import Clause, Word, WordKind, read
from teo_sign_translator.text.sentence_type import SentenceType, is_negated, sentence_type
from teo_sign_translator.text.source_words import SourceWord, source_words

__all__ = [
    "Clause",
    "SentenceType",
    "SourceWord",
    "Word",
    "WordKind",
    "clean",
    "is_negated",
    "read",
    "sentence_type",
    "source_words",
]
