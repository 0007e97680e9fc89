# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Every command that a page of this project shows is run as it stands there, or named here with the reason.

The commands of one page are run in their order and in one folder. What serves until Ctrl-C goes on until its
block ends, so that the lines below it meet it, and must end well then.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
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
TIMEOUT = 300.0  # [s] for one command on a loaded machine; the longest takes half a minute on a quiet one

#: What is not run, and why.
NOT_RUN = {
    r"make (test|commands|lint|docs|setup)|\.ci/run|pytest|pre-commit": "is run by .ci/run, or about to",
    r"VIEW=1": "waits for a person at the page; its parts are tested with a browser",
    r"ros2 launch": "needs ROS 2's launch, which is not among the wheels",
    r"--camera|lut record|capture_node": "needs a camera and a person before it",
    r"generate_corpus|train |evaluate |compare |reproduce_paper|constructions\(\)": "takes minutes to hours",
    r"capture_(letters|numbers|demonstration)(?!.*--only)|ease_letters|lut ease": "takes minutes",
    r"render --all": "draws hundreds of signs",
    r"plant:=mujoco": "needs the package for physics, which is installed apart",
    r"openpose_json": "needs OpenPose beside it",
    r"--dask": "needs a cluster",
    r"position_direct\(positions\)": "is a piece of a node",
    r"\b(BAG|GLOSS|CLIP|DIR|DIRECTORY)\b|\[|\.\.\. *$": "has a placeholder",
    r"reviews\.json|recordings/|HOLA_1|a\.png|(capture|-o) HOLA ": "wants the reader's own recordings",
}
# An entry as SignPuddle exports it; the sign is made up.
DICTIONARY = """<?xml version="1.0" encoding="UTF-8"?>
<spml root="http://www.signpuddle.net" type="sgn" puddle="55">
 <entry id="1"><term>M518x533S1870a489x515</term><term><![CDATA[abuelo 5]]></term></entry>
</spml>
"""
# The language that a page has its reader write.
LANGUAGE = (ROOT / "docs" / "add-a-language.md").read_text().partition("```yaml\n")[2].partition("```")[0]


class Command(NamedTuple):
    """A line of a page, and what the page says that it prints."""

    line: str
    prints: str = ""
    program: tuple[str, ...] = ("bash", "-c")


#: What serves until Ctrl-C.
SERVES = re.compile(r"make run|teo_bringup up|_node\b|topic echo(?!.*--once)|&$")
#: What records until Ctrl-C; the lines below want the recording.
RECORDS = re.compile(r"bag record")
#: Pages whose lines are alternatives: each is run with nothing beside it.
ALTERNATIVES = {"src/teo_bringup/README.md"}
#: Pages with consoles.
CONSOLES = {
    "docs/console.md",
    "docs/index.md",
    *ALTERNATIVES,
    "src/teo_console/README.md",
    "tools/teo_ros2cli/README.md",
}
#: Pages that speak to nodes which run already.
BESIDE_NODES = {"docs/console.md", "docs/index.md", "tools/teo_ros2cli/README.md"}
NODES = Command("ros2 run teo_bringup up translator executor driver console")


def name_of(page: Path) -> str:
    return str(page.relative_to(ROOT))


def blocks(page: Path) -> Iterator[list[Command]]:
    for language, text in re.findall(r"^```(console|sh|python)\n(.*?)^```", page.read_text(), re.S | re.M):
        joined = text.replace("\\\n", " ")
        if language == "python":
            yield [Command(text, program=("python", "-c"))]
        elif language == "sh":
            yield [Command(line) for line in joined.splitlines() if line.strip()]
        else:
            shown = re.split(r"^\$ ", joined, flags=re.M)[1:]
            yield [Command(line, rest) for line, _, rest in (part.partition("\n") for part in shown)]


# Each page by itself, but those together whose consoles want one port.
GROUPS = [
    [page for page in PAGES if name_of(page) in CONSOLES],
    *([page] for page in PAGES if name_of(page) not in CONSOLES and list(blocks(page))),
]


def reason_not_to_run(line: str) -> str | None:
    code = line.split(" #")[0]
    return next((reason for pattern, reason in NOT_RUN.items() if re.search(pattern, code)), None)


def readers_folder(folder: Path) -> Path:
    """A folder with what a reader would have there: the checkout, and files of his own."""
    folder.mkdir()
    (folder / "test").symlink_to(ROOT / "test")
    shutil.copytree(ROOT / "bags", folder / "bags")
    (folder / "env.sh").write_text(f". {ROOT}/env.sh\n")
    make = f"@$(MAKE) --no-print-directory -C {ROOT} OUT=$(CURDIR)/out"
    (folder / "Makefile").write_text(f"%:\n\t{make} $@\n")
    (folder / "my.yaml").write_text("driver:\n  ros__parameters:\n    publish_rate: 50.0\n")
    (folder / "sentences.txt").write_text("Hola.\nBuenos días.\n")
    film = ROOT / "src" / "teo_console" / "test" / "data" / "greeting.mp4"
    shutil.copy(film, folder / "PUENTE.mp4")
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


@pytest.mark.parametrize("pages", GROUPS, ids=lambda pages: ",".join(map(name_of, pages)))
def test_the_commands_of_a_page_do_what_it_shows(
    pages: list[Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    domain_id: int,  # noqa: ARG001
) -> None:
    failures = []
    for number, page in enumerate(pages):
        folder = readers_folder(tmp_path / str(number))
        if page.parent.name == "bags":  # that page makes the bag
            shutil.rmtree(folder / "bags" / "signer_d435")
        # His table and the executor's journal.
        monkeypatch.setenv("HOME", str(folder))
        monkeypatch.delenv("XDG_DATA_HOME", raising=False)
        for block in blocks(page):
            try:
                run_block(name_of(page), block, folder)
            except (AssertionError, subprocess.TimeoutExpired) as error:
                failures.append(f"{name_of(page)}: {block[0].line}\n{error}")
    assert not failures, "\n\n".join(failures)


def run_block(page: str, block: list[Command], folder: Path) -> None:
    to_run = [command for command in block if reason_not_to_run(command.line) is None]
    with ExitStack() as serving:
        if page in BESIDE_NODES and to_run and not any(SERVES.search(command.line) for command in to_run):
            serving.enter_context(served(NODES, folder))
        for command in to_run:
            if page in ALTERNATIVES:
                serving.close()
            if RECORDS.search(command.line):
                record(command, folder)
            elif SERVES.search(command.line.split(" #")[0].rstrip()):
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
