"""Translations as ROS messages."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from teo_sign_msgs.msg import SignSentence, SignToken
from teo_sign_msgs.srv import ListSigns

from teo_sign_translator.node.text_statistics import Statistics
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
        message.type = int(sentence.type)
        message.negated = sentence.negated
        message.confidence = sentence.confidence
        message.uncertain = sentence.uncertain
        message.tokens = [
            SignToken(
                gloss=token.gloss,
                kind=int(token.kind),
                confidence=token.confidence,
                duration_scale=token.duration_scale,
                word_index=token.word_index,
                source_words=list(token.source_words),
                origin=int(token.origin),
            )
            for token in sentence.tokens
        ]
        messages.append(message)
    return messages


def lexical_glosses(response: ListSigns.Response) -> frozenset[str]:
    """Glosses that have a sign of their own, without letters and numbers."""
    return frozenset(
        gloss
        for gloss, kind in zip(response.glosses, response.kinds, strict=True)
        if kind == SignToken.KIND_LEXICAL
    )


def to_diagnostics(
    statistics: Statistics, *, model: str, active: bool, waiting: int, signs: int | None, stamp: Time
) -> DiagnosticArray:
    """How the translator is.

    Args:
        statistics: What it has done.
        model: Name of the model in use.
        active: Whether it listens to texts.
        waiting: Texts that wait.
        signs: Glosses that have signs; None if that is not known.
        stamp: When this is true.
    """
    values = {
        "model": model,
        "state": "active" if active else "inactive",
        "texts done": str(statistics.done),
        "texts refused": str(statistics.refused),
        "texts waiting": str(waiting),
        "latency median [ms]": _milliseconds(statistics.latency(50.0)),
        "latency p99 [ms]": _milliseconds(statistics.latency(99.0)),
        "last refusal": statistics.last_refusal,
        "signs known": "unknown" if signs is None else str(signs),
    }
    status = DiagnosticStatus(
        level=DiagnosticStatus.OK,
        name="translator",
        message=f"{values['state']}, model {model}",
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )
    array = DiagnosticArray(status=[status])
    array.header.stamp = stamp
    return array


def _milliseconds(seconds: float | None) -> str:
    return "" if seconds is None else f"{seconds * 1000:.1f}"
