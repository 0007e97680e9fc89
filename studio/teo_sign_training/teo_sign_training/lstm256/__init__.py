# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The model of Gago et al. 2019 (arXiv:1907.04198): an encoder-decoder LSTM that knows 39 sentences by heart.

`LstmModel` runs its weights, `Phrasebook` recognises its sentences however they are typed, `LstmBackEnd` asks
the model and checks its answer, and what it does not know is signed word by word from a `GlossList`.
"""
