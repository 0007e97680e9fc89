# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Every command that a page of this project shows is run as it stands there, or named here with the reason.

The commands of one page are run in their order and in one folder. What serves until Ctrl-C goes on until its
block ends, so that the lines below it meet it, and must end well then. A line that stands on several pages is
run on the first of them.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

import pytest
from package_folders import SHELVES

pytestmark = pytest.mark.commands
ROOT = Path(__file__).parents[1]
PAGES = sorted(
    [
        *ROOT.glob("*.md"),
        *ROOT.glob("docs/*.md"),
        *(page for shelf in SHELVES for page in shelf.glob("*/*.md")),
        ROOT / "bags" / "README.md",
    ]
)
#: Typed in network namespaces, machine by machine, by teo_bringup's test_machines.py.
PAGES.remove(ROOT / "docs" / "machines.md")
TIMEOUT = 600.0  # [s] for one command on a loaded machine; the longest takes half a minute on a quiet one

#: What is not run, and why.
NOT_RUN = {
    r"make (test|commands|lint|docs|setup)|\.ci/run|pytest|pre-commit": "is run by .ci/run, or about to",
    r"VIEW=1": "waits for a person at the page; its parts are tested with a browser",
    r"ros2 launch": "needs ROS 2's launch, which is not among the wheels",
    r"--camera|lut record|capture_node": "needs a camera and a person before it",
    r"generate_corpus|train |train_lifting|evaluate |compare |constructions\(\)": "takes minutes to hours",
    r"reproduce_paper": "takes minutes",
    r"capture_(letters|numbers|demonstration)(?!.*--only)|ease_letters|lut ease": "takes minutes",
    r"render --all": "draws hundreds of signs",
    r"plant:=mujoco": "needs the package for physics, which is installed apart",
    r"openpose_json": "needs OpenPose beside it",
    r"--dask": "needs a cluster",
    r"position_direct\(teo, positions\)": "is a piece of a node",
    r"\b(BAG|GLOSS|CLIP|DIR|DIRECTORY)\b|\[|\.\.\. *$": "has a placeholder",
    r"reviews\.json|recordings/|HOLA_1|a\.png|(capture|-o) HOLA ": "wants the reader's own recordings",
}
# An entry that the table names, as SignPuddle exports it; the sign is made up.
SCORES = ROOT / "src" / "teo_sign_languages" / "languages" / "ssp" / "scores"
ENTRY = next(
    named[1]
    for path in sorted(SCORES.glob("*.yaml"))
    if path.stem.isalpha()
    and (named := re.search(r'\(puddle 55\), entry "([^"]+)"', path.read_text("utf-8")))
)
DICTIONARY = f"""<?xml version="1.0" encoding="UTF-8"?>
<spml root="http://www.signpuddle.net" type="sgn" puddle="55">
 <entry id="1"><term>M518x533S1870a489x515</term><term><![CDATA[{ENTRY}]]></term></entry>
</spml>
"""
# The language that a page has its reader write.
LANGUAGE = (ROOT / "docs" / "add-a-language.md").read_text().partition("```yaml\n")[2].partition("```")[0]


class Command(NamedTuple):
    """A line of a page, and what the page says that it prints."""

    line: str
    prints: str = ""
    program: tuple[str, ...] = ("bash", "-c")


Block = list[Command]

#: What serves until Ctrl-C.
SERVES = re.compile(r"make run|teo_bringup up|_node\b|topic echo(?!.*--once)|&$")
#: What records until Ctrl-C; the lines below want the recording.
RECORDS = re.compile(r"bag record")
#: Pages whose lines are alternatives: each is run with nothing beside it.
ALTERNATIVES = {"src/teo_bringup/README.md"}
#: Pages whose lines speak to nodes that run already, then those whose consoles want the same port.
BESIDE_NODES = ("tools/teo_ros2cli/README.md", "docs/console.md")
CONSOLES = (*BESIDE_NODES, "docs/index.md", "src/teo_bringup/README.md", "src/teo_console/README.md")
NODES = Command("ros2 run teo_bringup up translator executor driver console")
#: Lines that need what runs beside them.
SPEAKS = re.compile(r"ros2 (topic|bag (record|play))")
#: Pages whose blocks need nothing of one another.
PARTED = {"README.md"}
#: Pages that take longest.
LONGEST = ("src/teo_sign_capture/CAPTURE.md", "docs/add-a-robot.md", CONSOLES[0])


def name_of(page: Path) -> str:
    return str(page.relative_to(ROOT))


