# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node's parameters, in one table."""

from __future__ import annotations

from teo_common.parameters import AUTOSTART, ParameterRow
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_sign_translator.output.sign_choice import Substitutes
from teo_sign_translator.pipeline.pointer_back_end import DEFAULT_BEAM_WIDTH
from teo_sign_translator.pipeline.translator import DEFAULT_MIN_CONFIDENCE, DEFAULT_MODEL

#: Depth of `sign_tokens` [messages]: a whole text can wait there for a reader that is busy.
SIGN_TOKENS_DEPTH = 100


PARAMETERS = (
    ParameterRow(
        name="language",
        default=DEFAULT_LANGUAGE,
        description="Sign language to translate into, by its ISO 639-3 code. Setting it loads its data and "
        "model; texts that came before are translated into the one before.",
    ),
    ParameterRow(
        name="model",
        default=DEFAULT_MODEL,
        description="Name of the model, one that `translate --list-models` lists. Setting it loads its files "
        "anew.",
    ),
    ParameterRow(
        name="beam_width",
        default=DEFAULT_BEAM_WIDTH,
        description="Translations that the model weighs against each other [1]; its time grows with it. "
        "lstm256 has one.",
        low=1,
        high=16,  # wider beams find nothing better and take tens of milliseconds
    ),
    ParameterRow(
        name="min_confidence",
        default=DEFAULT_MIN_CONFIDENCE,
        description="Probability of a token, 0 to 1, below which its sentence is called uncertain.",
        low=0.0,
        high=1.0,
    ),
    ParameterRow(
        name="max_sentences",
        default=SIGN_TOKENS_DEPTH,
        description="Sentences that one text may have [1]; a longer text is refused, since sign_tokens could "
        "not hold all of it for a reader that is busy.",
        low=1,
        high=SIGN_TOKENS_DEPTH,
    ),
    ParameterRow(
        name="queue_size",
        default=100,  # a second's work for short texts: nobody waits longer for an answer without wondering
        description="Texts that may wait while one is translated [1]; further ones are refused.",
        low=1,
        high=1000,
    ),
    ParameterRow(
        name="signs_file",
        default="",
        description="File with the glosses that have signs, one a line, or folder of a table's entries; "
        "used until the executor's list_signs "
        "answers. Empty: until then every gloss may have one, and the executor spells what it lacks.",
    ),
    ParameterRow(
        name="substitutes",
        default=Substitutes.PARAPHRASE.name.lower(),  # letters are slow to sign and hard to read
        description="What may be signed for a word without a sign, before it is spelled: none, synonym "
        "or paraphrase; each allows those before it too.",
    ),
    AUTOSTART,
)
