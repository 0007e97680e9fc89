# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut record`: a sign from the person before the camera, now. It listens as a ROS node."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.live import Live
from rich.text import Text

from teo_description.humanoid import DEFAULT_ROBOT
from teo_sign_capture.cli import options
from teo_sign_capture.cli.reporting import TerminalReporter, fail
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.look_up_table import user_lut_directory

_SPIN = 0.05  # [s] between two looks at the clock
_output = Console(highlight=False)


def record(
    gloss: Annotated[str, typer.Option(help="Name of the sign.", callback=options.upper_case)],
    countdown: Annotated[float, typer.Option(help="Seconds until the sign is to begin.")] = 3.0,
    robot: options.RobotName = DEFAULT_ROBOT,
    language: options.LanguageCode = DEFAULT_LANGUAGE,
    lut: options.TableDirectory = None,
    replace: options.Replace = False,
    kind: options.KindOption = "lexical",
    standing: options.StandingOption = "recorded",
    licence: options.Licence = options.NOT_STATED,
    notes: options.Notes = "",
    accept: options.Accept = False,
    picture: options.Picture = None,
    keep: Annotated[
        Path | None, typer.Option(help="Where the recording is kept; the user's cache without it.")
    ] = None,
) -> None:
    """Record a sign of the person before the camera, and capture it. retriever_node must be running.

    Hands at rest during the countdown; then sign, and let the hands return to rest.
    """
    from teo_description.robot import Robot
    from teo_sign_capture.entries.bag_capture import (
        Settings,
        captured_outcome,
        check_free,
        default_recordings,
        keep_and_capture,
    )

    try:
        language = options.known_language(robot, language)
        table = lut or user_lut_directory(language, robot)
        settings = Settings(
            table=table,
            robot=robot,
            language=language,
            replace=replace,
            kind=kind,
            standing=standing,
            licence=licence,
            notes=notes,
            accept=accept,
            pictures=picture or table,
        )
        check_free(gloss, settings)
        messages = _listen(countdown)
        _output.print(f"{len(messages)} images recorded")
        saved = keep_and_capture(Robot.load(robot), gloss, messages, keep or default_recordings(), settings)
        TerminalReporter().captured(captured_outcome(saved))
    except LutError as error:
        fail(error)


def _listen(countdown: float) -> list[Any]:
    """Messages on `skeletons` from the countdown to the end of the sign."""
    import rclpy
    from teo_sign_msgs.msg import SkeletonArray

    from teo_sign_capture.recordings.live_take import LiveTake, Phase

    rclpy.init()
    try:
        node = rclpy.create_node("lut_record")
        take = LiveTake(started=time.monotonic(), countdown=countdown)
        node.create_subscription(
            SkeletonArray, "skeletons", lambda message: take.add(message, time.monotonic()), 10
        )
        with Live(console=_output, transient=True) as live:
            while True:
                rclpy.spin_once(node, timeout_sec=_SPIN)
                state = take.step(time.monotonic())
                if state.problem is not None:
                    raise state.problem
                if state.phase is Phase.DONE:
                    return take.messages
                if state.phase is Phase.COUNTDOWN:
                    shown = Text(f"hands at rest … {state.remaining:.0f}", style="bold yellow")
                else:
                    left = f"({state.remaining:.0f} s left)"
                    shown = Text(f"sign now, then hands at rest {left}", style="bold green")
                live.update(shown)
    finally:
        rclpy.try_shutdown()