def blocks(page: Path) -> Iterator[Block]:
    for language, text in re.findall(r"^```(console|sh|python)\n(.*?)^```", page.read_text(), re.S | re.M):
        joined = text.replace("\\\n", " ")
        if language == "python":
            yield [Command(text, program=("python", "-c"))]
        elif language == "sh":
            yield [Command(line) for line in joined.splitlines() if line.strip()]
        else:
            shown = re.split(r"^\$ ", joined, flags=re.M)[1:]
            yield [Command(line, rest) for line, _, rest in (part.partition("\n") for part in shown)]


def reason_not_to_run(line: str) -> str | None:
    code = line.split(" #")[0]
    return next((reason for pattern, reason in NOT_RUN.items() if re.search(pattern, code)), None)


class Part(NamedTuple):
    """A page, or a block of one that stands by itself."""

    page: str
    blocks: list[Block]


def has_work(block: Block) -> bool:
    return any(reason_not_to_run(command.line) is None for command in block)


def groups() -> Iterator[list[Part]]:
    """What runs in one folder after another: pages whose consoles want one port; every other page alone."""
    yield [Part(name, list(blocks(ROOT / name))) for name in CONSOLES]
    for page in PAGES:
        name, shown = name_of(page), list(blocks(page))
        if name in PARTED:
            yield from ([Part(name, [block])] for block in shown if has_work(block))
        elif name not in CONSOLES and any(map(has_work, shown)):
            yield [Part(name, shown)]


def dealt(all_groups: Iterable[list[Part]]) -> list[list[Part]]:
    """Every second group is a long one as long as there are any: a worker takes two at a time."""
    long: list[list[Part]] = []
    short: list[list[Part]] = []
    for group in all_groups:
        (long if group[0].page in (*LONGEST, *PARTED) else short).append(group)
    return [group for pair in zip_longest(long, short) for group in pair if group is not None]


GROUPS = dealt(groups())


def code_of(line: str) -> str:
    """A line without its comment and its spaces."""
    return " ".join(line.split(" #")[0].split())


def first_places() -> dict[str, str]:
    """The page on which each of the project's own commands stands first; what is short is run everywhere."""
    places = {NODES.line: CONSOLES[0]}
    for part in (part for group in GROUPS for part in group):
        for command in (command for block in part.blocks for command in block):
            if re.match("ros2 run|make demo", command.line):
                places.setdefault(code_of(command.line), part.page)
    return places


FIRST = first_places()


class Beside:
    """The nodes that pages of `BESIDE_NODES` speak to: from the first line that does until others start."""

    def __init__(self) -> None:
        self._running = ExitStack()
        self.started = False

    def start(self, folder: Path) -> None:
        if not self.started:
            self._running.enter_context(served(NODES, folder))
            self.started = True

    def stop(self) -> None:
        self.started = False
        self._running.close()


def readers_folder(folder: Path) -> Path:
    """A folder with what a reader would have there: the checkout, and files of his own."""
    folder.mkdir()
    (folder / "test").symlink_to(ROOT / "test")
    (folder / "src").mkdir()
    robots = Path("src") / "teo_description"  # no command changes it
    (folder / robots).symlink_to(ROOT / robots)
    shutil.copytree(ROOT / "bags", folder / "bags")
    (folder / "env.sh").write_text(f". {ROOT}/env.sh\n")
    make = f"@$(MAKE) --no-print-directory -C {ROOT} OUT=$(CURDIR)/out"
    (folder / "Makefile").write_text(f"%:\n\t{make} $@\n")
    (folder / "my.yaml").write_text("driver:\n  ros__parameters:\n    publish_rate: 50.0\n")
    (folder / "sentences.txt").write_text("Hola.\nBuenos días.\n")
    film = ROOT / "src" / "teo_console" / "test" / "data" / "greeting.mp4"
    shutil.copy(film, folder / "GRAPADORA.mp4")
    (folder / "clips").mkdir()
    shutil.copy(film, folder / "clips" / "HOLA.mp4")
    (folder / "sgn55.spml").write_text(DICTIONARY)
    (folder / "language.yaml").write_text(LANGUAGE)
    return folder


def kill(process: subprocess.Popen[str]) -> None:
    """Kill a process that may run still, and what it started."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def ended(process: subprocess.Popen[str]) -> str:
    """What a process printed that is told to end, and must end well."""
    os.killpg(process.pid, signal.SIGINT)
    said, _ = process.communicate(timeout=TIMEOUT)
    # As `make` and `ros2` (signal.SIGINT is 2) tell of an interruption, or as if there had been none.
    assert process.returncode in (0, 2, 130, -signal.SIGINT), said
    assert "Traceback" not in said
    return said


@contextmanager
def served(command: Command, folder: Path) -> Iterator[None]:
    """Have a command run that serves, once it has said that it can, or, of what never says so, at once."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as notices:
        notices.bind("")
        notices.settimeout(0.2)
        address = notices.getsockname().decode().replace("\0", "@", 1)
        process = begin(command, folder, notices=address)
        try:
            if re.search(r"make run|teo_bringup up|_node\b", command.line):
                wait_until_ready(notices, process)
            yield
            ended(process)
        finally:
            kill(process)


