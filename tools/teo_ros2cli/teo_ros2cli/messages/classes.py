# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The Python class of an interface, by name."""

from __future__ import annotations

import importlib
from typing import Any

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import InterfaceName


def interface_class(text: str, kind: str) -> Any:
    """Load the class of a message, service or action.

    Args:
        text: Name such as `std_msgs/msg/String` or, shorter, `std_msgs/String`.
        kind: What is expected: `msg`, `srv` or `action`.

    Raises:
        Ros2CliError: `invalid_type`, the name has a wrong form or the type is not installed.
    """
    name = InterfaceName.parse(text, kind)
    if name.kind != kind:
        raise Ros2CliError(
            "invalid_type", f"The passed type is invalid: expected a {kind} type, got '{name}'"
        )
    try:
        return getattr(importlib.import_module(f"{name.package}.{name.kind}"), name.type)
    except ModuleNotFoundError as error:
        raise Ros2CliError(
            "invalid_type", f"The passed type '{name}' is invalid: package '{name.package}' is not installed"
        ) from error
    except AttributeError as error:
        raise Ros2CliError(
            "invalid_type", f"The passed type '{name}' is invalid: package '{name.package}' has no such type"
        ) from error
    except ImportError as error:
        raise Ros2CliError("invalid_type", f"The passed type '{name}' cannot be loaded: {error}") from error


def message_class(text: str) -> Any:
    """Load the class of a message type, `pkg/action/Name_FeedbackMessage` of actions included.

    Raises:
        Ros2CliError: `invalid_type`.
    """
    parts = text.split("/")
    if len(parts) == 3 and parts[1] == "action" and parts[2].endswith("_FeedbackMessage"):
        action = interface_class(text.removesuffix("_FeedbackMessage"), "action")
        return action.Impl.FeedbackMessage
    return interface_class(text, "msg")


def interface_name_of(message: Any) -> str:
    """Return the name of a message's type, such as `std_msgs/msg/String`; takes a message or its class."""
    cls = message if isinstance(message, type) else type(message)
    package, kind = cls.__module__.split(".")[:2]
    return f"{package}/{kind}/{cls.__name__}"
