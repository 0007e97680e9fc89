"""The model of Gago et al. 2019 (arXiv:1907.04198): an encoder-decoder LSTM that knows 39 sentences by heart.

`LstmModel` runs its weights, `Phrasebook` recognises its sentences however they are typed, `KnownSentences`
asks the model and checks its answer, and what it does not know is signed word by word from a `GlossList`.
"""

from teo_sign_translator.lstm256.gloss_list import GlossList
from teo_sign_translator.lstm256.known_sentences import KnownSentences
from teo_sign_translator.lstm256.phrasebook import Phrasebook
from teo_sign_translator.lstm256.seq2seq import LstmModel
from teo_sign_translator.lstm256.store import load_model

__all__ = ["GlossList", "KnownSentences", "LstmModel", "Phrasebook", "load_model"]
