# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a text to its translation: `Translator` reads it, asks a back end, and finds signs for what it says.

A back end translates sentences with its model. The pointer's (`PointerBackEnd`) divides long sentences, has
the model's hypotheses repaired, so that no word is lost and no gloss invented, and turns glosses into output
words. The LSTM's (`LstmBackEnd`) asks its model for sentences that it knows, and looks up all others word by
word.
"""
