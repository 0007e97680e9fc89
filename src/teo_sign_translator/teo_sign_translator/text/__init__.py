# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From typed text to words: cleaning, short forms, numbers, clauses, kinds of sentence, readings of words.

A text is cleaned (`clean`), read into clauses of words (`read`), and its words get their readings
(`source_words`): a model reads the same words in training and in use.
"""
