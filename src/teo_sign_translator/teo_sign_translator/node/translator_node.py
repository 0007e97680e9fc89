# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`translator_node`: text in, sign tokens out."""

from __future__ import annotations

import threading
import traceback
import uuid
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from rcl_interfaces.msg import SetParametersResult
from rclpy.context import Context
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from std_msgs.msg import String
from teo_sign_msgs.msg import SignSentence, SignToken, TranslationStatus
from teo_sign_msgs.srv import Translate

from teo_common.diagnostics import DIAGNOSTICS_PERIOD, DiagnosticsPublisher
from teo_common.node_process import SelfStartingNode, run_self_starting
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.node.diagnostics import Statistics, diagnose, quoted, short
from teo_sign_translator.node.parameters import PARAMETERS, SIGN_TOKENS_DEPTH
from teo_sign_translator.node.sign_inventory import SignInventory
from teo_sign_translator.node.text_worker import TextWorker
from teo_sign_translator.output.sign_choice import Substitutes
from teo_sign_translator.output.sign_coverage import read_signs
from teo_sign_translator.output.translation import Translation
from teo_sign_translator.pipeline.translator import Translator

#: Outcomes that DDS keeps for a reader that is slow; a text in a flood of them is refused in a tenth of a
#: millisecond.
_STATUS_DEPTH = 5000

# How long the end of the text that is being translated is awaited [s]; the longest text takes less.
_STOP_TIMEOUT = 5.0

# Refusals of a flood are logged so often [s]; each is counted and published.
_LOG_PERIOD = 1.0

_UNHEARD = "nobody listens to sign_tokens: the text is signed once an executor does, if that is soon"

_NOT_ACTIVE = TranslationError(
    "not_active", "the translator is being stopped: activate it, then send the text again"
)


#: Parameters that a translator is loaded anew for.
_OF_THE_MODEL = {"language", "model", "beam_width"}


class _Text(NamedTuple):
    """A text, when it came, what it is called from then on, and the translator that was in use."""

    text: str
    received: Time
    utterance_id: str
    translator: Translator | None

    @property
    def language(self) -> str:
        """Code of the sign language that it is translated into; empty if nothing translates it."""
        return "" if self.translator is None else self.translator.language


