# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The default model: an encoder-decoder with attention that says known glosses or copies a word's lemma.

`ArrayModel` runs the weights of any model of the zoo on NumPy arrays, `SentenceModel` searches for the
likeliest translations with it, and `load_sentence_model` reads one from its files.
"""

from teo_sign_translator.pointer.decoding import Hypothesis, OutputGloss, SentenceModel, load_sentence_model

__all__ = ["Hypothesis", "OutputGloss", "SentenceModel", "load_sentence_model"]
