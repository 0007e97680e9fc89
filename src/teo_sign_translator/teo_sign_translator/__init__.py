# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Spanish text to Spanish Sign Language (LSE): which signs are made, in which order, for which words.

    >>> print(Translator.load().translate("Mañana no voy al colegio."))
    MAÑANA YO COLEGIO IR NO

Each room imports only rooms above it in this list; the README says more of each.

    morphology  what a Spanish word may be, and how a lemma is inflected
    text        typed text as sentences, clauses and words
    output      what is signed: glosses, letters, numbers, pauses
    pointer     the default model
    pipeline    from text through a model to what is signed
    node, cli   the ROS node, the commands
"""

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_files import available_models
from teo_sign_translator.output.translation import Kind, Origin, Sentence, Token, Translation
from teo_sign_translator.pipeline.translator import DEFAULT_MODEL, Translator
from teo_sign_translator.text.reading import SentenceType

__all__ = [
    "DEFAULT_MODEL",
    "Kind",
    "Origin",
    "Sentence",
    "SentenceType",
    "Token",
    "Translation",
    "TranslationError",
    "Translator",
    "available_models",
]
