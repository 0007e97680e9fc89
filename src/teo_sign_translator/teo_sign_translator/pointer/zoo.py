"""The models that can be trained, one configuration each; the same code trains and runs all of them."""

from __future__ import annotations

from types import MappingProxyType

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pointer.config import NetworkConfig

#: The model that translates unseen sentences: attention and copying over words read from both ends.
POINTER = "pointer"

#: By name, from the simplest on. The first ones are the layouts of Figure 1 of arXiv:1907.04198, then its
#: future work. All read the same words and readings, so that a row of `compare` differs from the next by its
#: mechanism alone. The equal-length layout reads from both ends: its first gloss stands at the first word,
#: and may be said by the last.
ZOO = MappingProxyType(
    {
        "rnn_equal": NetworkConfig(cell="rnn", layout="equal_length", bidirectional=True),
        "lstm_equal": NetworkConfig(cell="lstm", layout="equal_length", bidirectional=True),
        "rnn": NetworkConfig(cell="rnn"),
        "gru": NetworkConfig(cell="gru"),
        "lstm": NetworkConfig(cell="lstm"),
        "lstm_stacked": NetworkConfig(cell="lstm", layers=2),
        "gru_attention": NetworkConfig(cell="gru", bidirectional=True, attention=True),
        "lstm_attention": NetworkConfig(cell="lstm", bidirectional=True, attention=True),
        "pointer_gru": NetworkConfig(cell="gru", bidirectional=True, attention=True, copy=True),
        POINTER: NetworkConfig(cell="lstm", bidirectional=True, attention=True, copy=True),
    }
)


def network_config(name: str) -> NetworkConfig:
    """The configuration of a model of the zoo.

    Raises:
        TranslationError: "unknown_model", with the names there are.
    """
    if name not in ZOO:
        raise TranslationError("unknown_model", f"expected a model of {', '.join(ZOO)}, got '{name}'")
    return ZOO[name]
