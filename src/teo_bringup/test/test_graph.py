# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Processes under supervision: what they say, how they end, what becomes of the others."""

from __future__ import annotations

import os
import re
import select
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from teo_bringup.graph import NODES, Graph, GraphError, executable_of
from teo_bringup.supervised_process import MOST_RESTARTS
from teo_bringup.up import Asked, main
from teo_common.node_process import tell_supervisor

PATIENCE = 120.0  # [s] for a Python process to start on a loaded machine
# Says that it is there, and at the end which signals came.
LISTENER = """
import signal, sys, time
got = []
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, lambda number, _: got.append(signal.Signals(number).name))
print("ready", flush=True)
while not got:
    time.sleep(0.01)
time.sleep(0.3)  # a window for a second signal, which must not come: nothing tells of what does not happen
print("got", *got, flush=True)
sys.exit(7)
"""

# By the protocol alone (sd_notify(3)): a process that loads ROS for it takes a second.
READY = (
    "import os, socket; socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)"
    ".sendto(b'READY=1', os.environ['NOTIFY_SOCKET'].replace('@', '\\0', 1))"
)


def python(code: str) -> tuple[str, ...]:
    return (sys.executable, "-c", code)


def wait_for(text: str, path: Path) -> None:
    deadline = time.monotonic() + PATIENCE
    while text not in path.read_text():
        assert time.monotonic() < deadline, f"no {text!r} in {path}: {path.read_text()!r}"
        time.sleep(0.02)


def test_every_node_that_signs_is_installed() -> None:
    for package, executable in NODES.values():
        assert executable_of(package, executable).is_file()


def test_a_package_or_executable_that_is_not_there_is_named() -> None:
    with pytest.raises(GraphError, match="teo_nowhere"):
        executable_of("teo_nowhere", "node")
    with pytest.raises(GraphError, match="no_such_node"):
        executable_of("teo_bringup", "no_such_node")


def test_the_block_ends_with_one_sigint_for_each_process(tmp_path: Path) -> None:
    with Graph(tmp_path) as graph:
        graph.start("one", *python(LISTENER))
        graph.start("other", *python(LISTENER))
        for name in ("one", "other"):
            wait_for("ready", tmp_path / f"{name}.log")
    for name in ("one", "other"):
        assert (tmp_path / f"{name}.log").read_text().split() == ["ready", "got", "SIGINT"]


def test_a_signal_that_was_passed_on_is_not_followed_by_another(tmp_path: Path) -> None:
    with Graph(tmp_path) as graph:
        graph.start("one", *python(LISTENER))
        wait_for("ready", tmp_path / "one.log")
        graph.tell_to_end(signal.SIGTERM)
        assert graph.stop("one") == 7
    assert (tmp_path / "one.log").read_text().split() == ["ready", "got", "SIGTERM"]


def test_it_waits_for_the_first_that_ends_and_gives_its_status(tmp_path: Path) -> None:
    with Graph(tmp_path) as graph:
        graph.start("patient", *python(LISTENER))
        graph.start("hasty", *python("import sys; sys.exit(3)"))
        assert graph.wait() == ("hasty", 3)


def test_checking_tells_what_an_ended_process_said(tmp_path: Path) -> None:
    with Graph(tmp_path) as graph:
        graph.start("hasty", *python("import sys; sys.exit('no look-up table')"))
        graph.wait()
        with pytest.raises(GraphError, match=r"hasty .* status 1(.|\n)*no look-up table"):
            graph.check()


