# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A draft of a sentence: its words' lemmas in an order that rules give, where the model is not to be trusted.

The rules are few, and each of them is counted on signers (UD_Spanish_Sign_Language-LSE, the LSE-RADIS
treebank of GRADES, Universidade de Vigo) or published in grammars of LSE. `drafter` goes through them.
"""