def wait_until_ready(notices: socket.socket, process: subprocess.Popen[str]) -> None:
    deadline = time.monotonic() + TIMEOUT
    while True:
        try:
            assert b"READY=1" in notices.recv(4096)
            return
        except TimeoutError:
            assert process.poll() is None, process.communicate()[0]
            assert time.monotonic() < deadline, "not ready"


def begin(command: Command, folder: Path, *, notices: str = "") -> subprocess.Popen[str]:
    line = command.line
    if command.program[0] == "bash" and re.match("ros2|make", line):
        line = f"exec {line.rstrip('& ')}"  # so that signals reach the command
    return subprocess.Popen(
        [*command.program, line],
        cwd=folder,
        env=os.environ | {"NOTIFY_SOCKET": notices},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )


def record(command: Command, folder: Path) -> None:
    """Record until there is a file to close."""
    process = begin(command, folder)
    try:
        deadline = time.monotonic() + TIMEOUT
        while not list(folder.glob("*/*.mcap")):
            assert process.poll() is None, process.communicate()[0]
            assert time.monotonic() < deadline
            time.sleep(0.05)
        ended(process)
    finally:
        kill(process)


def run(command: Command, folder: Path) -> None:
    process = begin(command, folder)
    try:
        said, _ = process.communicate(timeout=TIMEOUT)
    finally:
        kill(process)
    assert "Traceback" not in said, said
    if re.match(r"[a-z]+_[a-z_]+: ", command.prints):  # the page shows a refusal: its reason comes first
        assert process.returncode != 0
        assert said.startswith(command.prints.partition(":")[0]), said
    else:
        assert process.returncode == 0, said
    if " translate " in command.line and command.prints:
        assert said == command.prints


def name_of_group(group: list[Part]) -> str:
    return ",".join(f"{part.page}: {part.blocks[0][0].line[:30]}" for part in group)


@pytest.mark.parametrize("parts", GROUPS, ids=name_of_group)
def test_the_commands_of_a_page_do_what_it_shows(
    parts: list[Part],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    domain_id: int,  # noqa: ARG001
) -> None:
    failures = []
    beside = Beside()
    for number, part in enumerate(parts):
        folder = readers_folder(tmp_path / str(number))
        if part.page.startswith("bags/"):  # that page makes the bag
            shutil.rmtree(folder / "bags" / "signer_d435")
        # His table and the executor's journal.
        monkeypatch.setenv("HOME", str(folder))
        monkeypatch.delenv("XDG_DATA_HOME", raising=False)
        for block in part.blocks:
            try:
                run_block(part.page, block, folder, beside)
            except (AssertionError, subprocess.TimeoutExpired) as error:
                failures.append(f"{part.page}: {block[0].line}\n{error}")
    beside.stop()
    assert not failures, "\n\n".join(failures)


def run_block(page: str, block: Block, folder: Path, beside: Beside) -> None:
    to_run = [
        command
        for command in block
        if reason_not_to_run(command.line) is None and FIRST.get(code_of(command.line), page) == page
    ]
    if any(SERVES.search(code_of(command.line)) for command in to_run):
        beside.stop()
    elif page in BESIDE_NODES and any(SPEAKS.match(command.line) for command in to_run):
        beside.start(folder)
    with ExitStack() as serving:
        for command in to_run:
            if page in ALTERNATIVES:
                serving.close()
            if RECORDS.search(command.line):
                record(command, folder)
            elif SERVES.search(code_of(command.line)):
                serving.enter_context(served(command, folder))
            else:
                run(command, folder)


def test_no_page_with_commands_is_left_out() -> None:
    folders = (ROOT / name for name in ("bags", "deploy", "docs", "src", "studio", "test", "tools"))
    pages = [*ROOT.glob("*.md"), *(page for folder in folders for page in folder.rglob("*.md"))]
    shown = {page for page in pages if list(blocks(page))}
    assert shown - set(PAGES) == {ROOT / "docs" / "machines.md"}


def test_every_reason_not_to_run_something_is_needed() -> None:
    lines = [command.line.split(" #")[0] for page in PAGES for block in blocks(page) for command in block]
    assert [pattern for pattern in NOT_RUN if not any(re.search(pattern, line) for line in lines)] == []
