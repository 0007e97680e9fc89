# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The main job, from one command: a text in, a robot signing it out.

Starts translator, executor, driver and a recorder as processes, publishes the text as anyone would, waits
until the robot rests again, and leaves the bag, a film and a film strip. Exit status 0: all was signed.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import numpy as np
import rclpy
import reservation
import typer
from film import FRAMES_PER_SECOND, LiveFilm
from progress import Progress
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from rich.console import Console
from rich.table import Table
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from teo_sign_msgs.msg import ExecutorStatus, SignSentence, SignToken, TranslationStatus

from teo_bringup.graph import SIGNING, Graph, GraphError
from teo_description.errors import DescriptionError
from teo_description.humanoid import DEFAULT_ROBOT, load_humanoid
from teo_description.pictures.rendering import camera_named, film_strip, render_pose, save_png
from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, load_language

RECORDED = (
    "text",
    "sign_tokens",
    "joint_trajectory",
    "joint_states",
    "robot_description",
    "executor_status",
)
#: Who must listen to what before the text is published: processes of the graph, and the spectator.
LISTENERS = {
    "text": {"translator", "rosbag2_recorder"},
    "sign_tokens": {"executor", "rosbag2_recorder", "demo_spectator"},
    "joint_trajectory": {"teo_sim_driver", "rosbag2_recorder"},
    "joint_states": {"executor", "rosbag2_recorder", "demo_spectator"},
    "executor_status": {"rosbag2_recorder", "demo_spectator"},
    "translation_status": {"demo_spectator"},
}
START_TIMEOUT = 120.0  # [s] for every process to be there: 3 s; 30 beside ten times what a machine can do
TRANSLATION_TIMEOUT = 30.0  # [s] from the text to its tokens: a slow machine takes 1 s
# [s] that a sentence may take: a thousand letters at two seconds each, the most that one message holds.
SIGNING_TIMEOUT = 2000.0
KINDS = {
    SignToken.KIND_LEXICAL: "sign",
    SignToken.KIND_LETTER: "letter",
    SignToken.KIND_NUMBER: "number",
    SignToken.KIND_PAUSE: "pause",
}
#: How a token came about, as the table names it: what is not the word's own sign can be told.
ORIGINS = {
    SignToken.ORIGIN_UNKNOWN: "",
    SignToken.ORIGIN_MODEL: "model",
    SignToken.ORIGIN_LEMMA: "lemma",
    SignToken.ORIGIN_SYNONYM: "synonym",
    SignToken.ORIGIN_SPELLED: "spelled",
    SignToken.ORIGIN_NUMBER: "number",
    SignToken.ORIGIN_REPAIRED: "repaired",
    SignToken.ORIGIN_WORD_LIST: "word list",
    SignToken.ORIGIN_PAUSE: "",
    SignToken.ORIGIN_PARAPHRASE: "paraphrase",
}


class DemoError(Exception):
    """The demo could not do its job; the message says what was expected and what came."""


class Spectator(Node):
    """Sees what any other participant of the graph can see, and films it."""

    def __init__(self, film: LiveFilm) -> None:
        super().__init__("demo_spectator")
        self.progress = Progress()
        self.states: list[tuple[float, dict[str, float]]] = []
        self._film = film
        self._filming = False
        self._next_frame: float | None = None
        # What both keep for us is heard even if they find us after they have said it.
        kept = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(JointState, "joint_states", self._on_state, 100)
        self.create_subscription(SignSentence, "sign_tokens", self.progress.on_tokens, kept)
        self.create_subscription(TranslationStatus, "translation_status", self.progress.on_translation, 10)
        self.create_subscription(ExecutorStatus, "executor_status", self.progress.on_status, kept)
        self._text = self.create_publisher(String, "text", 10)

    def say(self, text: str) -> None:
        """Publish the text that is to be signed."""
        self._text.publish(String(data=text))

    def is_heard(self, topic: str) -> bool:
        """Whether everybody who is to hear a topic listens to it."""
        found = {endpoint.node_name for endpoint in self.get_subscriptions_info_by_topic(topic)}
        # Who is known to listen is not yet matched with what is published here.
        matched = topic != "text" or self._text.get_subscription_count() >= len(LISTENERS["text"])
        return matched and found >= LISTENERS[topic]

    def start_filming(self) -> None:
        """Keep and film every state from now on."""
        self._filming = True

    def _on_state(self, message: JointState) -> None:
        now = seconds(message.header.stamp)
        if not self._filming:
            self.states = [(now, {})]
            return
        positions = dict(zip(message.name, message.position, strict=True))
        self.states.append((now, positions))
        if self._next_frame is None:
            self._next_frame = now
        while now >= self._next_frame:  # more than once where states came late: the film keeps the time
            self._next_frame += 1.0 / FRAMES_PER_SECOND
            self._film.add(positions, self._caption(now))

    def _caption(self, now: float) -> str:
        for index, status in self.progress.started.items():
            elapsed = now - seconds(status.header.stamp)
            if 0.0 <= elapsed <= status.duration:
                timing = self.progress.timing_at(index, elapsed)
                text = self.progress.sentences[index].text if index in self.progress.sentences else ""
                return f"{text}   {captioned(timing.token)}" if timing else text
        return ""

    def state_at(self, moment: float) -> dict[str, float]:
        """Positions [rad] by joint name at the sample nearest to a moment [s]."""
        return min(self.states, key=lambda state: abs(state[0] - moment))[1]


