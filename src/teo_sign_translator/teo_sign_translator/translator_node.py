"""`translator_node`: Spanish text in, sign tokens out."""

from __future__ import annotations

import time
import traceback
import uuid
from collections.abc import Iterable, Sequence
from typing import Any

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from teo_sign_msgs.msg import SignSentence
from teo_sign_msgs.srv import Translate

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.messages import to_messages
from teo_sign_translator.parameters import PARAMETERS, SIGN_TOKENS_DEPTH
from teo_sign_translator.translator import Translator

#: Texts that wait while one is translated; translating takes milliseconds, so this is many people typing at
#: once.
TEXT_DEPTH = 10

# A log line shows this much of a text [characters].
_LOGGED_LENGTH = 80


class TranslatorNode(Node):
    """Answers texts in the order in which they come. Owns no language logic: see `translator.Translator`."""

    def __init__(
        self, *, context: Context | None = None, parameter_overrides: Iterable[Parameter] = ()
    ) -> None:
        """Load the model, then listen.

        Args:
            context: The ROS context; the default one if None.
            parameter_overrides: Values in place of the defaults of `parameters.PARAMETERS`.

        Raises:
            TranslationError: If the model cannot be loaded.
        """
        super().__init__("translator", context=context, parameter_overrides=list(parameter_overrides))
        for parameter in PARAMETERS:
            self.declare_parameter(parameter.name, parameter.default, parameter.descriptor())
        self._translator = self._load(self._value("model"), self._value("min_confidence"))
        self._next_translator: Translator | None = None
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._apply_parameters)
        reliable = ReliabilityPolicy.RELIABLE
        self._tokens = self.create_publisher(
            SignSentence, "sign_tokens", QoSProfile(depth=SIGN_TOKENS_DEPTH, reliability=reliable)
        )
        self.create_subscription(
            String, "text", self._on_text, QoSProfile(depth=TEXT_DEPTH, reliability=reliable)
        )
        self.create_service(Translate, "translate", self._on_translate)
        self.get_logger().info(f"ready, model {self._translator.name}")

    def _on_text(self, message: String) -> None:
        try:
            sentences = self._translate(message.data)
        except TranslationError as error:
            self.get_logger().warning(f"refused {_shown(message.data)}: [{error.code}] {error}")
            return
        except Exception:  # a fault of ours with one text must not keep the node from the next
            self.get_logger().error(f"failed on {_shown(message.data)}:\n{traceback.format_exc()}")
            return
        for sentence in sentences:
            self._tokens.publish(sentence)
        if self._tokens.get_subscription_count() == 0:
            self.get_logger().warning("nobody listens to sign_tokens: this text will not be signed")

    def _on_translate(self, request: Translate.Request, response: Translate.Response) -> Translate.Response:
        try:
            response.sentences = self._translate(request.text)
            response.success = True
        except TranslationError as error:
            response.code = error.code
            response.message = str(error)
        except Exception as error:  # likewise
            self.get_logger().error(f"failed on {_shown(request.text)}:\n{traceback.format_exc()}")
            response.code = "internal_error"
            response.message = f"the translator failed on this text: {error!r}; its log says more"
        return response

    def _translate(self, text: str) -> list[SignSentence]:
        """A text as messages.

        Raises:
            TranslationError: If it cannot be translated, or has more than `max_sentences`.
        """
        stamp = self.get_clock().now().to_msg()
        started = time.perf_counter()
        translation = self._translator.translate(text)
        elapsed = time.perf_counter() - started
        most = self._value("max_sentences")
        if len(translation.sentences) > most:
            raise TranslationError(
                "too_many_sentences",
                f"expected at most {most} sentences in one text (parameter max_sentences), got "
                f"{len(translation.sentences)}: send it in parts",
            )
        self.get_logger().info(f"{_shown(text)}: {_short(str(translation))} ({elapsed * 1000:.1f} ms)")
        if translation.ignored:
            self.get_logger().warning(
                f"nothing stands for {_short(' '.join(map(ascii, translation.ignored)))}"
            )
        return to_messages(translation, stamp=stamp, utterance_id=str(uuid.uuid4()))

    def _check_parameters(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        """Load what the new values ask for, so that a model which cannot be used is refused."""
        asked = {parameter.name: parameter.value for parameter in parameters}
        if not {"model", "min_confidence"} & asked.keys():
            return SetParametersResult(successful=True)
        try:
            self._next_translator = self._load(
                asked.get("model", self._value("model")),
                asked.get("min_confidence", self._value("min_confidence")),
            )
        except TranslationError as error:
            return SetParametersResult(successful=False, reason=f"[{error.code}] {error}")
        return SetParametersResult(successful=True)

    def _apply_parameters(self, _: Sequence[Parameter]) -> None:
        if self._next_translator is not None:
            self._translator, self._next_translator = self._next_translator, None
            self.get_logger().info(f"model {self._translator.name}")

    def _load(self, model: str, min_confidence: float) -> Translator:
        return Translator.load(model, min_confidence=min_confidence)

    def _value(self, name: str) -> Any:
        return self.get_parameter(name).value


def _shown(text: str) -> str:
    """A text in quotes, with characters that could upset a terminal escaped."""
    return _short(repr(text))


def _short(text: str) -> str:
    return text if len(text) <= _LOGGED_LENGTH else text[: _LOGGED_LENGTH - 1] + "…"


def main(args: list[str] | None = None) -> None:
    """Run the node until it is told to stop."""
    rclpy.init(args=args)
    node: TranslatorNode | None = None
    try:
        node = TranslatorNode()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except TranslationError as error:
        rclpy.logging.get_logger("translator").fatal(f"[{error.code}] {error}")
        raise SystemExit(1) from None
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