class TranslatorNode(SelfStartingNode):
    """Answers texts in the order in which they come. Owns no language logic: see `translator.Translator`.

    Unconfigured: no model. Inactive: the model is loaded and the `translate` service answers. Active: texts
    of the topic are answered too.
    """

    def __init__(
        self, *, context: Context | None = None, parameter_overrides: Iterable[Parameter] = ()
    ) -> None:
        """Declare the parameters; the transitions do the rest.

        Args:
            context: The ROS context; the default one if None.
            parameter_overrides: Values in place of the defaults of `parameters.PARAMETERS`.
        """
        super().__init__("translator", PARAMETERS, context=context, parameter_overrides=parameter_overrides)
        self._translator: Translator | None = None
        self._next_translator: Translator | None = None
        self._inventory: SignInventory | None = None
        self._worker: TextWorker[_Text] | None = None
        self._translating = threading.Lock()
        self._statistics = Statistics()
        self._diagnostics = DiagnosticsPublisher(self, "texts")
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._apply_parameters)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002 - the API's
        """Load the model; serve `translate` and publish diagnostics."""
        try:
            translator = self._load({})
            listed = _listed_signs(self._value("signs_file"))
        except TranslationError as error:
            self.get_logger().error(f"cannot be configured: [{error.code}] {error}")
            return TransitionCallbackReturn.FAILURE
        reliable = ReliabilityPolicy.RELIABLE
        # Kept for an executor that begins to listen later: it knows what it has signed already.
        kept = QoSProfile(
            depth=SIGN_TOKENS_DEPTH, reliability=reliable, durability=DurabilityPolicy.TRANSIENT_LOCAL
        )
        self._tokens = self.create_lifecycle_publisher(SignSentence, "sign_tokens", kept)
        self._outcomes = self.create_publisher(
            TranslationStatus, "translation_status", QoSProfile(depth=_STATUS_DEPTH, reliability=reliable)
        )
        self._service = self.create_service(Translate, "translate", self._on_translate)
        self._timer = self.create_timer(DIAGNOSTICS_PERIOD, self._publish_diagnostics)
        self._inventory = SignInventory(self, listed)
        self._translator = translator
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Listen to `text`."""
        result = super().on_activate(state)
        self._worker = TextWorker(self._answer_text, size=self._value("queue_size"))
        # DDS keeps all of a flood while a callback runs: it is our own queue that is full, and says so.
        qos = QoSProfile(history=HistoryPolicy.KEEP_ALL, reliability=ReliabilityPolicy.RELIABLE)
        self._texts = self.create_subscription(String, "text", self._on_text, qos)
        assert self._translator is not None
        self.get_logger().info(f"ready, language {self._translator.language}, model {self._translator.name}")
        return result

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Listen no more; texts that still wait are refused."""
        self._stop_listening()
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002 - the API's
        """Release the model, and the service, publisher and timer that use it."""
        self._let_go()
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Finish the text at hand and let go of everything."""
        self._stop_listening()
        self._let_go()
        return super().on_shutdown(state)

    def destroy_node(self) -> None:
        """Finish the text at hand, then end."""
        self._stop_listening()
        super().destroy_node()

    def _stop_listening(self) -> None:
        worker, self._worker = self._worker, None
        if worker is None:
            return
        self.destroy_subscription(self._texts)
        for item in worker.stop(_STOP_TIMEOUT):
            self._refuse(item, _NOT_ACTIVE)

    def _let_go(self) -> None:
        if self._translator is None:
            return
        assert self._inventory is not None
        self._inventory.close()
        self.destroy_timer(self._timer)
        self.destroy_service(self._service)
        self.destroy_lifecycle_publisher(self._tokens)
        self.destroy_publisher(self._outcomes)
        self._translator = self._inventory = None

    def _on_text(self, message: String) -> None:
        item = self._received(message.data)
        if self._worker is None:  # taken from the topic just before the node was deactivated
            self._refuse(item, _NOT_ACTIVE)
        elif not self._worker.offer(item):
            full = f"{self._worker.size} texts wait already: send fewer at a time"
            self._refuse(item, TranslationError("queue_full", full))

    def _received(self, text: str) -> _Text:
        return _Text(text, self.get_clock().now(), str(uuid.uuid4()), self._translator)

    def _answer_text(self, item: _Text) -> None:
        """Translate and publish a text of the topic; in the worker's thread."""
        try:
            translation = self._translate(item)
        except TranslationError as error:
            self._refuse(item, error)
            return
        except Exception as error:  # a fault of ours with one text must not keep the node from the next
            self.get_logger().error(f"failed on {quoted(item.text)}:\n{traceback.format_exc()}")
            self._refuse(item, TranslationError("internal_error", f"{error!r}; the log says more"))
            return
        for sentence in _to_messages(translation, item):
            self._tokens.publish(sentence)
        unheard = "" if self._tokens.get_subscription_count() else _UNHEARD
        self._tell(item, sentences=len(translation.sentences), message=unheard)
        self._note(item, translation)
        if unheard:
            self.get_logger().warning(unheard)

    def _on_translate(self, request: Translate.Request, response: Translate.Response) -> Translate.Response:
        item = self._received(request.text)
        try:
            translation = self._translate(item)
            response.sentences = _to_messages(translation, item)
            response.success = True
            self._note(item, translation)
        except TranslationError as error:
            self._statistics.add_refused(f"[{error.code}] {error}")
            response.code = error.code
            response.message = str(error)
        except Exception as error:  # likewise
            self._statistics.add_refused(f"[internal_error] {error!r}")
            self.get_logger().error(f"failed on {quoted(request.text)}:\n{traceback.format_exc()}")
            response.code = "internal_error"
            response.message = f"the translator failed on this text: {error!r}; its log says more"
        return response

    def _translate(self, item: _Text) -> Translation:
        """Translate a text.

        Raises:
            TranslationError: If it cannot be translated, or has more than `max_sentences`.
        """
        # The service and the worker share one model, which need not stand two callers at a time.
        with self._translating:
            assert item.translator is not None
            assert self._inventory is not None
            signs = self._inventory.signs(item.language)
            translation = item.translator.translate(item.text, signs)
        most = self._value("max_sentences")
        if len(translation.sentences) > most:
            raise TranslationError(
                "too_many_sentences",
                f"expected at most {most} sentences in one text (parameter max_sentences), got "
                f"{len(translation.sentences)}: send it in parts",
            )
        return translation

    def _note(self, item: _Text, translation: Translation) -> None:
        """Count a text that was answered, and log it: after the answer, which somebody waits for."""
        elapsed = (self.get_clock().now() - item.received).nanoseconds * 1e-9
        self._statistics.add_done(elapsed)
        self.get_logger().info(f"{quoted(item.text)}: {short(str(translation))} ({elapsed * 1000:.1f} ms)")
        if translation.ignored:
            self.get_logger().warning(
                f"nothing stands for {short(' '.join(map(ascii, translation.ignored)))}"
            )

    def _refuse(self, item: _Text, error: TranslationError) -> None:
        self._statistics.add_refused(f"[{error.code}] {error}")
        self._tell(item, code=error.code, message=str(error))
        self.get_logger().warning(
            f"refused {quoted(item.text)}: [{error.code}] {error} ({self._statistics.refused} so far)",
            throttle_duration_sec=_LOG_PERIOD,
        )

    def _tell(self, item: _Text, *, sentences: int = 0, code: str = "", message: str = "") -> None:
        """Say what became of a text of the topic."""
        outcome = TranslationStatus(
            utterance_id=item.utterance_id,
            code=code,
            message=message,
            text=short(item.text),
            language=item.language,
            sentence_count=sentences,
        )
        outcome.header.stamp = self.get_clock().now().to_msg()
        self._outcomes.publish(outcome)

    def _publish_diagnostics(self) -> None:
        assert self._translator is not None
        assert self._inventory is not None
        signs = self._inventory.signs(self._translator.language)
        self._diagnostics.publish(
            diagnose(
                self._statistics,
                language=self._translator.language,
                model=self._translator.name,
                active=self._worker is not None,
                waiting=self._worker.waiting if self._worker is not None else 0,
                signs=None if signs is None else len(signs),
            )
        )

    def _check_parameters(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        """Load what the new values ask for, so that a model which cannot be used is refused."""
        asked = {parameter.name: parameter.value for parameter in parameters}
        try:
            if _OF_THE_MODEL & asked.keys():
                self._next_translator = self._load(asked)
            if "signs_file" in asked:
                _listed_signs(asked["signs_file"])
            if "substitutes" in asked:
                Substitutes.named(asked["substitutes"])
        except TranslationError as error:
            return SetParametersResult(successful=False, reason=f"[{error.code}] {error}")
        return SetParametersResult(successful=True)

    def _apply_parameters(self, parameters: Sequence[Parameter]) -> None:
        if self._translator is None:  # configuring reads them
            return
        asked = {parameter.name: parameter.value for parameter in parameters}
        if _OF_THE_MODEL & asked.keys() and self._next_translator is not None:
            self._translator, self._next_translator = self._next_translator, None
            self.get_logger().info(f"language {self._translator.language}, model {self._translator.name}")
        if "min_confidence" in asked:
            self._translator.min_confidence = asked["min_confidence"]
        if "substitutes" in asked:
            self._translator.substitutes = Substitutes.named(asked["substitutes"])
        if "queue_size" in asked and self._worker is not None:
            self._worker.size = asked["queue_size"]
        if "signs_file" in asked and self._inventory is not None:
            self._inventory.list(_listed_signs(asked["signs_file"]))

    def _load(self, asked: dict[str, Any]) -> Translator:
        """A translator with the parameters' values, and with those of `asked` that are about to be set."""
        names = ("language", "model", "beam_width", "min_confidence", "substitutes")
        values = {name: self._value(name) for name in names} | asked
        return Translator.load(
            values["model"],
            language=values["language"],
            beam_width=values["beam_width"],
            min_confidence=values["min_confidence"],
            substitutes=Substitutes.named(values["substitutes"]),
        )


def _listed_signs(file: str) -> frozenset[str] | None:
    """The glosses of a file or folder that the parameter `signs_file` names; None if it names none."""
    return read_signs(Path(file)) if file else None


def _to_messages(translation: Translation, item: _Text) -> list[SignSentence]:
    """One message for each sentence, in their order, stamped with the time at which the text came."""
    messages: list[SignSentence] = []
    for index, sentence in enumerate(translation.sentences):
        message = SignSentence(
            utterance_id=item.utterance_id,
            sentence_index=index,
            sentence_count=len(translation.sentences),
            text=sentence.text,
            language=translation.language,
            type=int(sentence.type),
            negated=sentence.negated,
            confidence=sentence.confidence,
            uncertain=sentence.uncertain,
            dropped=list(sentence.dropped),
            tokens=[
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
            ],
        )
        message.header.stamp = item.received.to_msg()
        messages.append(message)
    return messages


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    run_self_starting(TranslatorNode, arguments, PARAMETERS)


if __name__ == "__main__":
    main()
