# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Translations as ROS messages."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from teo_sign_msgs.msg import SignSentence, SignToken

from teo_sign_translator.output.translation import Translation


def to_messages(translation: Translation, *, stamp: Time, utterance_id: str) -> list[SignSentence]:
    """One message for each sentence, in their order.

    Args:
        translation: What to say.
        stamp: When the text was received.
        utterance_id: Names the text; not empty.
    """
    messages: list[SignSentence] = []
    for index, sentence in enumerate(translation.sentences):
        message = SignSentence()
        message.header.stamp = stamp
        message.utterance_id = utterance_id
        message.sentence_index = index
        message.sentence_count = len(translation.sentences)
        message.text = sentence.text
        message.language = translation.language
        message.type = int(sentence.type)
        message.negated = sentence.negated
        message.confidence = sentence.confidence
        message.uncertain = sentence.uncertain
        message.dropped = list(sentence.dropped)
        message.tokens = [
            SignToken(
                gloss=token.gloss,
                kind=int(token.kind),
                confidence=token.confidence,
                duration_scale=token.duration_scale,
                word_index=token.word_index,
                source_words=list(token.source_words),
                origin=int(token.origin),
                inflection=token.inflection,
            )
            for token in sentence.tokens
        ]
        messages.append(message)
    return messages