def captioned(token: SignToken) -> str:
    """Give a token's gloss, and the word that it stands for where it is not that word's own sign.

    `~` says that it is one of several signs for the word, `-` a letter of it.
    """
    marks = {
        SignToken.ORIGIN_PARAPHRASE: "~",
        SignToken.ORIGIN_SPELLED: "-",
    }
    mark = marks.get(token.origin)
    if mark is None or not token.source_words:
        return str(token.gloss)
    return f"{token.gloss} {mark} {' '.join(token.source_words)}"


def seconds(stamp: object) -> float:
    """Give a message's stamp in seconds."""
    return float(Time.from_msg(stamp).nanoseconds) * 1e-9


def sign(text: str, out: Path, console: Console, *, robot: str, language: str, view: bool) -> bool:
    """Have the text signed; True if all of it was.

    Args:
        text: In the spoken language.
        out: Folder for what the run leaves.
        console: Where it says what happens.
        robot: Name of the robot.
        language: Code of the sign language.
        view: Whether to serve the console's page, and to go on until Ctrl-C.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    shutil.rmtree(out / "bag", ignore_errors=True)
    began = time.monotonic()
    with Graph(out / "log") as graph:
        nodes = (*SIGNING, "console") if view else SIGNING
        graph.start_nodes(nodes, ["--ros-args", "-p", f"robot:={robot}", "-p", f"language:={language}"])
        record = ("ros2", "bag", "record", "-o", str(out / "bag"), "--include-unpublished-topics")
        made_for = ("--custom-data", f"robot={robot}", f"language={language}")
        graph.start("recorder", *record, *made_for, "--topics", *RECORDED)
        rclpy.init()
        try:
            with LiveFilm(out / "signing.mp4", robot) as film:
                spectator = Spectator(film)
                executor = SingleThreadedExecutor()
                executor.add_node(spectator)
                perform(text, graph, spectator, executor, console, view=view)
        finally:
            rclpy.try_shutdown()
        if not film.whole:
            raise DemoError(f"expected a film at {out / 'signing.mp4'}; the process that draws it failed")
        if graph.stop("recorder") != 0:
            raise DemoError(f"expected the recorder to end cleanly:\n{graph.tail('recorder')}")
        report(spectator, out, console, robot=robot, took=time.monotonic() - began)
        if view:
            keep_open(graph, console)
    return spectator.progress.signed


def report(spectator: Spectator, out: Path, console: Console, *, robot: str, took: float) -> None:
    """Say what was signed, and what the run has left; `took` is how long it was [s]."""
    draw_strip(spectator, out / "signing.png", robot)
    console.print(table(spectator.progress))
    moved = sum(status.duration for status in spectator.progress.started.values())
    console.print(f"signing took {moved:.1f} s, the whole run {took:.1f} s; left in {out}/:")
    console.print("  bag/ (MCAP), signing.mp4, signing.png, log/")
    for refusal in spectator.progress.refusals:
        console.print(f"not signed: {refusal}", style="red", markup=False)


def keep_open(graph: Graph, console: Console) -> None:
    """Leave the nodes and the page as they are until Ctrl-C, or until one of them ends.

    Raises:
        DemoError: One of them ended.
    """
    console.print("the robot waits for more on the page; Ctrl-C ends it")
    try:
        name, status = graph.wait()
    except KeyboardInterrupt:
        return
    raise DemoError(f"expected {name} to keep running, it ended with status {status}:\n{graph.tail(name)}")


def page_of(said: str) -> str:
    """Find the page's address in what the console said; empty while it has not said it."""
    found = re.search(r"http://\S+", said)
    return found.group() if found else ""