def test_each_line_is_printed_with_its_process_and_kept_in_its_log(
    capfd: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    with Graph(tmp_path, printed=True) as graph:
        graph.start("one", *python("print('first\\nsecond')"))
        graph.wait()
    assert capfd.readouterr().out.splitlines() == ["[one] first", "[one] second"]
    assert (tmp_path / "one.log").read_text() == "first\nsecond\n"


def test_a_log_of_an_earlier_run_is_not_added_to(tmp_path: Path) -> None:
    (tmp_path / "one.log").write_text("long ago\n")
    with Graph(tmp_path) as graph:
        graph.start("one", *python("print('now')"))
        graph.wait()
        assert graph.tail("one") == "now"


def test_a_process_is_ready_when_it_says_so_and_not_before(tmp_path: Path) -> None:
    with Graph(tmp_path) as graph:
        graph.start("one", *python(f"import time; time.sleep(0.2); {READY}; time.sleep(60)"))
        graph.start("dumb", *python("import time; time.sleep(60)"))
        assert not graph.is_ready("one")
        deadline = time.monotonic() + PATIENCE
        while not graph.is_ready("one"):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        assert not graph.is_ready()


def test_what_was_ready_and_fails_is_started_again_until_it_fails_too_often(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("teo_bringup.supervised_process.RESTART_DELAY", 0.01)
    with Graph(tmp_path, printed=True) as graph:
        graph.start("feeble", *python(f"{READY}; print('alive', flush=True); raise SystemExit(3)"))
        assert graph.keep_up(restarts=True, when_ready=lambda: None) == ("feeble", 3)
    assert (tmp_path / "feeble.log").read_text().count("alive") == 1 + MOST_RESTARTS
    assert capfd.readouterr().err.count("started again") == MOST_RESTARTS


@pytest.mark.parametrize(
    ("code", "restarts", "status"),
    [
        ("raise SystemExit(4)", True, 4),  # it could never serve
        (f"{READY}", True, 0),  # it was told to end by somebody
        (f"{READY}; raise SystemExit(4)", False, 4),
    ],
)
def test_what_a_restart_would_not_help_ends_the_watch(
    code: str, restarts: bool, status: int, tmp_path: Path
) -> None:
    with Graph(tmp_path) as graph:
        graph.start("one", *python(f"print('alive', flush=True); {code}"))
        assert graph.keep_up(restarts=restarts, when_ready=lambda: None) == ("one", status)
    assert (tmp_path / "one.log").read_text() == "alive\n"


def test_processes_end_with_a_supervisor_that_is_killed(tmp_path: Path) -> None:
    supervisor = f"""
import pathlib, time
from teo_bringup.graph import Graph
graph = Graph(pathlib.Path({str(tmp_path)!r}))
graph.start("one", {sys.executable!r}, "-c", {LISTENER!r})
print(graph.process_id("one"), flush=True)
time.sleep(60)
"""
    with subprocess.Popen(python(supervisor), stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        child = os.pidfd_open(int(process.stdout.readline()))
        wait_for("ready", tmp_path / "one.log")
        process.kill()
        ended, _, _ = select.select([child], [], [], PATIENCE)
        os.close(child)
    assert ended


def test_a_notice_to_a_supervisor_that_is_gone_does_not_hinder(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("NOTIFY_SOCKET", "@nobody-is-there")
    tell_supervisor("READY=1")
    assert "nobody-is-there" in capsys.readouterr().err


def up(*arguments: str, notices: str = "") -> subprocess.Popen[str]:
    return subprocess.Popen(
        [str(executable_of("teo_bringup", "up")), *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"NOTIFY_SOCKET": notices},
    )


def wait_until_ready(systemd: socket.socket, process: subprocess.Popen[str]) -> None:
    systemd.settimeout(0.5)
    deadline = time.monotonic() + 2 * PATIENCE
    while True:
        try:
            assert systemd.recv(100) == b"READY=1"
            return
        except TimeoutError:
            assert process.poll() is None, process.communicate()[0]
            assert time.monotonic() < deadline, "expected the nodes to be ready"


@pytest.mark.usefixtures("domain_id")
@pytest.mark.slow
def test_up_keeps_every_node_up_until_it_is_told_to_end(tmp_path: Path) -> None:
    """As systemd starts it: told when all can serve; one is killed, returns, and all end without a word."""
    said: list[str] = []
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as systemd:
        systemd.bind(str(tmp_path / "notices"))
        process = up("--namespace", "lab", "--log-folder", str(tmp_path), notices=str(tmp_path / "notices"))
        watchdog = threading.Timer(4 * PATIENCE, process.kill)
        watchdog.start()
        try:
            assert process.stdout is not None
            wait_until_ready(systemd, process)
            nodes = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
            killed = next(n for n in nodes if b"translator_node" in Path(f"/proc/{n}/cmdline").read_bytes())
            os.kill(int(killed), signal.SIGKILL)
            wait_until_ready(systemd, process)
            process.terminate()
            said = process.communicate(timeout=PATIENCE)[0].splitlines()
        finally:
            watchdog.cancel()
            process.kill()
    assert process.returncode == 0, said
    assert not [line for line in said if "Traceback" in line or not line.startswith("[")]
    assert "[up] translator ended with status -9; it is started again" in said
    for name in ("translator", "executor", "driver"):
        assert said.count(f"[up] {name} is ready") == (2 if name == "translator" else 1)
    assert (tmp_path / "translator.log").read_text().count("[lab.translator]: ready") == 2


@pytest.mark.usefixtures("domain_id")
def test_up_ends_with_the_status_of_the_first_node_that_fails(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text('executor:\n  ros__parameters:\n    lut_directory: "/nowhere"\n')
    process = up("--params-file", str(wrong))
    try:
        said, _ = process.communicate(timeout=2 * PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 1, said
    assert "executor ended with status 1" in said
    assert "/nowhere" in said


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Asked]:
    """What `up` would do for a command line."""
    kept: list[Asked] = []
    monkeypatch.setattr("teo_bringup.up.run", kept.append)

    def ask(*arguments: str) -> Asked:
        with pytest.raises(SystemExit):
            main(arguments)
        return kept[-1]

    return ask


def test_up_hands_namespace_clock_and_what_follows_on_to_every_node(asked: Callable[..., Asked]) -> None:
    given = asked("--namespace", "/left/", "--use-sim-time", "--ros-args", "-p", "model:=lstm256").for_nodes
    assert given[:2] == ["--ros-args", "--params-file"]
    ours, theirs = given[3:7], given[7:]
    assert ours == ["-r", "__ns:=/left", "-p", "use_sim_time:=true"]
    assert theirs == ["--ros-args", "-p", "model:=lstm256"]
    assert asked().for_nodes[3:] == []


def test_up_starts_what_is_named_each_once_and_what_signs_if_nothing_is(asked: Callable[..., Asked]) -> None:
    assert asked().nodes == ["translator", "executor", "driver"]
    assert asked("driver", "console", "driver").nodes == ["driver", "console"]


def test_up_keeps_logs_where_ros_does(
    asked: Callable[..., Asked], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "logs"))
    assert asked().log_folder.parent == tmp_path / "logs"
    monkeypatch.delenv("ROS_LOG_DIR")
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    assert asked().log_folder.parent == tmp_path / "log"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["camera"], r"expected some of .*retriever.* got camera"),
        (["--params-file", "nowhere.yaml"], "nowhere.yaml"),
        (["-r", "__ns:=/teo"], "--ros-args before what the nodes get"),
    ],
    ids=["no such node", "no such file", "no --ros-args"],
)
def test_up_refuses_what_it_cannot_start(
    arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2
    assert re.search(told, capsys.readouterr().err)