def perform(
    text: str,
    graph: Graph,
    spectator: Spectator,
    executor: SingleThreadedExecutor,
    console: Console,
    *,
    view: bool,
) -> None:
    """Publish the text once everybody listens, and wait until the robot is at rest again."""

    def wait(condition: Callable[[], bool], timeout: float, expected: str, process: str) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            graph.check()
            if time.monotonic() > deadline:
                raise DemoError(
                    f"expected {expected} within {timeout:.0f} s; {process} said:\n{graph.tail(process)}"
                )
            executor.spin_once(timeout_sec=0.1)

    with console.status("starting translator, executor, driver and recorder"):
        wait(
            lambda: (
                graph.is_ready(*SIGNING)
                and bool(spectator.states)
                and all(map(spectator.is_heard, LISTENERS))
            ),
            START_TIMEOUT,
            f"every process to listen ({', '.join(LISTENERS)})",
            "executor",
        )
    if view:
        wait(lambda: bool(page_of(graph.tail("console"))), START_TIMEOUT, "the console's page", "console")
        console.print(f"the page is at {page_of(graph.tail('console'))}", markup=False)
    spectator.start_filming()
    console.print(f"signing: {text}", markup=False)
    spectator.say(text)
    progress = spectator.progress
    with console.status("translating"):
        wait(
            lambda: progress.expected > 0 or bool(progress.untranslated),
            TRANSLATION_TIMEOUT,
            "sign tokens",
            "translator",
        )
    if progress.untranslated:
        raise DemoError(f"not signed: {progress.untranslated}")
    with console.status("the robot is signing"):
        wait(lambda: progress.finished, SIGNING_TIMEOUT, "rest after the last sentence", "executor")


def draw_strip(spectator: Spectator, path: Path, robot: str) -> None:
    """Draw the middle of every sign, between rest and rest."""
    frames, captions = [spectator.states[1][1]], ["(rest)"]
    for _, status in sorted(spectator.progress.started.items()):
        start = seconds(status.header.stamp)
        for timing in status.timings:
            frames.append(spectator.state_at(start + timing.start + timing.duration / 2))
            captions.append(timing.token.gloss or "(pause)")
    frames.append(spectator.states[-1][1])
    captions.append("(rest)")
    views = [camera_named(camera, load_humanoid(robot)).sized(330, 400) for camera in ("front", "hand")]
    pictures = [
        # The body tells where a sign is made, the hand which one it is.
        np.hstack([render_pose(frame, view, robot=robot) for view in views])
        for frame in frames
    ]
    save_png(path, film_strip(pictures, captions, columns=4))


def table(progress: Progress) -> Table:
    """Lay out every token with its times, measured from the first movement."""
    result = Table(
        "token", "kind", "origin", r"start \[s]", r"duration \[s]", "stretch", title="What was signed"
    )
    first = min((seconds(status.header.stamp) for status in progress.started.values()), default=0.0)
    for _, status in sorted(progress.started.items()):
        begin = seconds(status.header.stamp) - first
        for timing in status.timings:
            result.add_row(
                timing.token.gloss or "-",
                KINDS[timing.token.kind],
                ORIGINS.get(timing.token.origin, "?"),
                f"{begin + timing.start:.2f}",
                f"{timing.duration:.2f}",
                f"{timing.stretch:.2f}",
            )
        result.add_section()
    return result


def main(
    text: Annotated[str, typer.Argument(help="Text in the spoken language, one or more sentences.")],
    out: Annotated[Path, typer.Option(help="Folder for what the run leaves.")] = Path("out"),
    robot: Annotated[str, typer.Option(help="Name of the robot.")] = DEFAULT_ROBOT,
    language: Annotated[str, typer.Option(help="Sign language, by its ISO 639-3 code.")] = DEFAULT_LANGUAGE,
    view: Annotated[bool, typer.Option(help="Serve the console's page, and go on until Ctrl-C.")] = False,
) -> None:
    """Sign TEXT with a simulated robot."""
    console = Console()
    try:
        with reservation.folder(out), reservation.domain() as domain:
            console.print(f"in domain {domain}: `export ROS_DOMAIN_ID={domain}` lets another shell see it")
            known = load_language(language).code
            name = load_humanoid(robot).name
            signed = sign(text, out, console, robot=name, language=known, view=view)
    except (DemoError, GraphError, DescriptionError, LanguageError, reservation.OccupiedError) as error:
        console.print(str(error), style="red", markup=False)
        signed = False
    if not signed:
        sys.exit(1)


if __name__ == "__main__":
    typer.run(main)
